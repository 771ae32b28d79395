// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/visibility.hpp"
#include "mir/shaft/luxel_pages.hpp"
#include "mir/shaft/page_compactness.hpp"

#include <algorithm>
#include <array>
#include <limits>

namespace mir {

namespace detail {

/// Luxels of a page are told apart by their positions.
using PagePositions = std::array<Vec3, LuxelPage::most_luxels>;
/// Numbers of luxels of a page, its slots.
using PageSlots = std::array<std::uint16_t, LuxelPage::most_luxels>;

/// Takes a run of luxels apart where some of its packets of sixteen reach from one surface to
/// another (RunSizes): by the middle of the widest axis, again and again, until none does. Each
/// part keeps the order that it had, which is that of the image: there, luxels of one surface are
/// neighbours already.
class SurfaceSplitter {
 public:
    /// `positions`, metres, by slot. Both must outlive it.
    SurfaceSplitter(const PagePositions& positions, PageSlots& order)
        : positions_(positions), order_(order) {}

    /// Orders `count` luxels from place `first` on; false when they stay as they are.
    bool split(std::uint32_t first, std::uint32_t count) {
        for (bool moved = false;; moved = true) {
            const Box all = measure(first, count);
            if (all.is_compact) return moved;
            const std::uint32_t low = part(first, count, widest(all), middle(all));
            const std::uint32_t high = count - low;
            if (low == 0 || high == 0) return true;
            // Goes on with the larger part, so that no more than ten calls are under way.
            split(low < high ? first : first + low, std::min(low, high));
            if (low < high) first += low;
            count = std::max(low, high);
        }
    }

 private:
    static constexpr std::uint32_t width = PointPacket::width;
    static constexpr float infinity = std::numeric_limits<float>::infinity();

    struct Box {
        Vec3 low{infinity};
        Vec3 high{-infinity};
        bool is_compact = true;

        [[nodiscard]] float diagonal() const { return glm::length(high - low); }
    };

    [[nodiscard]] Box measure(std::uint32_t first, std::uint32_t count) const {
        Box all;
        RunSizes sizes;
        for (std::uint32_t i = 0; i < count; i += width) {
            Box packet;
            for (std::uint32_t k = i; k < std::min(i + width, count); ++k) {
                const Vec3 p = positions_[order_[first + k]];
                packet.low = glm::min(packet.low, p);
                packet.high = glm::max(packet.high, p);
            }
            sizes.add(packet.diagonal());
            all.low = glm::min(all.low, packet.low);
            all.high = glm::max(all.high, packet.high);
        }
        all.is_compact = count <= width || sizes.are_compact(all.diagonal());
        return all;
    }
    [[nodiscard]] static int widest(const Box& box) {
        const Vec3 size = box.high - box.low;
        if (size.x >= size.y && size.x >= size.z) return 0;
        return size.y >= size.z ? 1 : 2;
    }
    [[nodiscard]] static Vec3 middle(const Box& box) { return 0.5f * (box.low + box.high); }

    /// Puts luxels that lie below the middle first; returns how many these are.
    std::uint32_t part(std::uint32_t first, std::uint32_t count, int axis, Vec3 middle) {
        const auto begin = order_.begin() + first;
        PageSlots high;
        std::uint32_t low_count = 0;
        std::uint32_t high_count = 0;
        for (std::uint32_t k = 0; k < count; ++k) {
            const std::uint16_t slot = begin[k];
            const bool is_low = positions_[slot][axis] <= middle[axis];
            begin[low_count] = slot;
            high[high_count] = slot;
            low_count += is_low ? 1 : 0;
            high_count += is_low ? 0 : 1;
        }
        std::copy(high.begin(), high.begin() + high_count, begin + low_count);
        return low_count;
    }

    const PagePositions& positions_;
    PageSlots& order_;
};

}  // namespace detail

/// The luxels of a page on the host, in an order in which packets and blocks lie close together,
/// and masks of who of them sees some VPLs: these come in that order and leave in blocked order. It
/// decides speed, never bits. For one thread.
class PageClusters {
 public:
    static constexpr std::uint32_t most_vpls = 16;  ///< of which masks are kept

    /// Copies the luxels of a page of `tile`, whose planes are in blocked order. Empty ones come
    /// last, if any luxel changes its place.
    PageClusters(const SoaView<const Hit>& tile, const LuxelPage& page) : count_(page.luxels()) {
        for (std::uint32_t k = 0; k < count_; ++k) planes().store(k, tile.load(page.slot(k)));
        detail::PagePositions positions;
        is_ordered_ = order(positions);
        if (is_ordered_) move();
    }

    /// In their order: runs of 16 and of 256 lie close together.
    [[nodiscard]] SoaView<const Hit> hits() const { return {words_.data(), count_}; }
    /// Slot in the page of the luxel at place `i` of hits().
    [[nodiscard]] std::uint32_t slot(std::uint32_t i) const { return is_ordered_ ? slots_[i] : i; }
    /// False when every luxel stays in its slot.
    [[nodiscard]] bool is_ordered() const { return is_ordered_; }

    /// Notes who of cluster `c`, luxels 256 c and on of hits(), sees VPL `k` < most_vpls.
    void set(std::uint32_t c, std::uint32_t k, const BlockMask& mask) {
        for (std::uint32_t g = 0; g < BlockMask::packets; ++g)
            masks_[c * BlockMask::packets + g][k] = mask.packet[g];
    }

    /// Puts the masks of all clusters into blocked order.
    void restore() {
        if (!is_ordered_) return;
        Masks found;
        std::copy(masks_.begin(), masks_.begin() + count_ / width, found.begin());
        for (std::uint32_t g = 0; g < count_ / width; ++g) {
            PacketMasks masks{};
            for (std::uint32_t bit = 0; bit < width; ++bit) {
                const std::uint32_t place = places_[g * width + bit];
                const PacketMasks& from = found[place / width];
                for (std::uint32_t k = 0; k < most_vpls; ++k)
                    masks[k] |= (from[k] >> place % width & 1u) << bit;
            }
            masks_[g] = masks;
        }
    }

    /// After restore(): who of block `b` of the page sees VPL `k`.
    [[nodiscard]] BlockMask get(std::uint32_t b, std::uint32_t k) const {
        BlockMask mask;
        for (std::uint32_t g = 0; g < BlockMask::packets; ++g)
            mask.packet[g] = masks_[b * BlockMask::packets + g][k];
        return mask;
    }

 private:
    static constexpr std::uint32_t width = PointPacket::width;
    static constexpr std::size_t most_words =
        std::size_t{SoaView<Hit>::words} * LuxelPage::most_luxels;
    /// By VPL: loops over VPLs are loops over neighbours in memory.
    using PacketMasks = std::array<std::uint32_t, most_vpls>;
    using Masks = std::array<PacketMasks, LuxelPage::most_luxels / width>;

    [[nodiscard]] SoaView<Hit> planes() { return {words_.data(), count_}; }

    /// Finds the order; false when luxels stay as they are.
    [[nodiscard]] bool order(detail::PagePositions& positions) {
        detail::PageSlots empty;
        std::uint32_t used_count = 0;
        std::uint32_t empty_count = 0;
        for (std::uint32_t k = 0; k < count_; ++k) {
            const Hit hit = hits().load(k);
            positions[k] = hit.position;
            const bool is_used = !is_empty(hit);
            slots_[used_count] = empty[empty_count] = static_cast<std::uint16_t>(k);
            used_count += is_used ? 1 : 0;
            empty_count += is_used ? 0 : 1;
        }
        std::copy(empty.begin(), empty.begin() + empty_count, slots_.begin() + used_count);
        return detail::SurfaceSplitter(positions, slots_).split(0, used_count);
    }

    void move() {
        const std::array<std::uint32_t, most_words> before = words_;
        const SoaView<const Hit> from{before.data(), count_};
        for (std::uint32_t i = 0; i < count_; ++i) {
            planes().store(i, from.load(slots_[i]));
            places_[slots_[i]] = static_cast<std::uint16_t>(i);
        }
    }

    // Without values where there is no luxel, or none changes its place.
    std::uint32_t count_;
    bool is_ordered_;
    std::array<std::uint32_t, most_words> words_;  ///< planes of the luxels
    detail::PageSlots slots_;                      ///< by place
    detail::PageSlots places_;                     ///< by slot
    Masks masks_;
};

}  // namespace mir
