// SPDX-License-Identifier: MIT
#pragma once

#include "mir/blocks/lit_vpls.hpp"
#include "mir/cuts/cut_policy.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <memory>

namespace mir {

/// Estimates how far the picks of a block's luxels lie from their nodes' light. One pick a node
/// does not tell its variance; the sixteen luxels of a square, which pick from other sixteenths of
/// the same node, do. A luxel gets half the mean square difference of its pick from the others',
/// summed over nodes. That is the variance where the luxels of a square are lit alike, for picks of
/// a node never agree more than independent ones; what they differ otherwise comes on top. For one
/// thread. Source: Wolter, "Introduction to Variance Estimation", 2007, 2.4 (random groups).
template <InstructionSet Set, Shading F>
class PickSpread {
 public:
    /// Nodes that it holds at a time.
    static constexpr std::uint32_t capacity = 64;

    /// Of luxels of an InterleavedBlock. Both must outlive it.
    PickSpread(const CutBlock<F>& block, const F& shading) : block_(block), shading_(shading) {}

    /// Turns to a group, 0..15.
    void start(std::uint32_t group) {
        shade();
        group_ = group;
    }

    /// Takes what `vpl` brings as the pick of a node to the lit luxels of the group. `node` is
    /// counted from the first one after finish().
    void add(std::uint32_t node, const Vpl& vpl, const BlockMask& lit) {
        nodes_[count_++] = node;
        batch_.add(vpl, lit);
        if (batch_.is_full()) shade();
    }

    /// Adds the spread of the `nodes` that all groups have met since the last call.
    void finish(std::uint32_t nodes) {
        shade();
        for (std::uint32_t square = 0; square < blocks::group_size; ++square)
            add_square(square, nodes);
        light_->fill({});
    }

    /// Variance of the luminance of a luxel, by its place in the block, W^2 m^-4 sr^-2. Not less
    /// than the mean of its square: a luxel whose picks miss the light has little spread of its
    /// own.
    [[nodiscard]] float variance(std::uint32_t place) const {
        const std::uint32_t square = place % blocks::group_size;
        double sum = 0.0;
        double count = 0.0;
        for (std::uint32_t g = 0; g < blocks::groups_per_block; ++g) {
            if ((block_.candidates[g] >> square & 1u) == 0) continue;
            sum += variance_[g * blocks::group_size + square];
            ++count;
        }
        if (!block_.counts(place)) return 0.0f;
        constexpr double most = std::numeric_limits<float>::max();
        return static_cast<float>(std::min(std::max(variance_[place], sum / count), most));
    }

 private:
    using Luxels = std::array<float, BlockedLayout::block_size>;

    void shade() {
        if (count_ == 0) return;
        blocks::GroupRadiance light[blocks::LitVpls::capacity];
        batch_.template shade_each<Set>(block_, shading_, light);
        for (std::uint32_t i = 0; i < count_; ++i)
            for (std::uint32_t k = 0; k < blocks::group_size; ++k)
                (*light_)[nodes_[i]][group_ * blocks::group_size + k] =
                    luminance(Rgb{light[i].r[k], light[i].g[k], light[i].b[k]});
        count_ = 0;
    }

    /// Luxel `square` of each group lies in that square.
    void add_square(std::uint32_t square, std::uint32_t nodes) {
        std::uint32_t places[blocks::groups_per_block];
        std::uint32_t count = 0;
        for (std::uint32_t g = 0; g < blocks::groups_per_block; ++g)
            if ((block_.candidates[g] >> square & 1u) != 0)
                places[count++] = g * blocks::group_size + square;
        for (std::uint32_t node = 0; node < nodes; ++node) add_node((*light_)[node], places, count);
    }

    /// A luxel alone has the square of its pick, which is more than the variance.
    void add_node(const Luxels& light, const std::uint32_t* places, std::uint32_t count) {
        double sum = 0.0;
        double squares = 0.0;
        for (std::uint32_t i = 0; i < count; ++i) {
            const double y = light[places[i]];
            sum += y;
            squares += y * y;
        }
        if (squares == 0.0) return;
        const double n = count;
        for (std::uint32_t i = 0; i < count; ++i) {
            const double y = light[places[i]];
            variance_[places[i]] +=
                count == 1 ? squares : 0.5 * (n * y * y - 2.0 * y * sum + squares) / (n - 1.0);
        }
    }

    const CutBlock<F>& block_;
    const F& shading_;
    std::uint32_t group_ = 0;
    std::uint32_t count_ = 0;
    std::uint32_t nodes_[blocks::LitVpls::capacity] = {};
    blocks::LitVpls batch_;
    std::unique_ptr<std::array<Luxels, capacity>> light_ =
        std::make_unique<std::array<Luxels, capacity>>();
    std::array<double, BlockedLayout::block_size> variance_{};
};

}  // namespace mir
