// SPDX-License-Identifier: MIT
#include "mir/io/vpl_glb.hpp"

#include "io/detail/gltf_arrays.hpp"
#include "io/gltf_fixture.hpp"
#include "support/catch.hpp"
#include "support/some_vpls.hpp"

namespace {

tinygltf::Model model_of(const std::filesystem::path& path) {
    tinygltf::Model model;
    std::string error, warning;
    REQUIRE(tinygltf::TinyGLTF().LoadBinaryFromFile(&model, &error, &warning, path.string()));
    CHECK(error.empty());
    CHECK(warning.empty());
    return model;
}

/// Floats of an attribute of the only mesh, as they lie in the file.
std::vector<float> floats_of(const tinygltf::Model& model, const char* attribute, int type) {
    const auto& points = model.meshes.at(0).primitives.at(0);
    const auto& accessor =
        model.accessors.at(static_cast<std::size_t>(points.attributes.at(attribute)));
    CHECK(accessor.type == type);
    CHECK(accessor.componentType == TINYGLTF_COMPONENT_TYPE_FLOAT);
    const auto& view = model.bufferViews.at(static_cast<std::size_t>(accessor.bufferView));
    std::vector<float> values(view.byteLength / sizeof(float));
    std::memcpy(values.data(), model.buffers.at(0).data.data() + view.byteOffset, view.byteLength);
    return values;
}

}  // namespace

TEST_CASE("VPLs come back from their glTF file in every bit") {
    const mirtest::TemporaryFolder folder("vpl_glb");
    mir::write_vpls_glb(folder / "a.glb", mirtest::some_vpls());
    CHECK(folder.files() == 1);
    const tinygltf::Model model = model_of(folder / "a.glb");
    CHECK(model.meshes.at(0).primitives.at(0).mode == TINYGLTF_MODE_POINTS);
    using Floats = std::vector<float>;
    constexpr int vector = TINYGLTF_TYPE_VEC3;
    CHECK(floats_of(model, "POSITION", vector) == Floats{1.5f, -2, 3e-7f, 4, 5, 6});
    CHECK(floats_of(model, "NORMAL", vector) == Floats{0, 1, 0, -1, 0, 0});
    CHECK(floats_of(model, "_INTENSITY", vector) == Floats{0.25f, 1e9f, 0, 0, 0, 0});
    CHECK(floats_of(model, "COLOR_0", vector) == Floats{0.25e-9f, 1, 0, 0, 0, 0});
    CHECK(floats_of(model, "_BOUNCE", TINYGLTF_TYPE_SCALAR) == Floats{2, 254});
    CHECK(model.accessors.at(0).minValues == std::vector<double>{1.5, -2, 3e-7f});
    CHECK(model.accessors.at(0).maxValues == std::vector<double>{4, 5, 6});
}

TEST_CASE("VPLs of a scene far away stand there in their files") {
    const mirtest::TemporaryFolder folder("vpl_far");
    const mir::DVec3 origin(1e7, 0.1, -3);
    mir::write_vpls_glb(folder / "a.glb", mirtest::some_vpls(), origin);
    CHECK(model_of(folder / "a.glb").nodes.at(0).translation == std::vector<double>{1e7, 0.1, -3});
    mir::write_vpls_glb(folder / "b.glb", mirtest::some_vpls());
    CHECK(model_of(folder / "b.glb").nodes.at(0).translation.empty());
}

TEST_CASE("a glTF file of VPLs is sound for readers of scenes, also one of none") {
    const mirtest::TemporaryFolder folder("vpl_glb_scene");
    mir::write_vpls_glb(folder / "a.glb", mirtest::some_vpls());
    const mir::LoadedScene loaded = mir::read_gltf(folder / "a.glb");
    CHECK(loaded.scene.meshes.empty());
    CHECK(loaded.report.ignored.contains("primitive of points"));
    mir::write_vpls_glb(folder / "none.glb", {});
    CHECK(model_of(folder / "none.glb").meshes.empty());
}

TEST_CASE("a glTF file of VPLs that cannot be written is an error that names it") {
    const mirtest::TemporaryFolder folder("vpl_glb_missing");
    try {
        mir::write_vpls_glb(folder / "missing" / "a.glb", mirtest::some_vpls());
        FAIL("nothing was thrown");
    } catch (const mir::Error& error) {
        CHECK(error.code() == mir::ErrorCode::io);
        CHECK(std::string(error.what()).find("a.glb") != std::string::npos);
    }
}
