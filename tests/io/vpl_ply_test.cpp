// SPDX-License-Identifier: MIT
#include "mir/io/vpl_ply.hpp"

#include "mir/io/ply_reader.hpp"
#include "support/catch.hpp"
#include "support/some_vpls.hpp"
#include "support/temporary_folder.hpp"
#include "support/vpl_file.hpp"

#include <fstream>
#include <iterator>

namespace {

std::string vpl_file_bytes(const std::filesystem::path& path) {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

}  // namespace

TEST_CASE("VPLs come back from their PLY file in every bit") {
    const mirtest::TemporaryFolder folder("vpl_ply");
    const mir::VplList list = mirtest::some_vpls();
    mir::write_vpls_ply(folder / "a.ply", list);
    const auto read = mirtest::read_vpls(vpl_file_bytes(folder / "a.ply"));
    REQUIRE(read.size() == 2);
    for (std::size_t j = 0; j < 2; ++j) {
        CHECK(read[j].vpl.position == list.vpls()[j].position);
        CHECK(read[j].vpl.normal == list.vpls()[j].normal);
        CHECK(read[j].vpl.intensity == list.vpls()[j].intensity);
    }
    CHECK(read[0].bounce == 2);
    CHECK(read[1].bounce == 254);
    CHECK(folder.files() == 1);
}

TEST_CASE("a PLY file of VPLs is sound for readers of meshes") {
    const mirtest::TemporaryFolder folder("vpl_ply_mesh");
    mir::write_vpls_ply(folder / "a.ply", mirtest::some_vpls());
    const mir::LoadedScene loaded = mir::read_ply(folder / "a.ply");
    CHECK(loaded.report.triangles == 0);
    CHECK(loaded.report.ignored.contains("PLY vertex property 'bounce'"));
    mir::write_vpls_ply(folder / "none.ply", {});
    CHECK(mirtest::read_vpls(vpl_file_bytes(folder / "none.ply")).empty());
}

TEST_CASE("a PLY file of VPLs names the place that its positions are counted from") {
    const mirtest::TemporaryFolder folder("vpl_ply_far");
    mir::write_vpls_ply(folder / "a.ply", mirtest::some_vpls(), {1e7, 0.25, -3});
    const std::string bytes = vpl_file_bytes(folder / "a.ply");
    CHECK(bytes.find("\ncomment origin of positions, metres: 10000000 0.25 -3\nelement") !=
          std::string::npos);
    CHECK(mirtest::read_vpls(bytes).size() == 2);
}

TEST_CASE("VPLs that cannot be written are an error that names the file") {
    const mirtest::TemporaryFolder folder("vpl_ply_missing");
    try {
        mir::write_vpls_ply(folder / "missing" / "a.ply", mirtest::some_vpls());
        FAIL("nothing was thrown");
    } catch (const mir::Error& error) {
        CHECK(error.code() == mir::ErrorCode::io);
        CHECK(std::string(error.what()).find("a.ply") != std::string::npos);
    }
}
