// SPDX-License-Identifier: MIT
#pragma once

#include "mir/shaft/host/cluster_run.hpp"
#include "support/shafts/principal_axis.hpp"

#include <cstdint>
#include <limits>
#include <vector>

namespace mir::detail {

/// A luxel's place along a direction. Equal ones go by index: what parts hold is then a function of
/// the luxels alone.
struct PlaceAlong {
    float along = 0.0f;
    std::uint32_t luxel = 0;

    [[nodiscard]] friend bool operator<(PlaceAlong a, PlaceAlong b) {
        return a.along != b.along ? a.along < b.along : a.luxel < b.luxel;
    }
};

/// A way to split a run: luxels before `from` along `direction`, and the rest.
struct ClusterCut {
    ClusterKey direction{};
    PlaceAlong from;
    double cost = std::numeric_limits<double>::infinity();  ///< luxels times size, both parts
};

/// Order of the luxels that are not empty, while it is made. In each run they are in the order of
/// their indices.
class ClusterSplitter {
 public:
    /// Cuts that are tried: one per key and one along the principal axis.
    static constexpr std::size_t cuts = std::tuple_size_v<ClusterKey> + 1;

    ClusterSplitter(const std::vector<ClusterKey>& keys, std::vector<std::uint32_t>& order)
        : keys_(&keys), order_(&order) {}

    /// Cut `number` < cuts of a run of more than smallest_cluster.
    [[nodiscard]] ClusterCut cut(ClusterRun run, std::size_t number) const {
        ClusterCut cut;
        cut.direction = direction(run, number);
        std::vector<PlaceAlong> places;
        places.reserve(run.count);
        for (std::size_t i = run.first; i < run.first + run.count; ++i)
            places.push_back(place((*order_)[i], cut.direction));
        const std::size_t part = first_part(run.count);
        const auto middle = places.begin() + static_cast<std::ptrdiff_t>(part);
        std::nth_element(places.begin(), middle, places.end());
        cut.from = *middle;
        cut.cost = cost(places, 0, part) + cost(places, part, places.size());
        return cut;
    }

    /// Splits a run by the cheapest of `cuts` cuts, the first of equals.
    [[nodiscard]] std::array<ClusterRun, 2> split(ClusterRun run, const ClusterCut* tried) const {
        const ClusterCut& best = *std::min_element(
            tried, tried + cuts,
            [](const ClusterCut& a, const ClusterCut& b) { return a.cost < b.cost; });
        const auto begin = order_->begin() + static_cast<std::ptrdiff_t>(run.first);
        std::stable_partition(
            begin, begin + static_cast<std::ptrdiff_t>(run.count),
            [&](std::uint32_t luxel) { return place(luxel, best.direction) < best.from; });
        const std::size_t part = first_part(run.count);
        return {{{run.first, part}, {run.first + part, run.count - part}}};
    }

    /// Splits a run to the end.
    void split_all(ClusterRun run) const {
        if (run.count <= smallest_cluster) return;
        std::array<ClusterCut, cuts> tried;
        for (std::size_t i = 0; i < cuts; ++i) tried[i] = cut(run, i);
        for (const ClusterRun part : split(run, tried.data())) split_all(part);
    }

 private:
    [[nodiscard]] const ClusterKey& key(std::uint32_t luxel) const { return (*keys_)[luxel]; }
    [[nodiscard]] PlaceAlong place(std::uint32_t luxel, const ClusterKey& direction) const {
        return {key_along(key(luxel), direction), luxel};
    }

    [[nodiscard]] ClusterKey direction(ClusterRun run, std::size_t number) const {
        if (number < std::tuple_size_v<ClusterKey>) {
            ClusterKey along{};
            along[number] = 1.0f;
            return along;
        }
        KeyScatter scatter(key((*order_)[run.first]));
        for (std::size_t i = run.first; i < run.first + run.count; ++i)
            scatter.add(key((*order_)[i]));
        return scatter.principal_axis();
    }

    /// What a part costs, as much as its luxels see of what lies around: their number times the
    /// size of their box.
    [[nodiscard]] double cost(const std::vector<PlaceAlong>& places, std::size_t first,
                              std::size_t end) const {
        KeyBox box(key(places[first].luxel));
        for (std::size_t i = first; i < end; ++i) box.add(key(places[i].luxel));
        return static_cast<double>(end - first) * box.size();
    }

    const std::vector<ClusterKey>* keys_;
    std::vector<std::uint32_t>* order_;
};

}  // namespace mir::detail
