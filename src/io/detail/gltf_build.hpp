// SPDX-License-Identifier: MIT
#pragma once

#include "io/detail/gltf_build_arrays.hpp"
#include "io/detail/gltf_build_textures.hpp"
#include "io/detail/gltf_extension_textures.hpp"
#include "mir/core/frame.hpp"
#include "mir/scene/light_kinds.hpp"
#include "mir/scene/scene.hpp"
#include "mir/scene/texture_table.hpp"
#include "mir/scene/world_geometry.hpp"

#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace mir::detail {

/// Builds the glTF model of a Scene. Its only buffer becomes the binary chunk.
class GltfBuilder {
 public:
    /// @throws Error when the scene has an index out of range, a mesh without triangles or more
    ///         geometry than the 4 GiB of a .glb.
    [[nodiscard]] tinygltf::Model build(const Scene& scene) {
        model_.asset.version = "2.0";
        model_.asset.generator = "mir";
        origin_ = scene.origin;
        reserve(scene);
        (void)TextureTable(scene);  // for its checks
        for (const TextureImage& image : scene.images) textures_.add(image);
        for (const Material& material : scene.materials) add(material);
        for (const Mesh& mesh : scene.meshes) add(mesh);
        for (const Instance& instance : scene.instances) add(instance);
        for_each_listed_light(scene, [this](const auto& light) { add(light); });
        for (const Camera& camera : scene.cameras) add(camera);
        finish(scene.name);
        return std::move(model_);
    }

 private:
    using Object = tinygltf::Value::Object;

    void reserve(const Scene& scene) {
        std::uint64_t bytes = 0;
        for (const Mesh& mesh : scene.meshes) {
            check_mesh(scene, mesh);
            if (mesh.triangles.empty())
                throw Error(ErrorCode::invalid_argument,
                            "mesh " + in_quotes(mesh.name) +
                                ": it has no triangles (glTF cannot hold that); remove it");
            bytes += mesh.positions.size() * sizeof(Vec3) + mesh.normals.size() * sizeof(Vec3) +
                     mesh.texture_coordinates.size() * sizeof(Vec2) +
                     mesh.colors.size() * sizeof(Rgb) +
                     mesh.triangles.size() * sizeof(TriangleIndices);
        }
        check_instances(scene, {});
        check_glb_bytes(bytes, "the scene");
        if (bytes == 0) return;
        model_.buffers.emplace_back().data.reserve(bytes);
    }

    /// Lists the nodes, all of them roots. A scene without nodes and name would be written as null.
    void finish(const std::string& name) {
        if (model_.nodes.empty() && name.empty()) return;
        tinygltf::Scene& scene = model_.scenes.emplace_back();
        scene.name = name;
        scene.nodes.resize(model_.nodes.size());
        std::iota(scene.nodes.begin(), scene.nodes.end(), 0);
        model_.defaultScene = 0;
    }

    /// Lists an extension as used and gives it its values.
    void extend(tinygltf::ExtensionMap& extensions, const char* name, Object values) {
        extensions[name] = tinygltf::Value(std::move(values));
        auto& used = model_.extensionsUsed;
        if (std::find(used.begin(), used.end(), name) == used.end()) used.emplace_back(name);
    }

    static tinygltf::Value number(double value) { return tinygltf::Value(value); }
    static tinygltf::Value array(const Rgb& c) {
        return tinygltf::Value(tinygltf::Value::Array{number(c.r), number(c.g), number(c.b)});
    }

    static void keep_group(std::uint16_t group, tinygltf::Value& extras) {
        if (group == 0) return;
        extras = tinygltf::Value(Object{{"light_group", tinygltf::Value(int{group})}});
    }

    void add(const Material& from) {
        tinygltf::Material& to = model_.materials.emplace_back();
        to.name = from.name;
        to.doubleSided = from.emits_from_both_sides;
        auto& pbr = to.pbrMetallicRoughness;
        pbr.baseColorFactor = {from.base_color.r, from.base_color.g, from.base_color.b, from.alpha};
        if (from.is_blended) to.alphaMode = "BLEND";
        if (from.is_masked()) {
            to.alphaMode = "MASK";
            to.alphaCutoff = from.alpha_cutoff;
        }
        pbr.metallicFactor = from.metallic;
        pbr.roughnessFactor = from.roughness;
        to.emissiveFactor = {0.0, 0.0, 0.0};
        if (from.emits()) {
            // glTF bounds the factor by 1, so the largest channel goes into the strength.
            const double largest = max_channel(from.emission);
            to.emissiveFactor = {from.emission.r / largest, from.emission.g / largest,
                                 from.emission.b / largest};
            extend(to.extensions, "KHR_materials_emissive_strength",
                   {{"emissiveStrength", number(largest)}});
        }
        if (from.specular != 1.0f)
            extend(to.extensions, "KHR_materials_specular",
                   {{"specularFactor", number(from.specular)}});
        if (from.ior != 1.5f)
            extend(to.extensions, "KHR_materials_ior", {{"ior", number(from.ior)}});
        transmission(from, to);
        if (from.clearcoat > 0.0f)
            extend(to.extensions, "KHR_materials_clearcoat",
                   {{"clearcoatFactor", number(from.clearcoat)},
                    {"clearcoatRoughnessFactor", number(from.clearcoat_roughness)}});
        if (from.diffuse_transmission > 0.0f)
            extend(to.extensions, "KHR_materials_diffuse_transmission",
                   {{"diffuseTransmissionFactor", number(from.diffuse_transmission)},
                    {"diffuseTransmissionColorFactor", array(from.diffuse_transmission_color)}});
        keep_group(from.light_group, to.extras);
        use_textures(from, to);
    }

    void transmission(const Material& from, tinygltf::Material& to) {
        if (from.transmission > 0.0f)
            extend(to.extensions, "KHR_materials_transmission",
                   {{"transmissionFactor", number(from.transmission)}});
        if (from.is_thin) return;
        Object volume{{"thicknessFactor", number(1.0)}};
        if (std::isfinite(from.attenuation_distance)) {
            volume["attenuationDistance"] = number(from.attenuation_distance);
            volume["attenuationColor"] = array(from.attenuation_color);
        }
        extend(to.extensions, "KHR_materials_volume", std::move(volume));
    }

    void use_textures(const Material& from, tinygltf::Material& to) {
        const MaterialTextures& t = from.textures;
        auto& pbr = to.pbrMetallicRoughness;
        textures_.use(t.base_color, from.name, pbr.baseColorTexture);
        textures_.use(t.metallic_roughness, from.name, pbr.metallicRoughnessTexture);
        textures_.use(t.normal, from.name, to.normalTexture);
        textures_.use(t.emission, from.name, to.emissiveTexture);
        to.normalTexture.scale = t.normal_scale;
        for (const GltfExtensionTexture& which : gltf_extension_textures)
            use_texture(t.*which.part, from.name, which, to);
    }

    /// A texture of an extension that the material lacks would multiply nothing.
    void use_texture(const Texture& from, const std::string& user,
                     const GltfExtensionTexture& which, tinygltf::Material& to) {
        const auto extension = to.extensions.find(which.extension);
        if (!from.is_set() || extension == to.extensions.end()) return;
        tinygltf::TextureInfo info;
        textures_.use(from, user, info);
        extension->second.Get<Object>()[which.key] = value_of_texture(info);
    }

    void add(const Mesh& from) {
        tinygltf::Primitive primitive;
        primitive.mode = TINYGLTF_MODE_TRIANGLES;
        primitive.material = static_cast<int>(from.material);
        auto& attributes = primitive.attributes;
        attributes["POSITION"] = add_gltf_positions(model_, from.positions);
        if (!from.normals.empty()) attributes["NORMAL"] = add_gltf_floats(model_, from.normals);
        if (!from.texture_coordinates.empty())
            attributes["TEXCOORD_0"] = add_gltf_floats(model_, from.texture_coordinates);
        if (!from.colors.empty()) attributes["COLOR_0"] = add_gltf_floats(model_, from.colors);
        primitive.indices =
            add_gltf_array(model_, from.triangles, 3 * from.triangles.size(),
                           {TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, TINYGLTF_TYPE_SCALAR,
                            TINYGLTF_TARGET_ELEMENT_ARRAY_BUFFER});
        tinygltf::Mesh& to = model_.meshes.emplace_back();
        to.name = from.name;
        to.primitives.push_back(std::move(primitive));
    }

    /// Adds a root node with the given columns, `position` counted from the scene's origin.
    tinygltf::Node& add_node(Vec3 x, Vec3 y, Vec3 z, Vec3 position) {
        const DVec3 place = origin_ + DVec3(position);
        tinygltf::Node& node = model_.nodes.emplace_back();
        node.matrix = {x.x, x.y, x.z, 0, y.x,     y.y,     y.z,     0,
                       z.x, z.y, z.z, 0, place.x, place.y, place.z, 1};
        return node;
    }

    void add(const Instance& from) {
        const Mat4& m = from.to_world;
        add_node(Vec3(m[0]), Vec3(m[1]), Vec3(m[2]), Vec3(m[3])).mesh = static_cast<int>(from.mesh);
    }

    tinygltf::Light& add_light(const char* type, const std::string& name, Rgb strength,
                               std::uint16_t group, Vec3 position, Vec3 direction) {
        const Frame frame = Frame::around(-direction);
        tinygltf::Node& node = add_node(frame.tangent, frame.bitangent, frame.normal, position);
        extend(node.extensions, "KHR_lights_punctual",
               {{"light", tinygltf::Value(static_cast<int>(model_.lights.size()))}});
        tinygltf::Light& light = model_.lights.emplace_back();
        light.type = type;
        light.name = name;
        light.intensity = max_channel(strength);
        const double scale = light.intensity > 0.0 ? light.intensity : 1.0;
        light.color = {strength.r / scale, strength.g / scale, strength.b / scale};
        keep_group(group, light.extras);
        return light;
    }

    void add(const PointLight& from) {
        add_light("point", from.name, from.intensity, from.light_group, from.position, {0, 0, -1});
    }

    void add(const SpotLight& from) {
        tinygltf::Light& light = add_light("spot", from.name, from.intensity, from.light_group,
                                           from.position, from.direction);
        light.spot.innerConeAngle = std::acos(static_cast<double>(from.cos_inner));
        light.spot.outerConeAngle = std::acos(static_cast<double>(from.cos_outer));
    }

    void add(const DirectionalLight& from) {
        add_light("directional", from.name, from.irradiance, from.light_group, Vec3(0.0f),
                  from.direction);
    }

    void add(const Camera& from) {
        add_node(from.right, from.up, from.back, from.position).camera =
            static_cast<int>(model_.cameras.size());
        tinygltf::Camera& to = model_.cameras.emplace_back();
        to.type = "perspective";
        to.name = from.name;
        to.perspective.yfov = from.vertical_fov;
        to.perspective.aspectRatio = from.aspect_ratio;
        // glTF asks for clipping planes, which a ray caster does not have.
        to.perspective.znear = 0.01;
        to.perspective.zfar = 1e6;
        Object extras;
        if (from.lens_radius != 0.0f) extras["lens_radius"] = number(from.lens_radius);
        if (from.focus_distance != 1.0f) extras["focus_distance"] = number(from.focus_distance);
        if (!extras.empty()) to.extras = tinygltf::Value(std::move(extras));
    }

    DVec3 origin_{0.0};
    tinygltf::Model model_;
    GltfTextureBuilder textures_{model_};
};

}  // namespace mir::detail
