// SPDX-License-Identifier: MIT
#include "io/gltf_fixture.hpp"
#include "mir/io/gltf_reader.hpp"
#include "mir/scene/world_geometry.hpp"
#include "support/catch.hpp"
#include "support/shared_scenes.hpp"

#include <filesystem>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <string>
#include <vector>

using namespace mirtest;
namespace fs = std::filesystem;

namespace {

struct Expected {
    const char* file;
    std::uint64_t triangles;
    std::uint64_t emitting;
    std::uint64_t instances;
    std::size_t cameras;
    std::uint64_t lights;
};

struct Refused {
    const char* file;
    const char* says;
    mir::ErrorCode code = mir::ErrorCode::invalid_input;
};

/// Triangles and emitters as the scenes' own list counts them, with instances.
const std::vector<Expected>& readable() {
    static const std::vector<Expected> list{
        {"cornell-box/cornell-box.glb", 36, 2, 8, 1, 0},
        {"furnace/furnace-rho05.glb", 12, 12, 1, 1, 0},
        {"furnace/furnace-objects-rho05.glb", 2232, 2232, 3, 1, 0},
        {"veach-ajar/veach-ajar.gltf", 382628, 2, 22, 1, 0},
        {"veach-ajar/veach-ajar-diffuse.gltf", 382628, 2, 22, 1, 0},
        {"veach-mis/veach-mis.glb", 6676, 6624, 9, 1, 0},
        {"staircase/staircase.glb", 262508, 2, 755, 1, 0},
        {"living-room/living-room.glb", 142973, 0, 65, 1, 0},
        {"bmw-m6/bmw-m6.glb", 788586, 4, 114, 1, 0},
        {"gltf-features/00_empty_scene/00_empty_scene.gltf", 0, 0, 0, 0, 0},
        {"gltf-features/00_no_scene/00_no_scene.gltf", 12, 0, 1, 0, 0},
        {"gltf-features/01_single_vs_double_sided/01_single_vs_double_sided.gltf", 1480, 0, 2, 0,
         0},
        {"gltf-features/02_node_hierarchy/02_node_hierarchy.gltf", 60, 0, 2, 0, 0},
        {"gltf-features/02_shared_mesh/02_shared_mesh.gltf", 24, 0, 2, 0, 0},
        {"gltf-features/09_texture_transform/09_texture_transform.gltf", 2, 0, 1, 0, 0},
        {"gltf-features/10_custom_normals/10_custom_normals.gltf", 88, 0, 2, 0, 0},
        {"gltf-features/14_emission_strength/14_emission_strength.gltf", 17280, 15360, 18, 0, 0},
        {"gltf-features/15_transmission/15_transmission.gltf", 4800, 0, 5, 0, 0},
        {"gltf-features/22_vertex_color/22_vertex_color.gltf", 5, 0, 3, 0, 0},
        {"gltf-features/24_gpu_instancing/24_gpu_instancing.gltf", 7656770, 0, 1900, 0, 0},
        {"gltf-features/Cameras/Cameras.gltf", 2, 0, 1, 1, 0},
        {"gltf-features/Lights.glb", 12, 0, 1, 1, 4},
        {"gltf-features/simple-instancing.glb", 1500, 0, 125, 0, 0}};
    return list;
}

const std::vector<Refused>& unreadable() {
    static const std::vector<Refused> list{
        {"gltf-features/heart_draco.glb", "'KHR_draco_mesh_compression'",
         mir::ErrorCode::unsupported},
        {"malformed/RecursiveNodes-RecursiveNodes.gltf", "node 0: it is its own ancestor"},
        {"malformed/integer-out-of-bounds.gltf",
         "bufferView 0: byteLength is 1e+300, where a whole number is wanted"},
        {"malformed/invalid-buffer-index.gltf", "bufferView 1: it names buffer 1 "},
        {"malformed/invalid-buffer-view-index.gltf", "accessor 0: it names bufferView 1 "},
        {"malformed/invalid-primitive-indices.gltf", "accessor 0: it names bufferView 1 "},
        {"malformed/missing-bin/BoxTextured.gltf", "File not found : BoxTextured0.bin"},
        {"malformed/wrongTypes-badArray.gltf",
         "mesh 0 'Mesh': primitives is an object, where an array is wanted"},
        {"malformed/wrongTypes-badNumber.gltf",
         "material 0 'Texture': normalTexture.index is missing"},
        {"malformed/wrongTypes-badUint.gltf", "baseColorTexture: it names texture -1"}};
    return list;
}

/// Folder of the scenes, with a word on why a test does nothing without it.
std::optional<fs::path> scenes_or_warn() {
    auto folder = shared_scenes();
    if (!folder) WARN("skipped: the shared scenes are not on this machine");
    return folder;
}

}  // namespace

TEST_CASE("every readable shared file has the triangles, emitters and lights it should") {
    const auto folder = scenes_or_warn();
    if (!folder) return;
    for (const Expected& expected : readable()) {
        INFO(expected.file);
        const auto loaded = mir::read_gltf(*folder / expected.file);
        const mir::SceneReport& report = loaded.report;
        CHECK(report.triangles == expected.triangles);
        CHECK(report.emitting_triangles == expected.emitting);
        CHECK(report.instances == expected.instances);
        CHECK(loaded.scene.cameras.size() == expected.cameras);
        CHECK(std::accumulate(report.listed_lights.begin(), report.listed_lights.end(),
                              std::uint64_t{0}) == expected.lights);
    }
}

TEST_CASE("every broken shared file is refused with its name and a reason") {
    const auto folder = scenes_or_warn();
    if (!folder) return;
    for (const Refused& refused : unreadable()) {
        mir::ErrorCode code = mir::ErrorCode::internal;
        const std::string file = (*folder / refused.file).string();
        const std::string message = message_of([&] { mir::read_gltf(file); }, &code);
        INFO(message);
        CHECK(message.rfind(file + ": ", 0) == 0);
        CHECK(message.find(refused.says) != std::string::npos);
        CHECK(code == refused.code);
    }
}

TEST_CASE("no shared glTF file is missing from the tables of this test") {
    const auto folder = scenes_or_warn();
    if (!folder) return;
    std::set<std::string> known;
    for (const Expected& expected : readable()) known.insert(expected.file);
    for (const Refused& refused : unreadable()) known.insert(refused.file);
    for (const auto& file : fs::recursive_directory_iterator(*folder)) {
        const auto ending = file.path().extension();
        if (ending != ".gltf" && ending != ".glb") continue;
        const auto name = fs::relative(file.path(), *folder).generic_string();
        INFO(name);
        CHECK(known.count(name) == 1);
    }
}

TEST_CASE("the Cornell box keeps its radiance, its matte walls and its camera") {
    const auto folder = scenes_or_warn();
    if (!folder) return;
    const auto loaded = mir::read_gltf(*folder / "cornell-box/cornell-box.glb");
    std::uint64_t lamps = 0;
    for (const mir::Material& material : loaded.scene.materials) {
        CHECK(material.is_lambertian());
        if (material.emits()) CHECK(material.emission == mir::Rgb{17, 12, 4});
        lamps += material.emits() ? 1u : 0u;
    }
    CHECK(lamps == 1);
    const mir::Camera& camera = loaded.scene.cameras.at(0);
    CHECK(camera.vertical_fov == Approx(0.34033920));
    CHECK(camera.aspect_ratio == 1.0f);
    CHECK(loaded.report.cameras.at(0).width == 1024);
    CHECK(loaded.report.ignored.empty());
}

TEST_CASE("mirrored instances of the car stay mirrored and can be placed") {
    const auto folder = scenes_or_warn();
    if (!folder) return;
    const auto loaded = mir::read_gltf(*folder / "bmw-m6/bmw-m6.glb");
    int mirrored = 0;
    for (const mir::Instance& instance : loaded.scene.instances)
        mirrored += glm::determinant(mir::Mat3(instance.to_world)) < 0.0f ? 1 : 0;
    CHECK(mirrored == 5);
    CHECK(loaded.report.stored_triangles == 389170);
    const mir::WorldGeometry geometry(loaded.scene);
    CHECK(geometry.triangles().size() + geometry.dropped_triangles() == loaded.report.triangles);
    CHECK((geometry.bounds().low == loaded.report.bounds.low));
    CHECK((geometry.bounds().high == loaded.report.bounds.high));
}

TEST_CASE("the living room reports what its picture would need") {
    const auto folder = scenes_or_warn();
    if (!folder) return;
    const auto loaded = mir::read_gltf(*folder / "living-room/living-room.glb");
    CHECK(loaded.report.is_dark());
    const std::map<std::string, std::uint64_t> expected{{"environment", 1}};
    CHECK(loaded.report.ignored == expected);
}
