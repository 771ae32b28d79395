// SPDX-License-Identifier: MIT
#pragma once

#include "mir/resident/uploaded_array.hpp"
#include "mir/scene/triangle_choice.hpp"

namespace mir {

/// Chosen triangles of a scene in a backend's memory.
template <Backend B>
class UploadedTriangles {
 public:
    /// Starts the copies on `queue`; `triangles` must live until they are done.
    UploadedTriangles(const B& backend, typename B::Queue& queue, const ChosenTriangles& triangles)
        : corners_(backend, queue, triangles.corners()),
          numbers_(backend, queue, triangles.numbers()) {}

    /// For kernels that follow on the queue; valid until this is moved or ends.
    [[nodiscard]] TriangleChoice<B::space> view() const {
        return {corners_.data(), numbers_.data(), static_cast<std::uint32_t>(numbers_.size())};
    }

 private:
    UploadedArray<B, TriangleIndices> corners_;
    UploadedArray<B, std::uint32_t> numbers_;
};

}  // namespace mir
