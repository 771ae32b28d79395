// SPDX-License-Identifier: MIT
#include "mir/scenes.hpp"
#include "scenes/tube.hpp"

namespace mir::builtin {
namespace {

/// A leaf, stalk at the bottom, and its pale vein. Its alpha falls from 1 to 0 over some texels.
TextureImage leaf_image() {
    TextureImage image{"leaf", 32, 48, {}};
    for (std::uint32_t row = 0; row < image.height; ++row)
        for (std::uint32_t column = 0; column < image.width; ++column) {
            const float u = (static_cast<float>(column) + 0.5f) / 16.0f - 1.0f;
            const float v = 1.0f - (static_cast<float>(row) + 0.5f) / 48.0f;
            const float half_width = 1.9f * std::sqrt(v) * (1.0f - v);
            const float inside = 8.0f * (half_width - std::abs(u)) + 0.5f;
            const bool vein = std::abs(u) < 0.05f;
            const auto alpha = static_cast<std::uint32_t>(255.0f * glm::clamp(inside, 0.0f, 1.0f));
            const std::uint32_t green = vein ? 190 : 130 + (row * 7 + column * 3) % 5 * 6;
            image.texels.push_back((vein ? 150u : 70u) | green << 8 | 48u << 16 | alpha << 24);
        }
    return image;
}

Material leaf(std::string name) {
    Material m = lambertian(std::move(name), {1.0f, 1.0f, 1.0f});
    m.textures.base_color.image = 0;
    m.textures.base_color.wrap_u = m.textures.base_color.wrap_v = mir::Wrap::clamp;
    return m;
}

/// Part behind the point of k times an irrational number: evenly spread in [0, 1).
float spread(std::uint32_t k, float step) {
    const float x = static_cast<float>(k) * step;
    return x - std::floor(x);
}

/// Adds a card of two triangles that grows out of `foot`.
void add_card(Mesh& m, Vec3 foot, Vec3 up, Vec3 across) {
    const auto first = static_cast<std::uint32_t>(m.positions.size());
    for (const Vec3 p : {foot - across, foot + across, foot + across + up, foot - across + up})
        m.positions.push_back(p);
    for (const Vec2 uv : {Vec2(0, 1), Vec2(1, 1), Vec2(1, 0), Vec2(0, 0)})
        m.texture_coordinates.push_back(uv);
    m.triangles.push_back({first, first + 1, first + 2});
    m.triangles.push_back({first, first + 2, first + 3});
}

/// Leaf `k` of a hedge, 2 m long, 1.1 m high and half a metre deep, that points outwards.
void add_leaf(Mesh& m, std::uint32_t k) {
    const Vec3 foot(2.0f * spread(k, 0.618034f) - 1.0f, 0.08f + 0.95f * spread(k, 0.754878f),
                    0.44f * spread(k, 0.569840f) - 0.22f);
    const float phi = 2.0f * pi * spread(k, 0.732051f);
    const float lift = 0.2f + 0.9f * spread(k, 0.707107f);
    const Vec3 up = glm::normalize(Vec3(std::cos(phi), lift, std::sin(phi)));
    const float size = 0.13f + 0.06f * spread(k, 0.414214f);
    add_card(m, foot, size * up,
             0.33f * size * beside(up, Vec3(-std::sin(phi), 0.4f, std::cos(phi))));
}

}  // namespace

Scene leaves() {
    Scene s;
    s.name = "leaves";
    s.images.push_back(leaf_image());
    const std::uint32_t ground = s.add(lambertian("ground", {0.34f, 0.29f, 0.23f}));
    const std::uint32_t wall = s.add(lambertian("wall", {0.68f, 0.6f, 0.5f}));
    const std::uint32_t bark = s.add(lambertian("bark", {0.22f, 0.15f, 0.1f}));
    Material masked = leaf("masked leaf");
    masked.alpha_cutoff = 0.5f;
    Material blended = leaf("blended leaf");
    blended.is_blended = true;
    blended.alpha = 0.7f;
    blended.base_color = {1.0f, 0.75f, 0.4f};
    const std::uint32_t sun = s.add(emitter("lamp", {0, 0, 0}, {75.0f, 68.0f, 56.0f}));

    s.place(quad("ground", ground, {-2.5f, 0, 2.0f}, {5, 0, 0}, {0, 0, -2.8f}));
    s.place(quad("wall", wall, {-2.5f, 0, -0.8f}, {5, 0, 0}, {0, 2.4f, 0}));
    for (std::uint32_t k = 0; k < 9; ++k) {
        const float x = 0.22f * static_cast<float>(k) - 0.88f;
        s.place(tube("stem", bark, {{x, 0.001f, 0}, {x + 0.03f, 0.5f, 0.04f}, {x - 0.02f, 1.0f, 0}},
                     0.012f, 6));
    }
    Mesh opaque = empty_mesh("leaves", s.add(masked));
    Mesh pale = empty_mesh("pale leaves", s.add(blended));
    for (std::uint32_t k = 0; k < 700; ++k) add_leaf(k % 6 == 0 ? pale : opaque, k);
    s.place(std::move(opaque));
    s.place(std::move(pale));
    s.place(quad("lamp", sun, {0.9f, 2.9f, 1.6f}, {0.9f, 0, 0}, {0, -0.35f, 0.5f}));

    s.cameras.push_back(
        Camera::look_at({-0.7f, 1.15f, 3.0f}, {0.0f, 0.62f, -0.2f}, {0, 1, 0}, 0.72f));
    s.cameras.back().name = "hedge";
    s.cameras.back().aspect_ratio = 4.0f / 3.0f;
    return s;
}

}  // namespace mir::builtin
