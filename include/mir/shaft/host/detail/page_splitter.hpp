// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/math.hpp"
#include "mir/shaft/exact/luxel_pages.hpp"
#include "mir/shaft/host/cluster_run.hpp"

#include <array>
#include <cstdint>
#include <limits>

namespace mir::detail {

/// Coordinates of luxels of a page, by axis, metres.
using PageCoordinates = std::array<std::array<float, LuxelPage::most_luxels>, 3>;
/// Numbers of luxels of a page.
using PageNumbers = std::array<std::uint16_t, LuxelPage::most_luxels>;

/// Splits luxels of a page at medians, as cluster_order() does, into aligned runs of sixteen. Of up
/// to three cuts, by each coordinate along which they reach at least a quarter as far as along the
/// widest, the one that leaves the smallest boxes. They are sorted by each coordinate once, and
/// every cut keeps all three orders: so the next one finds its medians there, and the ends of what
/// it would leave close to the ends of a run. Wald and Havran build kd-trees that way ("On building
/// fast kd-trees for ray tracing, and on doing that in O(N log N)", 2006). A function of the luxels
/// alone; what is no number has some place.
class PageSplitter {
 public:
    /// Luxels 0 .. count - 1, where count > 0. `coordinates` must outlive it.
    PageSplitter(const PageCoordinates& coordinates, std::uint32_t count)
        : coordinates_(coordinates) {
        for (std::size_t axis = 0; axis < 3; ++axis) sort(axis, count);
        split({0, count});
    }

    /// Numbers of the luxels in the order that was found.
    [[nodiscard]] const PageNumbers& order() const { return sorted_[0]; }

 private:
    /// Luxels of an order.
    using Run = ClusterRun;
    static constexpr std::uint32_t most = LuxelPage::most_luxels;
    static constexpr std::uint32_t radix = 256;
    static constexpr float infinity = std::numeric_limits<float>::infinity();

    /// By the place along the axis in 2^16 steps of the page's extent. What lies closer together
    /// keeps its order.
    void sort(std::size_t axis, std::uint32_t count) {
        const PageNumbers steps = steps_of(coordinates_[axis], count);
        PageNumbers given;
        for (std::uint32_t i = 0; i < count; ++i) given[i] = static_cast<std::uint16_t>(i);
        PageNumbers by_low_digit;
        sort_by_digit(steps, 0, given, count, by_low_digit);
        sort_by_digit(steps, 8, by_low_digit, count, sorted_[axis]);
        for (std::uint32_t i = 0; i < count; ++i)
            place_[axis][sorted_[axis][i]] = static_cast<std::uint16_t>(i);
    }

    static PageNumbers steps_of(const std::array<float, most>& along, std::uint32_t count) {
        constexpr float last = radix * radix - 1.0f;
        float low = infinity;
        float high = -infinity;
        for (std::uint32_t i = 0; i < count; ++i) {
            low = smaller(along[i], low);
            high = larger(along[i], high);
        }
        const float scale = last / (high - low);
        PageNumbers steps;
        // What is no number becomes 0.
        for (std::uint32_t i = 0; i < count; ++i)
            steps[i] =
                static_cast<std::uint16_t>(smaller(larger((along[i] - low) * scale, 0.0f), last));
        return steps;
    }

    /// Stable.
    static void sort_by_digit(const PageNumbers& steps, std::uint32_t shift,
                              const PageNumbers& from, std::uint32_t count, PageNumbers& to) {
        const auto digit = [&](std::uint32_t luxel) {
            return steps[luxel] >> shift & (radix - 1u);
        };
        std::array<std::uint32_t, radix> places{};
        for (std::uint32_t i = 0; i < count; ++i) ++places[digit(from[i])];
        std::uint32_t before = 0;
        for (std::uint32_t& place : places) {
            const std::uint32_t its = place;
            place = before;
            before += its;
        }
        for (std::uint32_t i = 0; i < count; ++i) to[places[digit(from[i])]++] = from[i];
    }

    void split(Run run) {
        if (run.count <= smallest_cluster) return;
        const std::size_t middle = run.first + first_part(run.count);
        const std::size_t cut = cheapest(run, middle);
        for (std::size_t axis = 0; axis < 3; ++axis)
            if (axis != cut) part(run, cut, middle, axis);
        split({run.first, middle - run.first});
        split({middle, run.first + run.count - middle});
    }

    [[nodiscard]] std::size_t cheapest(Run run, std::size_t middle) const {
        std::array<float, 3> sizes{};
        float widest = 0.0f;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            sizes[axis] = between(axis, run.first, run.first + run.count - 1);
            widest = larger(sizes[axis], widest);
        }
        std::size_t best = 0;
        float least = infinity;
        for (std::size_t cut = 0; cut < 3; ++cut) {
            if (sizes[cut] < 0.25f * widest) continue;
            const float cost = cost_of(run, cut, middle);
            best = cost < least ? cut : best;
            least = smaller(cost, least);
        }
        return best;
    }

    /// Of both parts, luxels times the sum of the extents of their box.
    [[nodiscard]] float cost_of(Run run, std::size_t cut, std::size_t middle) const {
        float low = 0.0f;
        float high = 0.0f;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            low += extent(run, cut, middle, axis, true);
            high += extent(run, cut, middle, axis, false);
        }
        return static_cast<float>(middle - run.first) * low +
               static_cast<float>(run.first + run.count - middle) * high;
    }

    /// Along `axis`, of the lower or the upper part.
    [[nodiscard]] float extent(Run run, std::size_t cut, std::size_t middle, std::size_t axis,
                               bool lower) const {
        const PageNumbers& sorted = sorted_[axis];
        const auto is_inside = [&](std::size_t i) {
            return (place_[cut][sorted[i]] < middle) == lower;
        };
        std::size_t first = run.first;
        while (!is_inside(first)) ++first;
        std::size_t last = run.first + run.count - 1;
        while (!is_inside(last)) --last;
        return between(axis, first, last);
    }
    /// Two places of an order apart, metres.
    [[nodiscard]] float between(std::size_t axis, std::size_t first, std::size_t last) const {
        return coordinates_[axis][sorted_[axis][last]] - coordinates_[axis][sorted_[axis][first]];
    }

    /// Puts luxels of the lower part first, in the order of `axis`.
    void part(Run run, std::size_t cut, std::size_t middle, std::size_t axis) {
        PageNumbers& sorted = sorted_[axis];
        PageNumbers& places = place_[axis];
        PageNumbers upper;
        std::size_t lower_end = run.first;
        std::size_t upper_count = 0;
        for (std::size_t i = run.first; i < run.first + run.count; ++i) {
            const std::uint16_t luxel = sorted[i];
            const bool is_lower = place_[cut][luxel] < middle;
            sorted[lower_end] = luxel;
            places[luxel] = static_cast<std::uint16_t>(lower_end);
            upper[upper_count] = luxel;
            lower_end += is_lower ? 1 : 0;
            upper_count += is_lower ? 0 : 1;
        }
        for (std::size_t k = 0; k < upper_count; ++k) {
            sorted[middle + k] = upper[k];
            places[upper[k]] = static_cast<std::uint16_t>(middle + k);
        }
    }

    const PageCoordinates& coordinates_;
    std::array<PageNumbers, 3> sorted_;  ///< luxels by coordinate, in each run
    std::array<PageNumbers, 3> place_;   ///< by luxel: where it is in sorted_
};

}  // namespace mir::detail
