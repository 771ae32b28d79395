// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/kd/detail/kd_split.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace mir::detail {

// Small nodes: the begins and ends of all fragments on the three axes are sorted side by side by a
// network of compare-exchanges, then every one of them is tried as a plane. No data-dependent
// branch at all.

inline constexpr std::size_t kd_sweep_limit = 32;  ///< fragments

/// Batcher's merge exchange (Knuth, The Art of Computer Programming 3, algorithm 5.2.2M). Calls
/// exchange(i, j), i < j.
template <class Exchange>
constexpr void merge_exchange(unsigned n, Exchange exchange) {
    unsigned top = 1;
    while (2 * top < n) top *= 2;
    for (unsigned p = top; p > 0; p /= 2) {
        unsigned q = top;
        unsigned r = 0;
        unsigned d = p;
        for (;;) {
            for (unsigned i = 0; i + d < n; ++i)
                if ((i & p) == r) exchange(i, i + d);
            if (q == p) break;
            d = q - p;
            q /= 2;
            r = p;
        }
    }
}

/// The networks for 4, 8, 12, ... 32 keys, one after the other.
struct SortingNetworks {
    struct Pair {
        std::uint8_t i = 0;
        std::uint8_t j = 0;
    };
    static constexpr unsigned step = 4;
    static constexpr unsigned sizes = kd_sweep_limit / step;

    std::array<Pair, 1024> pairs{};
    std::array<unsigned, sizes + 1> first{};

    constexpr SortingNetworks() {
        unsigned count = 0;
        for (unsigned s = 0; s < sizes; ++s) {
            merge_exchange((s + 1) * step, [&](unsigned i, unsigned j) {
                pairs[count].i = static_cast<std::uint8_t>(i);
                pairs[count++].j = static_cast<std::uint8_t>(j);
            });
            first[s + 1] = count;
        }
    }
};
inline constexpr SortingNetworks sorting_networks;

inline void exchange_lanes(Int4& a, Int4& b) {
    const Int4 smaller = a < b ? a : b;
    b = a < b ? b : a;
    a = smaller;
}

/// Sorts (network + 1) * 4 keys. Written out: they fit into registers, or nearly do.
template <unsigned network, unsigned... k>
void sort_in_registers(Int4* keys, std::integer_sequence<unsigned, k...>) {
    constexpr unsigned first = sorting_networks.first[network];
    constexpr unsigned n = (network + 1) * SortingNetworks::step;
    Int4 v[n];
    std::memcpy(v, keys, sizeof v);
    (exchange_lanes(v[sorting_networks.pairs[first + k].i], v[sorting_networks.pairs[first + k].j]),
     ...);
    std::memcpy(keys, v, sizeof v);
}

template <unsigned network>
void sort_in_registers(Int4* keys) {
    constexpr unsigned count =
        sorting_networks.first[network + 1] - sorting_networks.first[network];
    sort_in_registers<network>(keys, std::make_integer_sequence<unsigned, count>{});
}

inline void sort_few(Int4* keys, std::size_t quads) {
    switch (quads) {
        case 1:
            return sort_in_registers<0>(keys);
        case 2:
            return sort_in_registers<1>(keys);
        case 3:
            return sort_in_registers<2>(keys);
        case 4:
            return sort_in_registers<3>(keys);
        case 5:
            return sort_in_registers<4>(keys);
        case 6:
            return sort_in_registers<5>(keys);
        case 7:
            return sort_in_registers<6>(keys);
        default:
            return sort_in_registers<7>(keys);
    }
}

/// Merges what rises and then falls (Batcher's bitonic merge).
template <unsigned n>
void merge_bitonic(Int4* keys) {
    for (unsigned d = n / 2; d > 0; d /= 2)
        for (unsigned block = 0; block < n; block += 2 * d)
            for (unsigned i = block; i < block + d; ++i) exchange_lanes(keys[i], keys[i + d]);
}

inline constexpr Int4 last_key = Int4{} + 0x7FFFFFFF;

/// Sorts keys[0, n) in every lane; the array has room for 2 kd_sweep_limit keys.
inline void sort_lanes(Int4* keys, std::size_t n) {
    constexpr std::size_t most = std::size_t{SortingNetworks::step} * SortingNetworks::sizes;
    constexpr std::size_t step = SortingNetworks::step;
    const std::size_t all = n;
    if (n > most) n = (n + 1) / 2;
    const std::size_t quads = (n + step - 1) / step;
    if (all <= most) {
        std::fill(keys + n, keys + quads * step, last_key);
        return sort_few(keys, quads);
    }
    // Two halves, the second one turned round and put at the end of the array.
    Int4 second[most];
    std::copy(keys + n, keys + all, second);
    std::fill(second + (all - n), second + quads * step, last_key);
    std::fill(keys + n, keys + 2 * most, last_key);
    sort_few(keys, quads);
    sort_few(second, quads);
    std::reverse_copy(second, second + quads * step, keys + 2 * most - quads * step);
    merge_bitonic<2 * most>(keys);
}

/// Exact search among all planes through begins and ends of at most kd_sweep_limit fragments.
class KdSweep {
 public:
    explicit KdSweep(std::span<const KdFragment> fragments) : size_(2 * fragments.size()) {
        // The last bit tells begins from ends; ends come first where both coincide.
        for (std::size_t i = 0; i < fragments.size(); ++i) {
            keys_[2 * i] = ordered_keys(axes_only(fragments[i].low_lanes())) | 1;
            keys_[2 * i + 1] = ordered_keys(axes_only(fragments[i].high_lanes()));
        }
        sort_lanes(keys_, size_);
    }

    [[nodiscard]] KdSplit best(const KdCost& cost) const {
        const Float4 one = all_lanes(1.0f);
        Float4 below = all_lanes(0.0f);
        Float4 above = all_lanes(cost.count);
        // Planes with an empty side come first: among equals they are the cheaper ones to make.
        KdCandidates best{all_lanes(cost.limit)};
        best.try_empty_sides(cost, numbers_of(keys_[0] & -2), numbers_of(keys_[size_ - 1] & -2));
        for (std::size_t i = 0; i < size_; ++i) {
            const Float4 begins = __builtin_convertvector(keys_[i] & 1, Float4);
            const Float4 at = numbers_of(keys_[i] & -2);
            above += begins - one;
            best.keep_cheaper(cost(at, below, above), at, KdCutKind::parts);
            below += begins;
        }
        return best.best(cost.limit);
    }

 private:
    alignas(64) Int4 keys_[2 * kd_sweep_limit];
    std::size_t size_ = 0;
};

}  // namespace mir::detail
