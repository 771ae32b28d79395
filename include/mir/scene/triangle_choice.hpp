// SPDX-License-Identifier: MIT
#pragma once

#include "mir/scene/world_geometry.hpp"

#include <span>
#include <utility>
#include <vector>

namespace mir {

/// What builders read of some triangles of a scene. A view.
template <Space S>
struct TriangleChoice {
    static constexpr Space space = S;  ///< where the arrays lie

    const TriangleIndices* corners = nullptr;  ///< of vertices of the scene
    const std::uint32_t* numbers = nullptr;    ///< in WorldGeometry; nullptr: 0, 1, 2, ...
    std::uint32_t count = 0;                   ///< triangles that are chosen

    /// All triangles of a geometry, which `uploaded` views.
    [[nodiscard]] static TriangleChoice all(const WorldGeometry& geometry,
                                            const GeometryView<S>& uploaded) {
        return {uploaded.triangles, nullptr,
                static_cast<std::uint32_t>(geometry.triangles().size())};
    }
};

/// Some triangles of a WorldGeometry. Immutable; const use from any thread.
class ChosenTriangles {
 public:
    /// Those with these numbers.
    ChosenTriangles(const WorldGeometry& geometry, std::vector<std::uint32_t> numbers)
        : numbers_(std::move(numbers)) {
        corners_.reserve(numbers_.size());
        for (const std::uint32_t t : numbers_) corners_.push_back(geometry.triangles()[t]);
    }

    /// Vertices of the scene, three by three.
    [[nodiscard]] std::span<const TriangleIndices> corners() const { return corners_; }
    /// In WorldGeometry.
    [[nodiscard]] std::span<const std::uint32_t> numbers() const { return numbers_; }
    /// What builders on the host read; valid until this is moved or ends.
    [[nodiscard]] TriangleChoice<Space::host> view() const {
        return {corners_.data(), numbers_.data(), static_cast<std::uint32_t>(numbers_.size())};
    }

 private:
    std::vector<std::uint32_t> numbers_;
    std::vector<TriangleIndices> corners_;
};

/// The triangles of a scene in two parts, by what they do to segments.
struct TrianglesByOpacity {
    ChosenTriangles opaque;  ///< stop every segment
    ChosenTriangles open;    ///< have holes, or are seen through
};

/// Ascending in each part.
[[nodiscard]] inline TrianglesByOpacity triangles_by_opacity(const WorldGeometry& geometry) {
    const OpacityView<Space::host> opacity = geometry.opacity();
    std::vector<std::uint32_t> opaque;
    std::vector<std::uint32_t> open;
    for (std::uint32_t t = 0; t < geometry.triangles().size(); ++t)
        (opacity.stops_all(t) ? opaque : open).push_back(t);
    return {{geometry, std::move(opaque)}, {geometry, std::move(open)}};
}

}  // namespace mir
