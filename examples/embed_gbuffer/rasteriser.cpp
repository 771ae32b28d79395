// SPDX-License-Identifier: MIT
#include "rasteriser.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/packing.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>

#include <cmath>
#include <cstring>

namespace engine {

void World::add_quad(std::uint32_t material, glm::vec3 p, glm::vec3 a, glm::vec3 b) {
    triangles.push_back({{p, p + a, p + a + b}, material});
    triangles.push_back({{p, p + a + b, p + b}, material});
}

Camera Camera::look_at(glm::vec3 eye, glm::vec3 target, float scale) {
    Camera c;
    c.eye = eye;
    c.forward = glm::normalize(target - eye);
    c.right = glm::normalize(glm::cross(c.forward, glm::vec3(0, 1, 0)));
    c.up = glm::cross(c.right, c.forward);
    c.scale = scale;
    return c;
}

Target::Target(std::uint32_t width, std::uint32_t height, std::size_t pixel_bytes)
    : width_(width),
      height_(height),
      pixel_bytes_(pixel_bytes),
      pitch_((width * pixel_bytes + 255) / 256 * 256),
      bytes_(pitch_ * height) {}

std::uint32_t pack_normal(glm::vec3 n) {
    n /= std::fabs(n.x) + std::fabs(n.y) + std::fabs(n.z);
    glm::vec2 p(n.x, n.y);
    if (n.z < 0.0f) {
        p.x = std::copysign(1.0f - std::fabs(n.y), n.x);
        p.y = std::copysign(1.0f - std::fabs(n.x), n.y);
    }
    const auto code = [](float v) {
        return 1u + static_cast<std::uint32_t>(std::lround((0.5f * v + 0.5f) * 65534.0f));
    };
    return code(p.x) | code(p.y) << 16;
}

glm::vec3 unpack_normal(std::uint32_t packed) {
    const auto value = [](std::uint32_t code) {
        return static_cast<float>(code - 1) * (2.0f / 65534.0f) - 1.0f;
    };
    const float x = value(packed & 0xFFFFu);
    const float y = value(packed >> 16);
    glm::vec3 n(x, y, 1.0f - std::fabs(x) - std::fabs(y));
    if (n.z < 0.0f) {
        n.x = std::copysign(1.0f - std::fabs(y), x);
        n.y = std::copysign(1.0f - std::fabs(x), y);
    }
    return glm::normalize(n);
}

namespace {

glm::vec2 on_film(const GBuffer& image, std::uint32_t x, std::uint32_t y) {
    const auto width = static_cast<float>(image.geometry.width());
    const auto height = static_cast<float>(image.geometry.height());
    return {(2.0f * static_cast<float>(x) + 1.0f - width) / height,
            (height - 2.0f * static_cast<float>(y) - 1.0f) / height};
}

void write(GBuffer& image, std::uint32_t x, std::uint32_t y, glm::vec3 position, glm::vec3 normal,
           const Material& m) {
    const GeometryPixel g{{position.x, position.y, position.z}, pack_normal(normal)};
    const auto half = [](float v) { return glm::packHalf1x16(v); };
    const MaterialPixel p{{half(m.albedo.x), half(m.albedo.y), half(m.albedo.z)},
                          half(m.roughness),
                          half(m.metallic),
                          0};
    std::memcpy(image.geometry.pixel(x, y), &g, sizeof g);
    std::memcpy(image.material.pixel(x, y), &p, sizeof p);
}

}  // namespace

glm::vec3 through_pixel(const Camera& camera, const GBuffer& image, std::uint32_t x,
                        std::uint32_t y) {
    const glm::vec2 p = camera.scale * on_film(image, x, y);
    return camera.forward + p.x * camera.right + p.y * camera.up;
}

GBuffer draw(const World& world, const Camera& camera, std::uint32_t width, std::uint32_t height) {
    GBuffer image(width, height);
    // Inverse depth, 0 at infinity.
    std::vector<float> nearness(std::size_t{width} * height, 0.0f);
    const glm::mat3 to_camera = glm::transpose(
        glm::mat3(camera.right / camera.scale, camera.up / camera.scale, camera.forward));
    for (const Triangle& t : world.triangles) {
        const auto& [a, b, c] = t.corner;
        const glm::vec3 normal = glm::normalize(glm::cross(b - a, c - a));
        if (glm::dot(normal, camera.eye - a) <= 0.0f) continue;
        const glm::mat3 weights_of =
            glm::inverse(to_camera * glm::mat3(a - camera.eye, b - camera.eye, c - camera.eye));
        for (std::uint32_t y = 0; y < height; ++y)
            for (std::uint32_t x = 0; x < width; ++x) {
                const glm::vec3 w = weights_of * glm::vec3(on_film(image, x, y), 1.0f);
                const float near = w.x + w.y + w.z;
                float& nearest = nearness[std::size_t{y} * width + x];
                if (w.x < 0.0f || w.y < 0.0f || w.z < 0.0f || near <= nearest) continue;
                nearest = near;
                const glm::vec3 position = (w.x * a + w.y * b + w.z * c) / near;
                write(image, x, y, position, normal, world.materials[t.material]);
            }
    }
    return image;
}

}  // namespace engine
