// SPDX-License-Identifier: MIT
#include "ray_counters.hpp"

#include "mir/accel/kd/kd_traverse.hpp"
#include "mir/shading/contribution.hpp"

#include <algorithm>

namespace mirpaper {
namespace {

using Tree = mir::KdTreeView<mir::Space::host>;
constexpr std::uint32_t warp = 32;

struct Steps {
    std::uint64_t nodes = 0;
    std::uint64_t leaves = 0;
    std::uint64_t triangles = 0;
    bool hidden = false;

    [[nodiscard]] std::uint64_t all() const { return nodes + leaves + triangles; }
};

/// Sums over rays.
struct Totals {
    std::uint64_t pairs = 0;
    std::uint64_t rays = 0;
    std::uint64_t visible = 0;
    Steps steps;
    std::uint64_t lock_step = 0;  ///< steps of the longest ray of each warp, times 32

    void add(const Steps& s) {
        ++rays;
        visible += s.hidden ? 0 : 1;
        steps.nodes += s.nodes;
        steps.leaves += s.leaves;
        steps.triangles += s.triangles;
    }
    void add(const Totals& t) {
        pairs += t.pairs;
        rays += t.rays;
        visible += t.visible;
        steps.nodes += t.steps.nodes;
        steps.leaves += t.steps.leaves;
        steps.triangles += t.steps.triangles;
        lock_step += t.lock_step;
    }
};

bool is_hidden_by_leaf(const Tree& tree, mir::KdNode leaf, mir::Vec3 from, mir::Vec3 to,
                       Steps& steps) {
    ++steps.leaves;
    const std::uint32_t* const first = tree.references + leaf.first();
    return std::any_of(first, first + leaf.count(), [&](std::uint32_t t) {
        ++steps.triangles;
        return mir::hits_segment(tree.triangles[t], from, to);
    });
}

struct Cell {
    mir::KdNode node;
    float begin = 0.0f;
    float end = 1.0f;
};

/// Goes down to the first leaf of a cell, leaving the others on the stack.
mir::KdNode descend(const Tree& tree, mir::Vec3 from, mir::Vec3 to, Cell& cell,
                    std::vector<Cell>& waiting, Steps& steps) {
    while (!cell.node.is_leaf()) {
        ++steps.nodes;
        const int axis = static_cast<int>(cell.node.axis());
        const float along = to[axis] - from[axis];
        const float t = (cell.node.split() - from[axis]) / (along == 0.0f ? 0x1p-90f : along);
        const bool downwards = along < 0.0f;
        const mir::KdChildren children = tree.children(cell.node);
        const mir::KdNode first = downwards ? children.above : children.below;
        const mir::KdNode second = downwards ? children.below : children.above;
        cell.node = t <= cell.begin ? second : first;
        if (t > cell.begin && t < cell.end) {
            waiting.push_back({second, t, cell.end});
            cell.end = t;
        }
    }
    return cell.node;
}

/// The walk of kd_traverse.hpp, step by step.
Steps count_steps(const Tree& tree, mir::Vec3 from, mir::Vec3 to) {
    Steps steps;
    std::vector<Cell> waiting{{tree.nodes[Tree::root]}};
    while (!waiting.empty() && !steps.hidden) {
        Cell cell = waiting.back();
        waiting.pop_back();
        const mir::KdNode leaf = descend(tree, from, to, cell, waiting, steps);
        steps.hidden = is_hidden_by_leaf(tree, leaf, from, to, steps);
    }
    return steps;
}

/// 32 neighbouring luxels and one VPL.
void count_warp(const Tree& tree, const GBuffer::View& luxels, std::uint32_t first,
                const mir::Vpl& vpl, Totals& totals) {
    std::uint64_t longest = 0;
    for (std::uint32_t i = first; i < first + warp; ++i) {
        const mir::Hit hit = luxels.hit(i);
        ++totals.pairs;
        if (mir::is_empty(hit) || !mir::faces(hit, vpl)) continue;
        const Steps steps = count_steps(tree, vpl.position, hit.position);
        if (steps.hidden != mir::is_hidden(tree, vpl.position, hit.position))
            throw mir::Error(mir::ErrorCode::internal,
                             "a counted ray and the library's disagree (the counters do not walk "
                             "the tree as the library does); please report");
        totals.add(steps);
        longest = std::max(longest, steps.all());
    }
    totals.lock_step += warp * longest;
}

double ratio(std::uint64_t a, std::uint64_t b) {
    return b == 0 ? 0.0 : static_cast<double>(a) / static_cast<double>(b);
}

}  // namespace

RayCounters count_rays(const PaperScene& scene, const mir::VplList& vpls, std::uint32_t groups,
                       Executor& executor) {
    const auto luxels = scene.luxels().view(0);
    const Tree tree = scene.tree().view();
    const std::uint32_t warps = luxels.size() / warp;
    const std::uint32_t count = std::min(groups, warps);
    std::vector<Totals> parts(count);
    executor.for_each(count, [&](std::size_t g) {
        const auto at = static_cast<std::uint32_t>(std::uint64_t{g} * warps / count);
        for (const mir::Vpl& vpl : vpls.vpls()) count_warp(tree, luxels, at * warp, vpl, parts[g]);
    });
    Totals all;
    for (const Totals& part : parts) all.add(part);
    return {ratio(all.rays, all.pairs),
            ratio(all.visible, all.rays),
            ratio(all.steps.nodes, all.rays),
            ratio(all.steps.leaves, all.rays),
            ratio(all.steps.triangles, all.rays),
            ratio(all.steps.all(), all.lock_step),
            all.rays};
}

}  // namespace mirpaper
