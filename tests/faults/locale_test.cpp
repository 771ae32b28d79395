// SPDX-License-Identifier: MIT
//
// A host program may have chosen a locale with a decimal comma and groups of digits: what the
// library reads and writes does not change.
#include "faults/writers.hpp"
#include "mir/core/number_text.hpp"
#include "mir/io/exr.hpp"
#include "mir/io/scene_reader.hpp"
#include "mir/io/vpl_ply.hpp"
#include "mir/runtime/check_places.hpp"
#include "mir/runtime/check_scene.hpp"
#include "mir/scene/detail/coarse_meshes.hpp"
#include "mir/scene/scene_hash.hpp"
#include "mir/scenes.hpp"
#include "support/catch.hpp"
#include "support/comma_locale.hpp"
#include "support/temporary_folder.hpp"

#include <sstream>

namespace fs = std::filesystem;
using mirtest::CommaLocale;

namespace {

const fs::path corpus = MIR_FUZZ_CORPUS_DIR;

/// What `work` returns with a decimal comma.
template <class Work>
auto with_commas(const Work& work) {
    const CommaLocale commas;
    static bool is_said = false;
    if (!CommaLocale::is_of_c() && !is_said) {
        WARN("skipped for C functions: this machine has no locale de_DE.UTF-8 and cannot make it");
        is_said = true;
    }
    return work();
}

std::string message_of(const mir::Scene& scene) {
    try {
        const mir::WorldGeometry geometry(scene);
    } catch (const mir::Error& e) {
        return e.what();
    }
    return "no error";
}

/// Every kind of sentence that has numbers with a point.
std::string messages() {
    mir::Scene scene = mir::builtin::make("furnace");
    scene.materials.front().alpha_cutoff = 0.5f;
    scene.materials.front().alpha = 1.5f;
    std::string text = message_of(scene) + "\n";
    scene = mir::builtin::make("furnace");
    scene.cameras.front().position.x = 1.25e18f;
    try {
        mir::check_places(scene, 0, {});
    } catch (const mir::Error& e) {
        text += e.what();
    }
    mir::detail::CoarseMeshes coarse;
    coarse.look_at("mesh", 1e6, 0.5, 1.0);
    std::vector<std::string> remarks;
    coarse.append_to(remarks, "coarse", "none");
    mir::ChainHealth health;
    health.luminance = {1.0, 0.2, 1234567, 1234567};
    health.large_step_luminance = {9.0, 0.3, 50, 40};
    mir::detail::add_luminance_warnings(health, remarks);
    for (const std::string& remark : remarks) text += "\n" + remark;
    return text;
}

}  // namespace

TEST_CASE("numbers of texts have points, whatever the locale") {
    const auto numbers = [] {
        return mir::number_text(1234567.0) + " " + mir::number_text(0.1, 17) + " " +
               mir::number_text(-1e-30) + " " + mir::fixed_text(1234.5678, 2) + " " +
               mir::fixed_text(-2.5) + " " + mir::shortest_text(0.1);
    };
    const std::string wanted = "1.23457e+06 0.10000000000000001 -1e-30 1234.57 -2 0.1";
    CHECK(numbers() == wanted);
    CHECK(with_commas(numbers) == wanted);
    CHECK(mir::fixed_text(-1.7976931348623157e308, 100).size() == 1 + 309 + 1 + 100);
    // The locale is what it says.
    const auto streamed = with_commas([] {
        std::ostringstream stream;
        stream << 1234.5;
        return stream.str();
    });
    CHECK(streamed == "1.234,5");
}

TEST_CASE("files have the same bytes, whatever the locale") {
    const mirtest::TemporaryFolder folder("locale_write");
    std::vector<mirtest::Writer> writers = mirtest::all_writers(3);
    writers.push_back({"origin.ply", [](const fs::path& path) {
                           mir::write_vpls_ply(path, {}, {4075539.8361, 0.5, -1e-7});
                       }});
    for (const mirtest::Writer& writer : writers) {
        const fs::path path = folder / writer.name;
        writer.write(path);
        const std::string wanted = mirtest::bytes_of_file(path);
        const std::string found = with_commas([&] {
            writer.write(path);
            return mirtest::bytes_of_file(path);
        });
        INFO(writer.name);
        CHECK(wanted.size() > 100);
        CHECK(found == wanted);
    }
}

TEST_CASE("files are read as the same scenes, whatever the locale") {
    const mirtest::TemporaryFolder folder("locale_read");
    std::ofstream(folder / "a.obj") << "mtllib a.mtl\nv 0.25 -1.5e-1 1234.5\nv 1.5 0 0\n"
                                       "v 0 .5 0\nusemtl m\nf 1 2 3\n";
    std::ofstream(folder / "a.mtl") << "newmtl m\nKd 0.125 0.5 0.75\nNs 12.5\nKe 1.5 1.5 1.5\n";
    for (const fs::path& file :
         {folder / "a.obj", corpus / "ply/ascii.ply", corpus / "gltf/everything.gltf"}) {
        const auto read = [&]() -> std::string {
            try {
                return mir::SceneHash(mir::read_scene(file).scene).hex();
            } catch (const mir::Error& e) {
                return e.what();
            }
        };
        INFO(file.filename());
        const std::string wanted = read();
        CHECK(wanted.size() == 16);
        CHECK(with_commas(read) == wanted);
    }
    const auto read_exr = [] { return mir::read_exr(corpus / "exr/layers.exr").attributes; };
    CHECK(with_commas(read_exr) == read_exr());
}

TEST_CASE("messages have the same words, whatever the locale") {
    const std::string wanted = messages();
    CHECK(wanted.find("alpha is 1.5 (") != std::string::npos);
    CHECK(wanted.find("1.25e+18 m") != std::string::npos);
    CHECK(wanted.find("0.0625 m apart, 1/8 of its median edge") != std::string::npos);
    CHECK(wanted.find("disagree by 22.2 standard errors") != std::string::npos);
    CHECK(with_commas(messages) == wanted);
}
