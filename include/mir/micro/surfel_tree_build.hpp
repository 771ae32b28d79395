// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/limits.hpp"
#include "mir/micro/detail/fit_sphere.hpp"
#include "mir/micro/detail/normal_cone.hpp"
#include "mir/micro/detail/surfel_split.hpp"
#include "mir/micro/make_surfels.hpp"
#include "mir/micro/surfel_tree.hpp"

namespace mir {

namespace detail {

/// A node to be made. Discs [first, first + count), with `room` nodes below it on any way.
struct SurfelJob {
    std::uint32_t first = 0;
    std::uint32_t count = 0;
    std::uint32_t node = 0;
    std::uint32_t room = 0;
};

/// Makes nodes in their final places. n discs below one take 2 n - 1 of them, whatever the cuts.
class SurfelGrower {
 public:
    SurfelGrower(std::span<Surfel> surfels, const SurfelTreeOptions& options,
                 std::span<SurfelNode> nodes, std::span<float> area)
        : surfels_(surfels), options_(options), nodes_(nodes), area_(area) {}

    /// Makes one node and returns its children, which have a count of 0 below leaves.
    [[nodiscard]] std::array<SurfelJob, 2> grow_one(const SurfelJob& job) const {
        const std::span<Surfel> range = surfels_.subspan(job.first, job.count);
        if (job.count == 1) {
            write(job, range, 0);
            return {};
        }
        const auto left = static_cast<std::uint32_t>(split(range, options_, job.room));
        const std::uint32_t right = job.node + 2 * left;
        write(job, range, right);
        return {{{job.first, left, job.node + 1, job.room - 1},
                 {job.first + left, job.count - left, right, job.room - 1}}};
    }

    /// Makes a node and all below it.
    void grow_all(const SurfelJob& job) const {
        if (job.count == 0) return;
        for (const SurfelJob& child : grow_one(job)) grow_all(child);
    }

 private:
    void write(const SurfelJob& job, std::span<const Surfel> range, std::uint32_t right) const {
        const FittedSphere sphere = fit_sphere(range, options_.sphere);
        const NormalCone cone = normal_cone(range);
        double area = 0.0;
        for (const Surfel& s : range) area += static_cast<double>(s.area);
        nodes_[job.node] = {sphere.centre,
                            sphere.radius,
                            cone.axis,
                            cone.cos_angle,
                            thickness_along(range, sphere.centre, cone.axis),
                            right,
                            job.first,
                            job.count};
        area_[job.node] = static_cast<float>(area);
    }

    std::span<Surfel> surfels_;
    SurfelTreeOptions options_;
    std::span<SurfelNode> nodes_;
    std::span<float> area_;
};

/// Grows level by level until the rest below a node suits one thread.
template <Executor E>
void grow_tree(const SurfelGrower& grower, const SurfelJob& root, E& executor) {
    constexpr std::uint32_t alone = 4096;
    std::vector<SurfelJob> jobs{root};
    while (!jobs.empty()) {
        std::vector<std::array<SurfelJob, 2>> children(jobs.size());
        executor.for_each(jobs.size(), [&](std::size_t i) {
            if (jobs[i].count <= alone)
                grower.grow_all(jobs[i]);
            else
                children[i] = grower.grow_one(jobs[i]);
        });
        jobs.clear();
        for (const auto& pair : children)
            for (const SurfelJob& child : pair)
                if (child.count != 0) jobs.push_back(child);
    }
}

}  // namespace detail

template <std::invocable<const Surfel&> Albedo, Executor E>
SurfelTree::SurfelTree(std::vector<Surfel> surfels, const Albedo& albedo,
                       const SurfelTreeOptions& options, E& executor)
    : surfels_(std::move(surfels)) {
    check(options);
    expects(surfels_.size() <= detail::most_surfels,
            "a surfel tree holds at most 2^31 discs (nodes are counted by 32 bits); make larger "
            "ones");
    if (surfels_.empty()) return;
    nodes_.resize(2 * surfels_.size() - 1);
    albedo_.resize(nodes_.size());
    area_.resize(nodes_.size());
    const std::uint32_t depth =
        std::max(options.max_depth, detail::balanced_depth_of(surfels_.size()));
    const detail::SurfelGrower grower(surfels_, options, nodes_, area_);
    detail::grow_tree(grower, {0, static_cast<std::uint32_t>(surfels_.size()), 0, depth - 1},
                      executor);
    constexpr std::size_t part = 1024;
    detail::for_each_part(nodes_.size(), part, executor, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i)
            if (nodes_[i].is_leaf()) albedo_[i] = albedo(surfels_[nodes_[i].first]);
    });
    average_albedo();
}

/// From the leaves up, in double precision: means by the area of discs, rounded once.
inline void SurfelTree::average_albedo() {
    struct Sum {
        double area = 0.0;
        detail::Double3 reflected{0.0};
    };
    std::vector<Sum> sums(nodes_.size());
    for (std::size_t i = nodes_.size(); i-- > 0;) {
        if (nodes_[i].is_leaf()) {
            const auto area = static_cast<double>(area_[i]);
            sums[i] = {area, area * detail::Double3(albedo_[i].r, albedo_[i].g, albedo_[i].b)};
            continue;
        }
        const Sum& left = sums[i + 1];
        const Sum& right = sums[nodes_[i].right];
        sums[i] = {left.area + right.area, left.reflected + right.reflected};
        const Vec3 mean(sums[i].reflected / sums[i].area);
        albedo_[i] = {mean.x, mean.y, mean.z};
    }
}

}  // namespace mir
