// SPDX-License-Identifier: MIT
#include "io/gltf_fixture.hpp"
#include "mir/io/scene_reader.hpp"
#include "mir/scene/world_geometry.hpp"
#include "support/catch.hpp"
#include "support/shared_scenes.hpp"

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

using namespace mirtest;
namespace fs = std::filesystem;

namespace {

using Ignored = std::map<std::string, std::uint64_t>;

struct Expected {
    const char* file;
    std::uint64_t triangles;
    std::uint64_t emitting;
    std::size_t materials;
    Ignored ignored;
};

const std::vector<Expected>& readable() {
    static const std::vector<Expected> list{
        {"cornell-box/cornell-box.obj", 36, 2, 8, {}},
        {"spot/spot_triangulated.obj", 5856, 0, 1, {}},
        {"obj-features/box.obj", 12, 0, 1, {{"use of a material that no library has", 1}}},
        {"obj-features/box_UTF16BE.obj", 12, 0, 1, {{"use of a material that no library has", 1}}},
        {"obj-features/box_longline.obj",
         944,
         0,
         1,
         {{"use of a material that no library has", 1}}},
        {"obj-features/box_mat_with_spaces.obj", 12, 0, 12, {}},
        {"obj-features/concave_polygon.obj", 64, 0, 1, {}},
        {"obj-features/cube_usemtl.obj", 12, 0, 3, {{"use of a material that no library has", 2}}},
        {"obj-features/cube_with_vertexcolors.obj", 12, 0, 1, {}},
        {"obj-features/mtl_different_folder.obj", 12, 0, 1, {{"image 'image.jpg' (not found)", 1}}},
        {"obj-features/number_formats.obj", 1, 0, 1, {{"characters behind a number", 6}}},
        {"ply-features/cube.ply", 12, 0, 1, {}},
        {"ply-features/cube_binary.ply", 12, 0, 1, {}},
        {"ply-features/cube_uv.ply",
         12,
         0,
         1,
         {{"PLY vertex property 's'", 1}, {"PLY vertex property 't'", 1}}}};
    return list;
}

}  // namespace

TEST_CASE("every shared OBJ and PLY file is read as it should be") {
    const auto folder = shared_scenes();
    if (!folder) {
        WARN("skipped: the shared scenes are not on this machine");
        return;
    }
    std::set<std::string> known;
    for (const Expected& expected : readable()) {
        INFO(expected.file);
        known.insert(expected.file);
        const auto loaded = mir::read_scene(*folder / expected.file);
        for (const auto& [what, times] : loaded.report.ignored)
            UNSCOPED_INFO(what << ": " << times);
        CHECK(loaded.report.ignored == expected.ignored);
        CHECK(loaded.report.triangles == expected.triangles);
        CHECK(loaded.report.emitting_triangles == expected.emitting);
        CHECK(loaded.scene.materials.size() == expected.materials);
    }
    for (const auto& file : fs::recursive_directory_iterator(*folder)) {
        const auto ending = file.path().extension();
        if (ending != ".obj" && ending != ".ply") continue;
        const auto name = fs::relative(file.path(), *folder).generic_string();
        INFO(name);
        CHECK(known.count(name) == 1);
    }
}

TEST_CASE("the Cornell box is the same scene as OBJ and as glTF") {
    const auto folder = shared_scenes();
    if (!folder) return;
    const auto obj = mir::read_scene(*folder / "cornell-box/cornell-box.obj");
    const auto gltf = mir::read_scene(*folder / "cornell-box/cornell-box.glb");
    const mir::WorldGeometry from_obj(obj.scene);
    const mir::WorldGeometry from_gltf(gltf.scene);
    REQUIRE(from_obj.triangles().size() == from_gltf.triangles().size());
    for (std::uint32_t t = 0; t < from_obj.triangles().size(); ++t) {
        CHECK(distance(from_obj.front_normal(t), from_gltf.front_normal(t)) < 1e-4f);
        CHECK(from_obj.area(t) == Approx(from_gltf.area(t)).epsilon(1e-4));
        const mir::Material& a = obj.scene.materials[from_obj.material_of(t)];
        const mir::Material& b = gltf.scene.materials[from_gltf.material_of(t)];
        CHECK(a.is_lambertian());
        CHECK(a.emission == b.emission);
        CHECK(a.base_color.r == Approx(b.base_color.r).margin(1e-6));
        CHECK(a.base_color.g == Approx(b.base_color.g).margin(1e-6));
    }
}
