// SPDX-License-Identifier: MIT
#include "mir/io/vpl_glb.hpp"

#include "io/detail/gltf_build_arrays.hpp"
#include "io/detail/write_glb_model.hpp"
#include "mir/core/rgb.hpp"
#include "mir/data/main_bounces.hpp"

#include <tiny_gltf.h>

#include <cstdint>
#include <utility>
#include <vector>

namespace mir {

namespace detail {
namespace {

/// Colour with 1 in its largest channel; black of black.
Rgb hue_of(Rgb c) {
    const float most = max_channel(c);
    return most > 0.0f ? Rgb{c.r / most, c.g / most, c.b / most} : Rgb();
}

/// VPLs as one mesh of points. A model without meshes for none, because glTF has no empty ones.
tinygltf::Model vpl_model(const VplList& list, DVec3 origin) {
    tinygltf::Model model;
    model.asset.version = "2.0";
    model.asset.generator = "mir";
    if (list.empty()) return model;
    std::vector<Vec3> positions, normals;
    std::vector<Rgb> colors, intensities;
    for (const Vpl& vpl : list.vpls()) {
        positions.push_back(vpl.position);
        normals.push_back(vpl.normal);
        colors.push_back(hue_of(vpl.intensity));
        intensities.push_back(vpl.intensity);
    }
    const std::vector<std::uint8_t> main = main_bounces(list);
    model.buffers.emplace_back();
    tinygltf::Primitive points;
    points.mode = TINYGLTF_MODE_POINTS;
    points.attributes["POSITION"] = add_gltf_positions(model, positions);
    points.attributes["NORMAL"] = add_gltf_floats(model, normals);
    points.attributes["COLOR_0"] = add_gltf_floats(model, colors);
    points.attributes["_INTENSITY"] = add_gltf_floats(model, intensities);
    points.attributes["_BOUNCE"] =
        add_gltf_floats(model, std::vector<float>(main.begin(), main.end()));
    tinygltf::Mesh& mesh = model.meshes.emplace_back();
    mesh.name = "VPLs";
    mesh.primitives.push_back(std::move(points));
    tinygltf::Node& node = model.nodes.emplace_back();
    node.mesh = 0;
    if (origin != DVec3(0.0)) node.translation = {origin.x, origin.y, origin.z};
    model.scenes.emplace_back().nodes = {0};
    model.defaultScene = 0;
    return model;
}

}  // namespace
}  // namespace detail

void write_vpls_glb(const std::filesystem::path& path, const VplList& list, DVec3 origin) {
    constexpr std::uint64_t bytes_of_point = 13 * sizeof(float);
    detail::check_glb_bytes(list.size() * bytes_of_point, "the list of VPLs");
    detail::write_glb_model(detail::vpl_model(list, origin), path);
}

}  // namespace mir
