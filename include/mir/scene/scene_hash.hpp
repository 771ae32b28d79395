// SPDX-License-Identifier: MIT
#pragma once

#include "mir/scene/light_kinds.hpp"

#include <cstring>
#include <span>
#include <string>
#include <type_traits>

namespace mir {

/// Fingerprint of what a scene looks like. 16 hexadecimal digits that change with any geometry,
/// material, light or camera, and not with names or Scene::origin. Not cryptographic. Source:
/// FNV-1a, 64 bits.
class SceneHash {
 public:
    /// Reads all of the scene once, which may end afterwards.
    explicit SceneHash(const Scene& scene) {
        // The sizes first: without them a light could pass for one of another kind.
        add_each(scene.meshes.size(), scene.instances.size(), scene.materials.size());
        ListedLights::for_each_list(scene, [this](const auto& list) { add(list.size()); });
        add(scene.cameras.size());
        for (const Mesh& m : scene.meshes) {
            add_all(m.positions);
            add_all(m.normals);
            add_all(m.triangles);
            add(m.material);
            if (!m.texture_coordinates.empty()) add_all(m.texture_coordinates);
            if (!m.colors.empty()) add_all(m.colors);
        }
        for (const Instance& i : scene.instances) {
            add(i.mesh);
            add(i.to_world);
        }
        for (const Material& m : scene.materials) add_material(m);
        for (const TextureImage& i : scene.images) {
            add_each(i.width, i.height);
            add_all(i.texels);
        }
        for_each_listed_light(scene, [this](const auto& light) {
            light.with_values([this](const auto&... values) { add_each(values...); });
        });
        if (scene.environment) add_environment(*scene.environment);
        for (const Camera& c : scene.cameras)
            add_each(c.position, c.right, c.up, c.back, c.vertical_fov, c.aspect_ratio,
                     c.lens_radius, c.focus_distance);
    }

    /// 16 hexadecimal digits in lower case.
    [[nodiscard]] std::string hex() const {
        constexpr char digits[] = "0123456789abcdef";
        std::string text(16, '0');
        for (std::size_t i = 0; i < 16; ++i) text[i] = digits[(state_ >> (60 - 4 * i)) & 15];
        return text;
    }

 private:
    void add_bytes(const void* data, std::size_t size) {
        const auto* bytes = static_cast<const unsigned char*>(data);
        for (std::size_t i = 0; i < size; ++i) state_ = (state_ ^ bytes[i]) * 0x100000001b3ull;
    }
    template <class T>
    void add(const T& value) {
        static_assert(std::is_trivially_copyable_v<T>);
        add_bytes(&value, sizeof value);
    }
    template <class... T>
    void add_each(const T&... values) {
        (add(values), ...);
    }
    template <class T>
    void add_all(const std::vector<T>& values) {
        add(values.size());
        add_bytes(values.data(), values.size() * sizeof(T));
    }
    void add_material(const Material& m) {
        add_each(m.base_color, m.metallic, m.roughness, m.specular, m.ior, m.emission,
                 m.emits_from_both_sides, m.light_group);
        const MaterialTextures& t = m.textures;
        int part = 0;
        t.for_each([&](const Texture& x) {
            ++part;
            if (x.is_set())
                add_each(part, x.image, x.wrap_u, x.wrap_v, x.nearest, x.u_axis, x.v_axis,
                         x.offset);
        });
        if (t.normal.is_set()) add(t.normal_scale);
        if (m.is_masked()) add_each(m.alpha, m.alpha_cutoff);
        if (m.is_blended) add_each(m.is_blended, m.alpha);
        if (m.transmission > 0.0f)
            add_each(m.transmission, m.is_thin, m.attenuation_color, m.attenuation_distance);
        if (m.clearcoat > 0.0f) add_each(m.clearcoat, m.clearcoat_roughness);
        if (m.diffuse_transmission > 0.0f)
            add_each(m.diffuse_transmission, m.diffuse_transmission_color);
    }

    void add_environment(const Environment& e) {
        add_each(e.radiance.width(), e.radiance.height(), e.scale, e.rotation, e.light_group);
        add_bytes(e.radiance.pixels().data(), e.radiance.pixels().size_bytes());
    }

    std::uint64_t state_ = 0xcbf29ce484222325ull;
};

}  // namespace mir
