// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/executor.hpp"
#include "mir/micro/surfel.hpp"
#include "mir/micro/surfel_tree_view.hpp"

#include <concepts>
#include <span>
#include <vector>

namespace mir {

/// A binary hierarchy of spheres over the discs of a scene, in host memory. Light is kept apart
/// from it (SurfelRadiance), so that one tree serves all bounces. Const use from any thread. Equal
/// in bytes for any number of threads. The constructor is defined in surfel_tree_build.hpp.
class SurfelTree {
 public:
    /// Builds from the root down, O(n log n). `albedo(surfel)` is the reflectance of a disc, 0..1
    /// (SurfelAlbedo); it is called from any thread. Sources: Ritschel et al. 2009 (the use), Conty
    /// Estevez and Kulla, "Importance sampling of many lights with adaptive tree splitting",
    /// PACMCGIT 1(2), 2018 (the heuristic; here the cone of a candidate is the one in which evenly
    /// spread normals would have the same mean).
    /// @throws Error(invalid_argument) on options out of range and on more than 2^31 discs.
    template <std::invocable<const Surfel&> Albedo, Executor E>
    SurfelTree(std::vector<Surfel> surfels, const Albedo& albedo, const SurfelTreeOptions& options,
               E& executor);

    /// What kernels on the host read; valid until the tree ends.
    [[nodiscard]] SurfelTreeView<Space::host> view() const {
        return {nodes_.data(), albedo_.data(), surfels_.data(), area_.data(),
                static_cast<std::uint32_t>(nodes_.size())};
    }

    /// In the order of a walk (SurfelNode). The root first, 2 n - 1 for n discs.
    [[nodiscard]] std::span<const SurfelNode> nodes() const { return nodes_; }
    /// Of nodes: mean over the area below, 0..1.
    [[nodiscard]] std::span<const Rgb> albedo() const { return albedo_; }
    /// Of nodes: of the pieces that the discs below stand for, m^2.
    [[nodiscard]] std::span<const float> area() const { return area_; }
    /// In the order of the tree: SurfelNode::first counts them.
    [[nodiscard]] std::span<const Surfel> surfels() const { return surfels_; }

    /// Memory held, bytes.
    [[nodiscard]] std::size_t bytes() const {
        return nodes().size_bytes() + albedo().size_bytes() + area().size_bytes() +
               surfels().size_bytes();
    }

 private:
    void average_albedo();

    std::vector<Surfel> surfels_;
    std::vector<SurfelNode> nodes_;
    std::vector<Rgb> albedo_;
    std::vector<float> area_;
};

}  // namespace mir
