// SPDX-License-Identifier: MIT
#pragma once

#include "mir/micro/detail/triangle_pieces.hpp"
#include "mir/micro/surfel_ray.hpp"
#include "mir/micro/surfel_tree.hpp"

#include <bit>
#include <vector>

namespace mir {

/// Tells which disc of a tree a point of a triangle belongs to. 4 bytes for each disc and triangle.
/// Immutable; const use from any thread.
class SurfelPlaces {
 public:
    /// The tree holds the discs that make_surfels() made of all triangles of the geometry.
    /// @throws Error(invalid_argument) on discs that belong to no triangle of it.
    SurfelPlaces(const SurfelTree& tree, const WorldGeometry& geometry)
        : first_(geometry.triangles().size() + 1), leaves_(tree.surfels().size(), SurfelHit::none) {
        count(tree);
        std::vector<std::uint32_t> any(geometry.triangles().size(), SurfelHit::none);
        for (std::uint32_t i = 0; i < tree.nodes().size(); ++i) {
            const SurfelNode& node = tree.nodes()[i];
            if (!node.is_leaf()) continue;
            const Surfel& disc = tree.surfels()[node.first];
            any[disc.triangle] = i;
            const detail::Double3 centre(disc.position);
            leaves_[place(disc.triangle,
                          detail::barycentrics_at(geometry, disc.triangle, centre))] = i;
        }
        // Pieces so small that centres are rounded into their neighbours.
        for (std::uint32_t t = 0; t < any.size(); ++t)
            for (std::uint32_t k = first_[t]; k < first_[t + 1]; ++k)
                if (leaves_[k] == SurfelHit::none) leaves_[k] = any[t];
    }

    /// The leaf of a triangle's disc at `barycentrics`. These are the weights of the second and
    /// third corner.
    [[nodiscard]] std::uint32_t leaf(std::uint32_t triangle, Vec2 barycentrics) const {
        return leaves_[place(triangle, barycentrics)];
    }

 private:
    void count(const SurfelTree& tree) {
        for (const Surfel& disc : tree.surfels()) {
            expects(std::size_t{disc.triangle} + 1 < first_.size(),
                    "a disc belongs to no triangle of the scene (no ray would find it); make discs "
                    "of this scene's triangles");
            ++first_[disc.triangle + 1];
        }
        for (std::size_t t = 1; t < first_.size(); ++t) first_[t] += first_[t - 1];
    }
    /// A triangle has 4^level discs.
    [[nodiscard]] std::uint32_t place(std::uint32_t triangle, Vec2 barycentrics) const {
        const std::uint32_t discs = first_[triangle + 1] - first_[triangle];
        const auto level = static_cast<std::uint32_t>(std::countr_zero(discs)) / 2;
        return first_[triangle] + static_cast<std::uint32_t>(detail::piece_at(barycentrics, level));
    }

    std::vector<std::uint32_t> first_;
    std::vector<std::uint32_t> leaves_;
};

}  // namespace mir
