// SPDX-License-Identifier: MIT
#pragma once

#include "mir/resident/uploaded_array.hpp"
#include "mir/scene/world_geometry.hpp"

namespace mir {

/// A WorldGeometry in a backend's memory: what kernels need to turn hits into surface points.
template <Backend B>
class UploadedGeometry {
 public:
    /// Starts the copies on `queue`; `geometry` must live until they are done.
    UploadedGeometry(const B& backend, typename B::Queue& queue, const WorldGeometry& geometry)
        : positions_(backend, queue, geometry.positions()),
          normals_(backend, queue, geometry.normals()),
          triangles_(backend, queue, geometry.triangles()),
          materials_(backend, queue, geometry.materials()),
          texture_coordinates_(backend, queue, geometry.texture_coordinates()),
          colors_(backend, queue, geometry.colors()),
          ray_offset_(geometry.ray_offset()) {}

    /// For kernels that follow on the queue; valid until this is moved or ends.
    [[nodiscard]] GeometryView<B::space> view() const {
        return {positions_.data(),
                normals_.data(),
                triangles_.data(),
                materials_.data(),
                ray_offset_,
                texture_coordinates_.size() == 0 ? nullptr : texture_coordinates_.data(),
                colors_.size() == 0 ? nullptr : colors_.data()};
    }

 private:
    UploadedArray<B, Vec3> positions_;
    UploadedArray<B, Vec3> normals_;
    UploadedArray<B, TriangleIndices> triangles_;
    UploadedArray<B, std::uint32_t> materials_;
    UploadedArray<B, Vec2> texture_coordinates_;
    UploadedArray<B, Rgb> colors_;
    float ray_offset_;
};

}  // namespace mir
