// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/load_whole.hpp"
#include "mir/micro/detail/node_lists.hpp"
#include "mir/micro/detail/point_group.hpp"
#include "mir/micro/micro_buffer_space.hpp"

#include <cstring>

namespace mir {

/// Small pictures of what is around points next to each other. What each of their texels sees first
/// of a tree of discs, along the directions of its point's `Texels`. Drawn by 32 lanes together, in
/// the memory of their group; host and device, the same bits, which do not depend on what other
/// pictures are drawn with one.
template <class Memory, class Texels>
class MicroBuffers {
 public:
    /// Memory of the group, a MicroBufferSpace, undefined before; holds the pictures afterwards.
    using Workspace = Memory;

    /// Pictures of `side` texels in each direction, 1 to Workspace::side; `points` lies in the
    /// workspace. What is passed in must outlive it.
    MIR_HD MicroBuffers(const LaneGroup& group, Workspace& space, MicroPoint<Texels>* points,
                        std::uint32_t side)
        : group_(group), space_(space), points_(points), side_(side) {}

    /// Makes picture k, below Workspace::pictures, the empty one of a point.
    MIR_HD void place(std::uint32_t k, const MicroPoint<Texels>& point) {
        const float step = 1.0f / static_cast<float>(side_);
        group_.each([&](std::uint32_t lane) {
            if (lane == 0) points_[k] = point;
            for (std::uint32_t i = lane; i < size(); i += LaneGroup::width) {
                space_.direction[k][i] =
                    point.texels.direction(step * (Vec2(i % side_, i / side_) + point.jitter));
                space_.nearest[k][i] = nothing;
            }
        });
        placed_ |= 1u << k;
    }

    /// Number of texels of a picture, counted row by row.
    [[nodiscard]] MIR_HD std::uint32_t size() const { return side_ * side_; }
    /// Unit, in the world.
    [[nodiscard]] MIR_HD Vec3 direction(std::uint32_t k, std::uint32_t texel) const {
        return space_.direction[k][texel];
    }
    /// Index of the node that a texel of picture k sees first, or SurfelHit::none.
    [[nodiscard]] MIR_HD std::uint32_t node(std::uint32_t k, std::uint32_t texel) const {
        return static_cast<std::uint32_t>(space_.nearest[k][texel]);
    }
    /// Distance of that node, metres.
    [[nodiscard]] MIR_HD float distance(std::uint32_t k, std::uint32_t texel) const {
        const auto word = static_cast<std::uint32_t>(space_.nearest[k][texel] >> 32);
        float t = 0.0f;
        memcpy(&t, &word, sizeof(t));
        return t;
    }

    /// Draws a tree into all pictures that have a place, in one walk. It goes down to discs, or to
    /// nodes at most `threshold` times as large as the texels there and at which closest_surfel()
    /// would stop. A texel holds the nearest of those that its direction meets. Every step is one
    /// that all lanes have nodes for, as long as there is one. Source: Ritschel et al. 2009,
    /// section 4; nodes are met by all texels that they cover, not splatted into one, which leaves
    /// holes.
    template <Space S>
    MIR_HD void draw(const SurfelTreeView<S>& tree, float threshold) {
        if (tree.empty() || placed_ == 0) return;
        const float share = threshold / static_cast<float>(size());
        const Walk<S> walk{tree, share, {points_, placed_, share}};
        group_.each([&](std::uint32_t lane) {
            if (lane != 0) return;
            space_.unsure.node[0] = tree.root;
            space_.unsure.pictures[0] = static_cast<std::uint8_t>(placed_);
        });
        unsure_ = 1;
        while (waiting_ + unsure_ + ended_ > 0) {
            const bool may_look = waiting_ == 0 || waiting_ >= room;
            if (ended_ >= LaneGroup::width || waiting_ + unsure_ == 0)
                cover(walk);
            else if (unsure_ >= LaneGroup::width || (unsure_ > 0 && may_look))
                look(walk);
            else
                take(walk);
        }
        meet(tree, drawn_);
    }

    /// Whether the walk for picture k ends at a node and does not pass it.
    template <Space S>
    [[nodiscard]] MIR_HD bool ends_at(const SurfelTreeView<S>& tree, std::uint32_t index,
                                      std::uint32_t k, float share) const {
        const SurfelNode& node = tree.nodes[index];
        return ends_at(node, points_[k], node.centre - points_[k].origin, share);
    }

 private:
    using Drawn = typename Workspace::Drawn;
    using Met = typename Workspace::Met;
    using Fate = detail::Fate;

    /// Infinitely far, SurfelHit::none.
    static constexpr std::uint64_t nothing = 0x7F800000FFFFFFFFull;
    static constexpr std::uint32_t room = Workspace::room;

    /// As many of `count` as may each add one to those that wait.
    [[nodiscard]] MIR_HD std::uint32_t portion(std::uint32_t count, std::uint32_t most) const {
        const std::uint32_t left = waiting_ < room ? room - waiting_ : 1;
        const std::uint32_t some = count < most ? count : most;
        return some < left ? some : left;
    }

    /// What a walk asks of all nodes.
    template <Space S>
    struct Walk {
        const SurfelTreeView<S>& tree;
        float share;  ///< steradians of a texel's node times its density
        detail::PointGroup group;
    };

    /// Takes the children of up to 16 waiting nodes, one for each lane. Does what is sure for all
    /// pictures together.
    template <Space S>
    MIR_HD void take(const Walk<S>& walk) {
        const std::uint32_t parents = portion(waiting_, LaneGroup::width / 2);
        waiting_ -= parents;
        LaneGroup::PerLane<std::uint32_t> nodes;
        LaneGroup::PerLane<std::uint32_t> right;
        LaneGroup::PerLane<std::uint32_t> opened;
        LaneGroup::PerLane<std::uint32_t> ended;
        LaneGroup::PerLane<std::uint32_t> unsure;
        group_.each([&](std::uint32_t lane) {
            nodes[lane] = opened[lane] = ended[lane] = unsure[lane] = 0;
            if (lane >= 2 * parents) return;
            const std::uint32_t parent = waiting_ + lane / 2;
            const std::uint32_t pictures = space_.waiting.pictures[parent];
            nodes[lane] =
                lane % 2 == 0 ? space_.waiting.node[parent] + 1 : space_.waiting.right[parent];
            const SurfelNode node = load_whole(walk.tree.nodes[nodes[lane]]);
            right[lane] = node.right;
            const Fate fate = fate_of(node, pictures, walk);
            opened[lane] = fate == Fate::opened ? pictures : 0;
            ended[lane] = fate == Fate::ended ? pictures : 0;
            unsure[lane] = fate == Fate::unsure ? pictures : 0;
        });
        waiting_ += detail::put_parents(group_, space_.waiting, waiting_, nodes, right, opened);
        ended_ += detail::put_nodes(group_, space_.ended, ended_, nodes, ended);
        unsure_ += detail::put_nodes(group_, space_.unsure, unsure_, nodes, unsure);
    }

    /// What becomes of a node in all pictures for which it is looked at.
    template <Space S>
    [[nodiscard]] MIR_HD Fate fate_of(const SurfelNode& node, std::uint32_t pictures,
                                      const Walk<S>& walk) const {
        if constexpr (Workspace::pictures == 1)
            return look_at(node, 0, walk.share);
        else
            return pictures == placed_ ? walk.group.fate(node) : Fate::unsure;
    }

    /// Looks at nodes that are unsure, one for each lane, for one picture after another. It is
    /// passed by, to be drawn, or its children wait.
    template <Space S>
    MIR_HD void look(const Walk<S>& walk) {
        const std::uint32_t count = portion(unsure_, LaneGroup::width);
        unsure_ -= count;
        LaneGroup::PerLane<std::uint32_t> nodes;
        LaneGroup::PerLane<std::uint32_t> right;
        LaneGroup::PerLane<std::uint32_t> opened;
        LaneGroup::PerLane<std::uint32_t> ended;
        group_.each([&](std::uint32_t lane) {
            nodes[lane] = opened[lane] = ended[lane] = 0;
            if (lane >= count) return;
            nodes[lane] = space_.unsure.node[unsure_ + lane];
            const std::uint32_t pictures = space_.unsure.pictures[unsure_ + lane];
            const SurfelNode node = load_whole(walk.tree.nodes[nodes[lane]]);
            right[lane] = node.right;
            for (std::uint32_t k = 0; placed_ >> k != 0; ++k) {
                if ((pictures >> k & 1u) == 0) continue;
                const Fate seen = look_at(node, k, walk.share);
                opened[lane] |= seen == Fate::opened ? 1u << k : 0;
                ended[lane] |= seen == Fate::ended ? 1u << k : 0;
            }
        });
        waiting_ += detail::put_parents(group_, space_.waiting, waiting_, nodes, right, opened);
        ended_ += detail::put_nodes(group_, space_.ended, ended_, nodes, ended);
    }

    /// Finds the texels that ended nodes may cover. Each lane takes a node, for all pictures.
    template <Space S>
    MIR_HD void cover(const Walk<S>& walk) {
        const std::uint32_t count = ended_ < LaneGroup::width ? ended_ : LaneGroup::width;
        ended_ -= count;
        LaneGroup::PerLane<std::uint32_t> nodes;
        LaneGroup::PerLane<std::uint32_t> pictures;
        LaneGroup::PerLane<SurfelNode> node;
        LaneGroup::PerLane<TexelReach> reach;
        LaneGroup::PerLane<bool> is_near;
        group_.each([&](std::uint32_t lane) {
            pictures[lane] = 0;
            if (lane >= count) return;
            nodes[lane] = space_.ended.node[ended_ + lane];
            pictures[lane] = space_.ended.pictures[ended_ + lane];
            node[lane] = load_whole(walk.tree.nodes[nodes[lane]]);
            is_near[lane] = !walk.group.is_far(node[lane], side_);
            if (!is_near[lane]) reach[lane] = walk.group.reach(first_texels(), node[lane]);
        });
        for (std::uint32_t k = 0; placed_ >> k != 0; ++k) {
            LaneGroup::PerLane<TexelRectangle> texels;
            group_.each([&](std::uint32_t lane) {
                texels[lane] = {};
                if ((pictures[lane] >> k & 1u) == 0) return;
                if (is_near[lane]) reach[lane] = reach_of(node[lane], k);
                texels[lane] = {reach[lane], points_[k].jitter, side_, Texels::goes_around, k};
            });
            const std::uint32_t covers =
                group_.ballot([&](std::uint32_t lane) { return !texels[lane].is_empty(); });
            group_.each([&](std::uint32_t lane) {
                if (!texels[lane].is_empty())
                    space_.drawn[drawn_ + LaneGroup::count_before(covers, lane)] = {nodes[lane],
                                                                                    texels[lane]};
            });
            drawn_ += LaneGroup::count(covers);
            if (drawn_ >= LaneGroup::width) meet(walk.tree, LaneGroup::width);
        }
    }

    [[nodiscard]] MIR_HD const Texels& first_texels() const {
        return points_[LaneGroup::lowest(placed_)].texels;
    }

    /// What becomes of a node in picture k.
    [[nodiscard]] MIR_HD Fate look_at(const SurfelNode& node, std::uint32_t k, float share) const {
        const MicroPoint<Texels>& point = points_[k];
        const Vec3 to_centre = node.centre - point.origin;
        if (detail::lies_below(node, point.normal, to_centre,
                               detail::padded_radius(node, to_centre)))
            return Fate::passed_by;
        if (!ends_at(node, point, to_centre, share)) return Fate::opened;
        const bool is_above = glm::dot(point.normal, to_centre) >= 0.0f;
        return node.is_leaf() || is_above ? Fate::ended : Fate::passed_by;
    }

    [[nodiscard]] MIR_HD bool ends_at(const SurfelNode& node, const MicroPoint<Texels>& point,
                                      Vec3 to_centre, float share) const {
        if (node.is_leaf()) return true;
        const float solid_angle =
            share / point.texels.largest_density(SeenSphere(to_centre, node.radius));
        return detail::stops_at(node, point.normal, to_centre, cap_sine_squared(solid_angle));
    }

    /// Texels of picture k that a node may cover.
    [[nodiscard]] MIR_HD TexelReach reach_of(const SurfelNode& node, std::uint32_t k) const {
        const Vec3 to_centre = node.centre - points_[k].origin;
        return points_[k].texels.reach(to_centre, detail::padded_radius(node, to_centre));
    }

    /// Meets the last `count` of the nodes to be drawn, up to 32. A lane takes each texel that they
    /// may cover, for they cover one texel or many.
    template <Space S>
    MIR_HD void meet(const SurfelTreeView<S>& tree, std::uint32_t count) {
        drawn_ -= count;
        LaneGroup::PerLane<std::uint32_t> before;
        group_.each([&](std::uint32_t lane) {
            before[lane] = lane < count ? space_.drawn[drawn_ + lane].texels.size() : 0;
        });
        const std::uint32_t texels = group_.sums_before(before);
        group_.each([&](std::uint32_t lane) {
            if (lane >= count) return;
            const Drawn own = space_.drawn[drawn_ + lane];
            const Vec3 origin = points_[own.texels.picture()].origin;
            const SurfelNode node = load_whole(tree.nodes[own.node]);
            space_.met[lane] = {{node, own.node, origin}, own.texels, before[lane]};
        });
        for (std::uint32_t first = 0; first < texels; first += LaneGroup::width) {
            const std::uint32_t earlier = LaneGroup::count(group_.ballot(
                [&](std::uint32_t lane) { return lane < count && before[lane] < first; }));
            const std::uint32_t starts = group_.any_bits([&](std::uint32_t lane) {
                const std::uint32_t start = before[lane] - first;
                return lane < count && start < LaneGroup::width ? 1u << start : 0u;
            });
            group_.each([&](std::uint32_t lane) {
                if (first + lane >= texels) return;
                // The last node whose texels do not start behind this one.
                const std::uint32_t up_to = LaneGroup::count(starts & ((2u << lane) - 1u));
                const Met& met = space_.met[earlier + up_to - 1];
                keep_nearest(tree, met, first + lane - met.before);
            });
        }
    }

    /// Meets texel i of those that a node may cover.
    template <Space S>
    MIR_HD void keep_nearest(const SurfelTreeView<S>& tree, const Met& met, std::uint32_t i) {
        const std::uint32_t k = met.texels.picture();
        const std::uint32_t texel = met.texels.texel(i, side_);
        const SurfelRay ray{points_[k].origin, space_.direction[k][texel], points_[k].normal};
        const float t = met.disc.meet(tree, ray).t;
        if (!(t > 0.0f)) return;
        std::uint32_t word = 0;
        memcpy(&word, &t, sizeof(word));
        LaneGroup::put_least(space_.nearest[k][texel], std::uint64_t{word} << 32 | met.disc.node);
    }

    const LaneGroup& group_;
    Workspace& space_;
    MicroPoint<Texels>* points_;
    std::uint32_t side_;
    std::uint32_t placed_ = 0;   ///< pictures, a bit each
    std::uint32_t waiting_ = 0;  ///< lengths of what lies in the workspace
    std::uint32_t unsure_ = 0;
    std::uint32_t ended_ = 0;
    std::uint32_t drawn_ = 0;
};

}  // namespace mir
