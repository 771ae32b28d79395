// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/lane_group.hpp"
#include "mir/micro/gather_options.hpp"
#include "mir/micro/surfel_traverse.hpp"
#include "mir/micro/texel_reach.hpp"

#include <cstring>

namespace mir {

/// What a group works in that draws a MicroBuffer of up to `Side` texels in each direction.
template <std::uint32_t Side>
struct MicroBufferSpace {
    static constexpr std::uint32_t side = Side;  ///< most texels in each direction
    /// Nodes that may wait: fewer make lanes idle, never fail; more leave room for fewer groups.
    static constexpr std::uint32_t most_waiting = 384;

    std::uint64_t nearest[Side * Side];   ///< of texels: bits of the distance, below them the node
    Vec3 direction[Side * Side];          ///< of texels, unit
    std::uint32_t waiting[most_waiting];  ///< stack of nodes still to be looked at
    std::uint32_t drawn[2 * LaneGroup::width];  ///< nodes where the walk ended
    // Of up to 32 nodes that are drawn together:
    SurfelNode node[LaneGroup::width];       ///< copies of those nodes
    std::uint32_t area[LaneGroup::width];    ///< texels that it may cover
    std::uint32_t before[LaneGroup::width];  ///< texels of the nodes before
};

/// A small picture of what is around a point: what each of its texels sees first of a tree of
/// discs. `Texels` says which directions they stand for, each seen along one of them: a
/// CosineTexels or LobeTexels. Made by 32 lanes together, in the memory of their group; host and
/// device, the same bits.
template <std::uint32_t Side, class Texels>
class MicroBuffer {
 public:
    /// Memory of the group, undefined before; holds the picture afterwards.
    using Workspace = MicroBufferSpace<Side>;

    /// `side` texels in each direction, 1 to `Side`; `jitter` in [0, 1)^2 is the place of the
    /// directions inside their texels. What is passed in must outlive it.
    MIR_HD MicroBuffer(const LaneGroup& group, Workspace& space, const Texels& texels,
                       std::uint32_t side, Vec2 jitter)
        : group_(group), space_(space), texels_(texels), side_(side), jitter_(jitter) {
        const float step = 1.0f / static_cast<float>(side);
        group.each([&](std::uint32_t lane) {
            for (std::uint32_t i = lane; i < size(); i += LaneGroup::width) {
                space.direction[i] = texels.direction(step * (Vec2(i % side, i / side) + jitter));
                space.nearest[i] = nothing;
            }
        });
    }

    /// Number of texels, counted row by row.
    [[nodiscard]] MIR_HD std::uint32_t size() const { return side_ * side_; }
    /// Unit, in the world.
    [[nodiscard]] MIR_HD Vec3 direction(std::uint32_t texel) const {
        return space_.direction[texel];
    }
    /// Index of the node that a texel sees first, or SurfelHit::none.
    [[nodiscard]] MIR_HD std::uint32_t node(std::uint32_t texel) const {
        return static_cast<std::uint32_t>(space_.nearest[texel]);
    }
    /// Distance of that node, metres.
    [[nodiscard]] MIR_HD float distance(std::uint32_t texel) const {
        const auto word = static_cast<std::uint32_t>(space_.nearest[texel] >> 32);
        float t = 0.0f;
        memcpy(&t, &word, sizeof(t));
        return t;
    }

    /// Draws a tree as seen from `origin`, above the tangent plane of `normal` (SurfelRay::normal),
    /// in one walk: down to discs, or to nodes at most `threshold` times as large as the texels
    /// there and at which closest_surfel() would stop. A texel holds the nearest of those that its
    /// direction meets. Nodes wait on a stack of which every lane takes one; those that are to be
    /// drawn are drawn 32 together. Source: Ritschel et al. 2009, section 4; nodes are met by all
    /// texels that they cover, not splatted into one, which leaves holes.
    template <Space S>
    MIR_HD void draw(const SurfelTreeView<S>& tree, Vec3 origin, Vec3 normal, float threshold) {
        if (tree.empty()) return;
        const SurfelRay point{origin, {0, 0, 1}, normal};
        const float share = threshold / static_cast<float>(size());
        group_.each([&](std::uint32_t lane) {
            if (lane == 0) space_.waiting[0] = tree.root;
        });
        std::uint32_t waiting = 1;
        std::uint32_t drawn = 0;
        while (waiting > 0) {
            const std::uint32_t taken = portion(waiting);
            waiting -= taken;
            const Taken ends = take(tree, point, share, {waiting, taken}, drawn);
            waiting += 2 * ends.inner;
            drawn += ends.drawn;
            if (drawn < LaneGroup::width) continue;
            drawn -= LaneGroup::width;
            draw_nodes(tree, point, {drawn, LaneGroup::width});
        }
        draw_nodes(tree, point, {0, drawn});
    }

    /// Whether a walk for a point ends at a node that it does not pass by.
    template <Space S>
    [[nodiscard]] MIR_HD bool ends_at(const SurfelTreeView<S>& tree, std::uint32_t index,
                                      const SurfelRay& point, float share) const {
        const SurfelNode& node = tree.nodes[index];
        return ends_at(node, point.normal, node.centre - point.origin, share);
    }

 private:
    /// Infinitely far, SurfelHit::none.
    static constexpr std::uint64_t nothing = 0x7F800000FFFFFFFFull;

    /// A run of places in an array of the workspace.
    struct Run {
        std::uint32_t first;
        std::uint32_t count;
    };

    /// What became of the nodes that were taken.
    struct Taken {
        std::uint32_t inner;  ///< their children wait
        std::uint32_t drawn;  ///< are to be drawn
    };

    /// Nodes to take of those that wait: as many as there are lanes, fewer when their children may
    /// not have room, one when only a walk down by itself is sure to.
    [[nodiscard]] MIR_HD static std::uint32_t portion(std::uint32_t waiting) {
        constexpr std::uint32_t room = Workspace::most_waiting - SurfelTreeOptions::depth_limit;
        const std::uint32_t left = waiting < room ? room - waiting : 1;
        const std::uint32_t most = waiting < LaneGroup::width ? waiting : LaneGroup::width;
        return left < most ? left : most;
    }

    /// Looks at a run of nodes that no longer wait. Children of inner nodes take their places,
    /// nodes where the walk ends those behind `drawn`.
    template <Space S>
    MIR_HD Taken take(const SurfelTreeView<S>& tree, const SurfelRay& point, float share, Run run,
                      std::uint32_t drawn) {
        LaneGroup::PerLane<std::uint32_t> nodes;
        LaneGroup::PerLane<std::uint32_t> right;
        LaneGroup::PerLane<bool> is_inner;
        LaneGroup::PerLane<bool> is_end;
        group_.each([&](std::uint32_t lane) {
            is_inner[lane] = is_end[lane] = false;
            if (lane >= run.count) return;
            const std::uint32_t index = nodes[lane] = space_.waiting[run.first + lane];
            // A copy: a GPU reads it in three pieces, not member by member.
            const SurfelNode node = tree.nodes[index];
            const Vec3 to_centre = node.centre - point.origin;
            if (detail::lies_below(node, point.normal, to_centre,
                                   detail::padded_radius(node, to_centre)))
                return;
            right[lane] = node.right;
            const bool ends = ends_at(node, point.normal, to_centre, share);
            is_inner[lane] = !ends;
            is_end[lane] = ends && (node.is_leaf() || detail::is_above(point, to_centre));
        });
        const std::uint32_t inner =
            group_.ballot([&](std::uint32_t lane) { return is_inner[lane]; });
        const std::uint32_t ends = group_.ballot([&](std::uint32_t lane) { return is_end[lane]; });
        group_.each([&](std::uint32_t lane) {
            if (is_inner[lane]) {
                std::uint32_t* out =
                    space_.waiting + run.first + 2 * LaneGroup::count_before(inner, lane);
                out[0] = right[lane];
                out[1] = nodes[lane] + 1;
            }
            if (is_end[lane])
                space_.drawn[drawn + LaneGroup::count_before(ends, lane)] = nodes[lane];
        });
        return {LaneGroup::count(inner), LaneGroup::count(ends)};
    }

    [[nodiscard]] MIR_HD bool ends_at(const SurfelNode& node, Vec3 normal, Vec3 to_centre,
                                      float share) const {
        if (node.is_leaf()) return true;
        const float solid_angle =
            share / texels_.largest_density(SeenSphere(to_centre, node.radius));
        return detail::stops_at(node, normal, to_centre, cap_sine_squared(solid_angle));
    }

    /// Texels that up to 32 nodes may cover are found by a lane for each node, and met by a lane
    /// for each texel of a node, for nodes cover one texel or many.
    template <Space S>
    MIR_HD void draw_nodes(const SurfelTreeView<S>& tree, const SurfelRay& point, Run run) {
        LaneGroup::PerLane<std::uint32_t> before;
        group_.each([&](std::uint32_t lane) {
            Area area{};
            if (lane < run.count) {
                space_.node[lane] = tree.nodes[space_.drawn[run.first + lane]];
                area = area_of(space_.node[lane], point.origin);
            }
            space_.area[lane] = area.word;
            before[lane] = area.texels;
        });
        const std::uint32_t texels = group_.sums_before(before);
        group_.each([&](std::uint32_t lane) { space_.before[lane] = before[lane]; });
        for (std::uint32_t first = 0; first < texels; first += LaneGroup::width)
            group_.each([&](std::uint32_t lane) {
                if (first + lane >= texels) return;
                const std::uint32_t drawn = owner(first + lane);
                const std::uint32_t texel =
                    texel_of(space_.area[drawn], first + lane - space_.before[drawn]);
                SurfelRay ray = point;
                ray.direction = space_.direction[texel];
                SurfelHit hit;
                detail::meet_disc(tree, space_.node[drawn], space_.drawn[run.first + drawn], ray,
                                  hit);
                if (hit.node != SurfelHit::none) keep(texel, hit);
            });
    }

    /// The node to which one of the texels belongs that are counted over all of them: the last with
    /// no more before it.
    [[nodiscard]] MIR_HD std::uint32_t owner(std::uint32_t texel) const {
        std::uint32_t found = 0;
        for (std::uint32_t step = LaneGroup::width / 2; step > 0; step /= 2)
            if (space_.before[found + step] <= texel) found += step;
        return found;
    }

    /// A rectangle of texels in a word: its first column, row and width, eight bits each.
    struct Area {
        std::uint32_t word;
        std::uint32_t texels;
    };

    /// Texels that a node may cover.
    [[nodiscard]] MIR_HD Area area_of(const SurfelNode& node, Vec3 origin) const {
        const Vec3 to_centre = node.centre - origin;
        const TexelReach reach =
            texels_.reach(SeenSphere(to_centre, detail::padded_radius(node, to_centre)));
        const Span y = inside(span(reach.low.y, reach.high.y, jitter_.y));
        const Span all_x = span(reach.low.x, reach.high.x, jitter_.x);
        const Span x = Texels::goes_around ? once_around(all_x) : inside(all_x);
        if (x.last < x.first || y.last < y.first) return {};
        const auto width = static_cast<std::uint32_t>(x.last - x.first + 1);
        const auto height = static_cast<std::uint32_t>(y.last - y.first + 1);
        const std::uint32_t column = around(static_cast<std::uint32_t>(x.first));
        return {column | static_cast<std::uint32_t>(y.first) << 8 | width << 16, width * height};
    }

    /// Number k of a rectangle, row by row.
    [[nodiscard]] MIR_HD std::uint32_t texel_of(std::uint32_t area, std::uint32_t k) const {
        const std::uint32_t width = area >> 16;
        const std::uint32_t row = k / width;
        const std::uint32_t column = (area & 0xFFu) + (k - row * width);
        return ((area >> 8 & 0xFFu) + row) * side_ + (column < side_ ? column : column - side_);
    }

    MIR_HD void keep(std::uint32_t texel, const SurfelHit& hit) {
        std::uint32_t t = 0;
        memcpy(&t, &hit.t, sizeof(t));
        LaneGroup::put_least(space_.nearest[texel], std::uint64_t{t} << 32 | hit.node);
    }

    /// Texels on an axis; none when the last comes before the first.
    struct Span {
        int first;
        int last;
    };

    /// Those whose directions lie between two places, `jitter` being theirs inside of texels.
    [[nodiscard]] MIR_HD Span span(float low, float high, float jitter) const {
        const auto texels = static_cast<float>(side_);
        return {static_cast<int>(ceilf(low * texels - jitter)),
                static_cast<int>(floorf(high * texels - jitter))};
    }
    [[nodiscard]] MIR_HD Span inside(Span s) const {
        const int end = static_cast<int>(side_) - 1;
        return {s.first > 0 ? s.first : 0, s.last < end ? s.last : end};
    }
    [[nodiscard]] MIR_HD Span once_around(Span s) const {
        const int most = s.first + static_cast<int>(side_) - 1;
        return {s.first, s.last < most ? s.last : most};
    }
    /// Spans start less than two turns below 0.
    [[nodiscard]] MIR_HD std::uint32_t around(std::uint32_t i) const {
        return (i + 2 * side_) % side_;
    }

    const LaneGroup& group_;
    Workspace& space_;
    const Texels& texels_;
    std::uint32_t side_;
    Vec2 jitter_;
};

}  // namespace mir
