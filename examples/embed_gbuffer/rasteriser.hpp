// SPDX-License-Identifier: MIT
//
// The engine that was there before: it draws triangles into render targets of its own layout and
// knows nothing of mir.
#pragma once

#include <glm/vec3.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace engine {

struct Material {
    glm::vec3 albedo{0.8f};
    float roughness = 1.0f;
    float metallic = 0.0f;
};

/// Corners turn counter-clockwise seen from the front.
struct Triangle {
    glm::vec3 corner[3];
    std::uint32_t material = 0;
};

struct World {
    std::vector<Material> materials;
    std::vector<Triangle> triangles;

    /// Parallelogram with corners p, p + a, p + a + b, p + b; its front is where a x b points.
    void add_quad(std::uint32_t material, glm::vec3 p, glm::vec3 a, glm::vec3 b);
};

struct Camera {
    glm::vec3 eye{0};
    glm::vec3 right{1, 0, 0};  ///< unit, as the others
    glm::vec3 up{0, 1, 0};
    glm::vec3 forward{0, 0, -1};
    float scale = 0.5f;  ///< tangent of half the vertical field of view

    static Camera look_at(glm::vec3 eye, glm::vec3 target, float scale);
};

/// Rows of pixels at a pitch, as graphics interfaces hand them out.
class Target {
 public:
    Target(std::uint32_t width, std::uint32_t height, std::size_t pixel_bytes);

    [[nodiscard]] std::uint32_t width() const { return width_; }
    [[nodiscard]] std::uint32_t height() const { return height_; }
    [[nodiscard]] const std::byte* pixel(std::uint32_t x, std::uint32_t y) const {
        return bytes_.data() + y * pitch_ + x * pixel_bytes_;
    }
    [[nodiscard]] std::byte* pixel(std::uint32_t x, std::uint32_t y) {
        return bytes_.data() + y * pitch_ + x * pixel_bytes_;
    }

 private:
    std::uint32_t width_;
    std::uint32_t height_;
    std::size_t pixel_bytes_;
    std::size_t pitch_;  ///< whole multiples of 256 bytes
    std::vector<std::byte> bytes_;
};

/// A pixel of the first target: position in single precision, normal in 32 bits.
struct GeometryPixel {
    float position[3];
    std::uint32_t normal;  ///< octahedral, 2 x 16 bits; 0 where nothing was drawn
};

/// A pixel of the second target, halves one after the other.
struct MaterialPixel {
    std::uint16_t albedo[3];
    std::uint16_t roughness;
    std::uint16_t metallic;
    std::uint16_t unused;
};

struct GBuffer {
    GBuffer(std::uint32_t width, std::uint32_t height)
        : geometry(width, height, sizeof(GeometryPixel)),
          material(width, height, sizeof(MaterialPixel)) {}

    Target geometry;
    Target material;
};

/// Unit vector to 32 bits that are never 0, and back. Source: Meyer, Suessmuth, Sussner, Stamminger
/// and Greiner, "On floating-point normal vectors", EGSR 2010.
std::uint32_t pack_normal(glm::vec3 n);
glm::vec3 unpack_normal(std::uint32_t packed);

/// Direction of the ray through the centre of a pixel, not unit.
glm::vec3 through_pixel(const Camera& camera, const GBuffer& image, std::uint32_t x,
                        std::uint32_t y);

/// Draws the world. Triangles need no clipping: they are drawn in homogeneous coordinates. Source:
/// Olano and Greer, "Triangle scan conversion using 2D homogeneous coordinates", 1997.
GBuffer draw(const World& world, const Camera& camera, std::uint32_t width, std::uint32_t height);

}  // namespace engine
