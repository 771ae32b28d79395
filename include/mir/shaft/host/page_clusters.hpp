// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/visibility.hpp"
#include "mir/data/soa.hpp"
#include "mir/shaft/exact/luxel_pages.hpp"
#include "mir/shaft/exact/page_compactness.hpp"
#include "mir/shaft/host/detail/page_splitter.hpp"

#include <algorithm>
#include <array>
#include <limits>

namespace mir {

/// The luxels of one page, optionally sorted, with masks of VPLs they see. Sorting makes packets
/// compact. Masks are written in sorted order and read in blocked order. The order decides speed,
/// never bits. The planes of the tile must outlive it. For one thread.
class PageClusters {
 public:
    static constexpr std::uint32_t most_vpls = 16;  ///< whose masks are kept

    /// Of a page of `tile`, whose planes are in blocked order. They are copied by sort() alone.
    PageClusters(const SoaView<const Hit>& tile, const LuxelPage& page)
        : tile_(tile), page_(page), count_(page.luxels()) {}

    /// Of the blocked order. False when packets reach from one surface to another (RunSizes):
    /// sorting is worth its while.
    [[nodiscard]] bool is_compact() const {
        RunSizes sizes;
        Box all;
        for (std::uint32_t first = 0; first < count_; first += width) {
            Box packet;
            for (std::uint32_t k = first; k < first + width; ++k) packet.add(in_slot(k));
            sizes.add(packet.diagonal());
            all.low = glm::min(all.low, packet.low);
            all.high = glm::max(all.high, packet.high);
        }
        return sizes.are_compact(all.diagonal());
    }

    /// Puts the luxels in order: aligned runs of 16, 32, ... lie close together (PageSplitter),
    /// empty ones come last. Does nothing the second time, or where all are empty. Not while masks
    /// are kept.
    void sort() {
        if (is_ordered_) return;
        detail::PageNumbers used;
        const std::uint32_t used_count = list_luxels(used);
        if (used_count == 0) return;
        detail::PageCoordinates coordinates;
        for (std::uint32_t i = 0; i < used_count; ++i) {
            const Vec3 p = in_slot(used[i]).position;
            coordinates[0][i] = p.x;
            coordinates[1][i] = p.y;
            coordinates[2][i] = p.z;
        }
        const detail::PageSplitter splitter(coordinates, used_count);
        for (std::uint32_t i = 0; i < used_count; ++i) slots_[i] = used[splitter.order()[i]];
        copy();
        is_ordered_ = true;
    }

    /// The 256 luxels of cluster `c` in their order. Of the page's block `c` unless sorted. Valid
    /// until sort(), and while this object stays where it is.
    [[nodiscard]] SoaView<const Hit> hits(std::uint32_t c) const {
        if (!is_ordered_) return {tile_.planes + page_.slot(c * BlockMask::luxels), tile_.stride};
        return {words_.data() + std::size_t{c} * BlockMask::luxels, count_};
    }
    /// Slot in the page of luxel i % 256 of cluster i / 256.
    [[nodiscard]] std::uint32_t slot(std::uint32_t i) const { return is_ordered_ ? slots_[i] : i; }
    /// False while every luxel is in its slot.
    [[nodiscard]] bool is_ordered() const { return is_ordered_; }

    /// Forgets all masks: nobody sees any VPL. To be called before set(), unless masks of all
    /// clusters and VPLs are set.
    void clear() { std::fill(masks_.begin(), masks_.begin() + count_ / width, PacketMasks{}); }
    /// Notes which luxels of cluster `c` see VPL `k` < most_vpls.
    void set(std::uint32_t c, std::uint32_t k, const BlockMask& mask) {
        for (std::uint32_t g = 0; g < BlockMask::packets; ++g)
            masks_[c * BlockMask::packets + g][k] = static_cast<std::uint16_t>(mask.packet[g]);
    }

    /// Puts the masks of all clusters into blocked order.
    void restore() {
        if (!is_ordered_) return;
        Masks found;
        std::copy(masks_.begin(), masks_.begin() + count_ / width, found.begin());
        for (std::uint32_t g = 0; g < count_ / width; ++g) {
            PacketMasks masks{};
            // Unrolled, so that the masks stay in a register; without shifts, which C++ would
            // widen. nvcc does not know the pragma.
#if !defined(__CUDACC__)
#pragma GCC unroll 16
#endif
            for (std::uint32_t bit = 0; bit < width; ++bit) {
                const std::uint32_t place = places_[g * width + bit];
                const PacketMasks& from = found[place / width];
                const auto there = static_cast<std::uint16_t>(1u << place % width);
                const auto here = static_cast<std::uint16_t>(1u << bit);
                for (std::uint32_t k = 0; k < most_vpls; ++k)
                    masks[k] |= (from[k] & there) != 0 ? here : std::uint16_t{0};
            }
            masks_[g] = masks;
        }
    }

    /// After restore(): which luxels of block `b` of the page see VPL `k`.
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
    using PacketMasks = std::array<std::uint16_t, most_vpls>;
    using Masks = std::array<PacketMasks, LuxelPage::most_luxels / width>;

    /// Around the positions of luxels, metres; upside down while there is none.
    struct Box {
        Vec3 low{std::numeric_limits<float>::infinity()};
        Vec3 high{-std::numeric_limits<float>::infinity()};

        void add(const Hit& hit) {
            if (is_empty(hit)) return;
            low = glm::min(low, hit.position);
            high = glm::max(high, hit.position);
        }
        [[nodiscard]] float diagonal() const {
            return low.x <= high.x ? glm::length(high - low) : 0.0f;
        }
    };

    [[nodiscard]] Hit in_slot(std::uint32_t k) const { return tile_.load(page_.slot(k)); }

    /// Lists the slots of luxels that are not empty, and puts the others last. Returns how many are
    /// listed.
    [[nodiscard]] std::uint32_t list_luxels(detail::PageNumbers& used) {
        std::uint32_t used_count = 0;
        std::uint32_t last = count_ - 1;
        for (std::uint32_t k = 0; k < count_; ++k) {
            const std::uint32_t is_used = is_empty(in_slot(k)) ? 0 : 1;
            used[used_count] = slots_[last] = static_cast<std::uint16_t>(k);
            used_count += is_used;
            last -= 1 - is_used;
        }
        return used_count;
    }

    void copy() {
        const SoaView<Hit> planes{words_.data(), count_};
        for (std::uint32_t i = 0; i < count_; ++i) {
            planes.store(i, in_slot(slots_[i]));
            places_[slots_[i]] = static_cast<std::uint16_t>(i);
        }
    }

    SoaView<const Hit> tile_;
    LuxelPage page_;
    std::uint32_t count_;
    bool is_ordered_ = false;
    // Without values unless they are sorted.
    std::array<std::uint32_t, most_words> words_;  ///< planes of the luxels
    detail::PageNumbers slots_;                    ///< by place
    detail::PageNumbers places_;                   ///< by slot
    Masks masks_;                                  ///< without values where there is no luxel
};

}  // namespace mir
