// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/hd.hpp"

#include <atomic>
#include <bit>
#include <cstdint>

namespace mir {

/// Thirty-two lanes in step: a warp of the device, a loop on the host. Kernels of
/// Backend::Queue::for_each_group() are written for all lanes at once: what differs from lane to
/// lane is a PerLane, what each lane does a function of the lane's number, and everything else is
/// the same for all, loops above all. Source, and the results of kernels that only combine lanes by
/// the members below, are the same on both.
///
/// Every member must be called by all lanes together: never inside of each(), nor behind a
/// condition that differs between lanes.
class LaneGroup {
 public:
    static constexpr std::uint32_t width = 32;         ///< lanes
    static constexpr std::uint32_t all = 0xFFFFFFFFu;  ///< the bits of all lanes

    /// Whether lanes are those of a warp, none of them done before the others.
    static constexpr bool is_warp =
#if defined(__CUDA_ARCH__)
        true;
#else
        false;
#endif

    /// A value for each lane; a lane may touch its own alone.
    template <class T>
    class PerLane {
     public:
#if defined(__CUDA_ARCH__)
        /// The calling lane's own; the number is not looked at.
        MIR_HD T& operator[](std::uint32_t) { return value_; }
        /// The calling lane's own; the number is not looked at.
        MIR_HD const T& operator[](std::uint32_t) const { return value_; }

     private:
        T value_;
#else
        /// Value of a lane, 0 to width - 1.
        T& operator[](std::uint32_t lane) { return values_[lane]; }
        /// Value of a lane, 0 to width - 1.
        const T& operator[](std::uint32_t lane) const { return values_[lane]; }

     private:
        T values_[width];
#endif
    };

    /// Calls f(lane) for every lane. What lanes wrote to memory all lanes may read afterwards.
    template <class F>
    MIR_HD void each(const F& f) const {
#if defined(__CUDA_ARCH__)
        f(own_lane());
        __syncwarp();
#else
        for (std::uint32_t lane = 0; lane < width; ++lane) f(lane);
#endif
    }

    /// each() in which no lane waits for another. What a lane writes, no other may read or write
    /// between the each() before and the one after; what it reads, no other may write.
    template <class F>
    MIR_HD void each_apart(const F& f) const {
#if defined(__CUDA_ARCH__)
        f(own_lane());
#else
        each(f);
#endif
    }

    /// Bit k is f(k).
    template <class F>
    [[nodiscard]] MIR_HD std::uint32_t ballot(const F& f) const {
#if defined(__CUDA_ARCH__)
        return __ballot_sync(all, f(own_lane()));
#else
        std::uint32_t bits = 0;
        for (std::uint32_t lane = 0; lane < width; ++lane)
            bits |= static_cast<std::uint32_t>(f(lane)) << lane;
        return bits;
#endif
    }

    /// The bits that are set in f(k) of any lane k.
    template <class F>
    [[nodiscard]] MIR_HD std::uint32_t any_bits(const F& f) const {
#if defined(__CUDA_ARCH__) && __CUDA_ARCH__ >= 800
        return __reduce_or_sync(all, f(own_lane()));
#else
        PerLane<std::uint32_t> bits;
        each([&](std::uint32_t lane) { bits[lane] = f(lane); });
        return combined(bits, [](std::uint32_t a, std::uint32_t b) { return a | b; });
#endif
    }

    /// The value of one lane.
    [[nodiscard]] MIR_HD std::uint32_t broadcast(const PerLane<std::uint32_t>& values,
                                                 std::uint32_t lane) const {
#if defined(__CUDA_ARCH__)
        return __shfl_sync(all, values[lane], static_cast<int>(lane));
#else
        return values[lane];
#endif
    }

    /// For each lane the value of the lane that `from` names. Numbers are 0 to width - 1.
    [[nodiscard]] MIR_HD PerLane<std::uint32_t> gather(const PerLane<std::uint32_t>& values,
                                                       const PerLane<std::uint32_t>& from) const {
        PerLane<std::uint32_t> gathered;
#if defined(__CUDA_ARCH__)
        gathered[0] = __shfl_sync(all, values[0], static_cast<int>(from[0]));
#else
        for (std::uint32_t lane = 0; lane < width; ++lane) gathered[lane] = values[from[lane]];
#endif
        return gathered;
    }

    /// Replaces each value by the sum of those of the lanes before. Returns the sum of all.
    MIR_HD std::uint32_t sums_before(PerLane<std::uint32_t>& values) const {
#if defined(__CUDA_ARCH__)
        const std::uint32_t own = values[0];
        std::uint32_t sum = own;
        for (std::uint32_t step = 1; step < width; step *= 2) {
            const std::uint32_t before = __shfl_up_sync(all, sum, step);
            if (own_lane() >= step) sum += before;
        }
        values[0] = sum - own;
        return __shfl_sync(all, sum, width - 1);
#else
        std::uint32_t sum = 0;
        for (std::uint32_t lane = 0; lane < width; ++lane) {
            const std::uint32_t own = values[lane];
            values[lane] = sum;
            sum += own;
        }
        return sum;
#endif
    }

    /// All values, joined in pairs by `join`, in the same order on host and device. Lane 0 with 16,
    /// 1 with 17 and so on, then 0 with 8.
    template <class T, class Join>
    [[nodiscard]] MIR_HD T combined(PerLane<T> values, const Join& join) const {
#if defined(__CUDA_ARCH__)
        T value = values[0];
        for (std::uint32_t step = width / 2; step > 0; step /= 2)
            value = join(value, __shfl_down_sync(all, value, step));
        return __shfl_sync(all, value, 0);
#else
        for (std::uint32_t step = width / 2; step > 0; step /= 2)
            for (std::uint32_t lane = 0; lane < step; ++lane)
                values[lane] = join(values[lane], values[lane + step]);
        return values[0];
#endif
    }

    /// The smallest value; none may be NaN. -0 is below 0, on host and device.
    [[nodiscard]] MIR_HD float smallest(const PerLane<float>& values) const {
        const PerLane<std::int32_t> places = places_of(values);
#if defined(__CUDA_ARCH__) && __CUDA_ARCH__ >= 800
        return value_at(__reduce_min_sync(all, places[0]));
#else
        return value_at(
            combined(places, [](std::int32_t a, std::int32_t b) { return a < b ? a : b; }));
#endif
    }

    /// The largest value; see smallest().
    [[nodiscard]] MIR_HD float largest(const PerLane<float>& values) const {
        const PerLane<std::int32_t> places = places_of(values);
#if defined(__CUDA_ARCH__) && __CUDA_ARCH__ >= 800
        return value_at(__reduce_max_sync(all, places[0]));
#else
        return value_at(
            combined(places, [](std::int32_t a, std::int32_t b) { return a > b ? a : b; }));
#endif
    }

    /// Adds to a counter that groups share, and returns what it was before.
    MIR_HD std::uint32_t add(std::uint32_t& counter, std::uint32_t amount) const {
#if defined(__CUDA_ARCH__)
        std::uint32_t before = 0;
        if (own_lane() == 0) before = atomicAdd(&counter, amount);
        return __shfl_sync(all, before, 0);
#else
        return std::atomic_ref(counter).fetch_add(amount, std::memory_order_relaxed);
#endif
    }

    /// Makes `place` the smaller of itself and `value`; for any lane by itself. The place is of the
    /// group's own workspace. Lanes may read it after each().
    MIR_HD static void put_least(std::uint64_t& place, std::uint64_t value) {
#if defined(__CUDA_ARCH__)
        // Most values are not smaller, and a look costs less than an atomic operation.
        if (value < *static_cast<volatile std::uint64_t*>(&place))
            atomicMin(reinterpret_cast<unsigned long long*>(&place), value);
#else
        if (value < place) place = value;
#endif
    }

    /// Number of bits that are set below a lane's.
    [[nodiscard]] MIR_HD static std::uint32_t count_before(std::uint32_t bits, std::uint32_t lane) {
        return count(bits & ((1u << lane) - 1u));
    }

    /// `n` bits from bit `first` on; what lies beyond the last one is left out.
    [[nodiscard]] MIR_HD static std::uint32_t bits(std::uint32_t first, std::uint32_t n) {
#if defined(__CUDA_ARCH__)
        std::uint32_t mask = 0;
        asm("bmsk.clamp.b32 %0, %1, %2;" : "=r"(mask) : "r"(first), "r"(n));
        return mask;
#else
        return first < width ? (n < width ? (1u << n) - 1u : all) << first : 0u;
#endif
    }

    /// Number of bits that are set.
    [[nodiscard]] MIR_HD static std::uint32_t count(std::uint32_t bits) {
#if defined(__CUDA_ARCH__)
        return static_cast<std::uint32_t>(__popc(bits));
#else
        return static_cast<std::uint32_t>(std::popcount(bits));
#endif
    }

    /// Place of the lowest bit that is set; `bits` is not zero.
    [[nodiscard]] MIR_HD static std::uint32_t lowest(std::uint32_t bits) {
#if defined(__CUDA_ARCH__)
        return static_cast<std::uint32_t>(__ffs(static_cast<int>(bits)) - 1);
#else
        return static_cast<std::uint32_t>(std::countr_zero(bits));
#endif
    }

    /// Place of the highest bit that is set; `bits` is not zero.
    [[nodiscard]] MIR_HD static std::uint32_t highest(std::uint32_t bits) {
#if defined(__CUDA_ARCH__)
        return static_cast<std::uint32_t>(31 - __clz(static_cast<int>(bits)));
#else
        return static_cast<std::uint32_t>(std::bit_width(bits) - 1);
#endif
    }

 private:
    /// Integers in the order of the values. The device compares those of a warp in one instruction.
    [[nodiscard]] MIR_HD PerLane<std::int32_t> places_of(const PerLane<float>& values) const {
        PerLane<std::int32_t> places;
        each_apart([&](std::uint32_t lane) {
#if defined(__CUDA_ARCH__)
            places[lane] = with_sign_turned(__float_as_int(values[lane]));
#else
            places[lane] = with_sign_turned(std::bit_cast<std::int32_t>(values[lane]));
#endif
        });
        return places;
    }
    /// Back from places_of().
    [[nodiscard]] MIR_HD static float value_at(std::int32_t place) {
#if defined(__CUDA_ARCH__)
        return __int_as_float(with_sign_turned(place));
#else
        return std::bit_cast<float>(with_sign_turned(place));
#endif
    }
    /// Negative floats have their order reversed as integers; the same turns them back.
    [[nodiscard]] MIR_HD static std::int32_t with_sign_turned(std::int32_t bits) {
        return bits ^ ((bits >> 31) & 0x7FFFFFFF);
    }

#if defined(__CUDA_ARCH__)
    /// Thread blocks are runs of whole warps.
    MIR_HD static std::uint32_t own_lane() { return threadIdx.x % width; }
#endif
};

}  // namespace mir
