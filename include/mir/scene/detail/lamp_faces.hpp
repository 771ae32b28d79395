// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/executor.hpp"
#include "mir/scene/detail/box_tree.hpp"
#include "mir/scene/detail/coincidence.hpp"
#include "mir/scene/geometry_view.hpp"
#include "mir/scene/scene.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace mir::detail {

/// A face of a lamp that coincides with other surfaces. It lies before them by `level` steps.
struct LampFace {
    std::uint32_t triangle = 0;
    bool front = true;        ///< the side it shines from
    std::uint32_t level = 1;  ///< the first of several lamps in one place has the highest
};

/// From which sides the triangles of a material shine.
enum class Shining : std::uint8_t { none, front, both };

/// By material.
[[nodiscard]] inline std::vector<Shining> shining_of(const Scene& scene) {
    std::vector<Shining> shining;
    for (const Material& m : scene.materials)
        shining.push_back(!m.emits()                ? Shining::none
                          : m.emits_from_both_sides ? Shining::both
                                                    : Shining::front);
    return shining;
}

/// Lamps that coincide with other surfaces.
struct CoincidingLamps {
    std::vector<LampFace> faces;  ///< ascending by triangle, fronts before backs
    std::uint64_t triangles = 0;  ///< lamps, and what coincides with one
    float reach = 0.0f;           ///< largest distance at which such surfaces coincide, metres
};

/// Finds lamps that lie in one place with other surfaces, and their order there.
class LampFaceFinder {
 public:
    /// `shining` is by material.
    LampFaceFinder(const GeometryView<Space::host>& geometry, std::uint32_t triangles,
                   std::vector<Shining> shining)
        : geometry_(geometry), triangles_(triangles), shining_(std::move(shining)) {
        for (std::uint32_t t = 0; t < triangles_; ++t)
            if (shining_of(t) != Shining::none) lamps_.push_back(t);
    }

    /// The bits do not depend on the executor.
    template <Executor E>
    [[nodiscard]] CoincidingLamps find(E& executor) const {
        CoincidingLamps found;
        if (lamps_.empty()) return found;
        const std::vector<Pair> pairs = coinciding_pairs(executor);
        std::vector<std::uint32_t> all;
        for (const auto& [lamp, other] : pairs) {
            all.push_back(lamp);
            all.push_back(other);
            found.reach = larger(found.reach, reach_of(lamp));
        }
        std::sort(all.begin(), all.end());
        all.erase(std::unique(all.begin(), all.end()), all.end());
        found.triangles = all.size();
        found.faces = ordered_faces(pairs);
        return found;
    }

 private:
    /// A lamp, and a wall or a later lamp.
    using Pair = std::pair<std::uint32_t, std::uint32_t>;
    /// Of front and back; 0: not lifted.
    using Levels = std::array<std::uint32_t, 2>;

    static constexpr std::uint32_t searched_together = 4096;

    [[nodiscard]] Shining shining_of(std::uint32_t triangle) const {
        return shining_[geometry_.materials[triangle]];
    }
    [[nodiscard]] Facet facet(std::uint32_t triangle) const {
        return Facet({geometry_.corner(triangle, 0), geometry_.corner(triangle, 1),
                      geometry_.corner(triangle, 2)});
    }
    [[nodiscard]] Bounds box_of(std::uint32_t triangle, float margin) const {
        Bounds box;
        for (std::uint32_t k = 0; k < 3; ++k) {
            box.add(geometry_.corner(triangle, k) - margin);
            box.add(geometry_.corner(triangle, k) + margin);
        }
        return box;
    }
    /// By which segments that leave the lamp are lifted off it. What is nearer lies in its place.
    [[nodiscard]] float reach_of(std::uint32_t lamp) const {
        const float size = std::sqrt(geometry_.area(lamp));
        float reach = 0.0f;
        for (std::uint32_t k = 0; k < 3; ++k)
            reach = larger(reach, geometry_.offset_at(geometry_.corner(lamp, k), size));
        return reach;
    }

    template <Executor E>
    [[nodiscard]] std::vector<Pair> coinciding_pairs(E& executor) const {
        std::vector<Bounds> boxes;
        boxes.reserve(lamps_.size());
        for (const std::uint32_t lamp : lamps_) boxes.push_back(box_of(lamp, reach_of(lamp)));
        const BoxTree tree(boxes);
        std::vector<std::vector<Pair>> parts((triangles_ + searched_together - 1) /
                                             searched_together);
        executor.for_each(parts.size(), [&](std::size_t i) {
            const std::uint32_t first = static_cast<std::uint32_t>(i) * searched_together;
            const std::uint32_t last = std::min(first + searched_together, triangles_);
            for (std::uint32_t t = first; t < last; ++t) append_pairs(tree, t, parts[i]);
        });
        std::vector<Pair> pairs;
        for (const std::vector<Pair>& part : parts)
            pairs.insert(pairs.end(), part.begin(), part.end());
        std::sort(pairs.begin(), pairs.end());
        return pairs;
    }

    void append_pairs(const BoxTree& tree, std::uint32_t triangle, std::vector<Pair>& pairs) const {
        const bool shines = shining_of(triangle) != Shining::none;
        const Facet own = facet(triangle);
        tree.each_touching(box_of(triangle, 0.0f), [&](std::uint32_t i) {
            const std::uint32_t lamp = lamps_[i];
            if (shines && lamp >= triangle) return;
            if (coincide(facet(lamp), own, static_cast<double>(reach_of(lamp))))
                pairs.emplace_back(lamp, triangle);
        });
    }

    [[nodiscard]] bool look_alike(std::uint32_t a, std::uint32_t b) const {
        return glm::dot(facet(a).normal, facet(b).normal) > 0.0;
    }

    /// Position of a lamp among the lamps.
    [[nodiscard]] std::size_t place_of(std::uint32_t lamp) const {
        const auto at = std::lower_bound(lamps_.begin(), lamps_.end(), lamp);
        return static_cast<std::size_t>(at - lamps_.begin());
    }

    /// From the last lamp to the first. Each lies before those that come later in its place and
    /// shine to the same side.
    [[nodiscard]] std::vector<LampFace> ordered_faces(const std::vector<Pair>& pairs) const {
        std::vector<Levels> levels(lamps_.size(), Levels{0, 0});
        const auto raise = [&](std::uint32_t lamp, Levels above) {
            Levels& own = levels[place_of(lamp)];
            own[0] = std::max(own[0], above[0] + 1);
            if (shining_of(lamp) == Shining::both) own[1] = std::max(own[1], above[1] + 1);
        };
        for (const auto& [lamp, other] : pairs)
            if (shining_of(other) != Shining::none) raise(other, {0, 0});
        for (auto pair = pairs.rbegin(); pair != pairs.rend(); ++pair) {
            const auto [lamp, other] = *pair;
            Levels above{0, 0};
            if (shining_of(other) != Shining::none) above = levels[place_of(other)];
            if (!look_alike(lamp, other)) std::swap(above[0], above[1]);
            raise(lamp, above);
        }
        std::vector<LampFace> faces;
        for (std::size_t i = 0; i < lamps_.size(); ++i) {
            if (levels[i][0] > 0) faces.push_back({lamps_[i], true, levels[i][0]});
            if (levels[i][1] > 0) faces.push_back({lamps_[i], false, levels[i][1]});
        }
        return faces;
    }

    GeometryView<Space::host> geometry_;
    std::uint32_t triangles_;
    std::vector<Shining> shining_;
    std::vector<std::uint32_t> lamps_;  ///< ascending
};

}  // namespace mir::detail
