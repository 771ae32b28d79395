// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/backend.hpp"
#include "mir/core/lane_group.hpp"
#include "mir/core/strict_float.hpp"

#include <cmath>
#include <cstring>

// Kernels by which the axioms of Backend are tried (backend_suite.hpp).

namespace mirtest {

/// A number that has no pattern. Source: the finaliser of MurmurHash3, public domain.
MIR_HD inline std::uint32_t scrambled(std::uint32_t x) {
    x ^= x >> 16;
    x *= 0x85ebca6bu;
    x ^= x >> 13;
    x *= 0xc2b2ae35u;
    return x ^ (x >> 16);
}

/// Adds one to element i.
struct CountVisit {
    std::uint32_t* visits = nullptr;
    MIR_HD void operator()(std::uint32_t i) const { ++visits[i]; }
};

/// Element i of `to` becomes a function of element n - 1 - i of `from`.
struct MoveAcross {
    const std::uint32_t* from = nullptr;
    std::uint32_t* to = nullptr;
    std::uint32_t n = 0;
    MIR_HD void operator()(std::uint32_t i) const { to[i] = scrambled(from[n - 1 - i] + i); }
};

/// Writes element i after a while: `steps` scrambles of it.
struct SlowScramble {
    std::uint32_t* out = nullptr;
    std::uint32_t steps = 0;
    MIR_HD void operator()(std::uint32_t i) const {
        std::uint32_t x = i;
        for (std::uint32_t k = 0; k < steps; ++k) x = scrambled(x + k);
        out[i] = x;
    }
};

/// Bits without pattern, some found soon and some late, so that the rows of a word part ways.
struct ScrambledBits {
    [[nodiscard]] MIR_HD std::uint32_t row(std::uint32_t i) const { return scrambled(i); }
    [[nodiscard]] MIR_HD bool operator()(std::uint32_t row, std::uint32_t column) const {
        std::uint32_t x = scrambled(row ^ column);
        for (std::uint32_t k = x % 17; k > 0; --k) x = scrambled(x + column);
        return (x & 1u) != 0;
    }
};

/// Every member of LaneGroup once, with what lanes write to their workspace read by others; adds
/// what comes out to element i, and the number of lanes to a counter that all groups share.
struct GroupVisit {
    struct Workspace {
        std::uint32_t words[mir::LaneGroup::width];
    };

    std::uint32_t* out = nullptr;
    std::uint32_t* lanes = nullptr;

    MIR_HD void operator()(const mir::LaneGroup& group, std::uint32_t i, Workspace& space) const {
        constexpr std::uint32_t width = mir::LaneGroup::width;
        mir::LaneGroup::PerLane<std::uint32_t> values;
        group.each([&](std::uint32_t lane) { space.words[lane] = scrambled(i + lane) % 100; });
        group.each([&](std::uint32_t lane) { values[lane] = space.words[width - 1 - lane]; });
        const std::uint32_t odd =
            group.ballot([&](std::uint32_t lane) { return values[lane] % 2 == 1; });
        const std::uint32_t any =
            group.any_bits([&](std::uint32_t lane) { return 1u << values[lane] % 32; });
        const std::uint32_t sum = group.sums_before(values);
        const std::uint32_t last = group.broadcast(values, 17);
        mir::LaneGroup::PerLane<std::uint32_t> opposite;
        group.each([&](std::uint32_t lane) { opposite[lane] = (lane + 16) % width; });
        const auto gathered = group.gather(values, opposite);
        const std::uint32_t smaller =
            group.ballot([&](std::uint32_t lane) { return gathered[lane] < values[lane]; });
        static_cast<void>(group.add(*lanes, mir::LaneGroup::count(mir::LaneGroup::all)));
        group.each([&](std::uint32_t lane) {
            if (lane == 0)
                out[i] += odd + any + sum + last + smaller + mir::LaneGroup::bits(i % 35, i % 37) +
                          (odd != 0 ? mir::LaneGroup::lowest(odd) : 0);
        });
    }

    /// What comes out, written without groups.
    static std::uint32_t expected(std::uint32_t i) {
        std::uint32_t odd = 0, any = 0, sum = 0, last = 0, lowest = 0;
        for (std::uint32_t lane = 32; lane-- > 0;) {
            const std::uint32_t value = scrambled(i + 31 - lane) % 100;
            if (value % 2 == 1) odd |= 1u << lane, lowest = lane;
            any |= 1u << value % 32;
            sum += value;
            if (lane < 17) last += value;
        }
        std::uint32_t smaller = 0, before[32];
        for (std::uint32_t lane = 0, so_far = 0; lane < 32; ++lane) {
            before[lane] = so_far;
            so_far += scrambled(i + 31 - lane) % 100;
            if (lane >= 16 && before[lane - 16] < before[lane]) smaller |= 1u << lane;
        }
        std::uint32_t bits = 0;
        for (std::uint32_t k = i % 35; k < 32 && k < i % 35 + i % 37; ++k) bits |= 1u << k;
        return odd + any + sum + last + lowest + smaller + bits;
    }
};

/// The float that has these bits.
MIR_HD inline float float_of(std::uint32_t bits) {
    float value = 0.0f;
    std::memcpy(&value, &bits, sizeof value);
    return value;
}
/// The bits of a float.
MIR_HD inline std::uint32_t bits_of_float(float value) {
    std::uint32_t bits = 0;
    std::memcpy(&bits, &value, sizeof bits);
    return bits;
}

/// Adds up the bits of the smallest and the largest of each group's numbers, the latter by 3.
struct GroupExtremes {
    struct Workspace {};

    std::uint32_t* out = nullptr;

    /// Of any sign and size; zeros and infinities among them, and groups of nothing but zeros.
    MIR_HD static float number(std::uint32_t i, std::uint32_t lane) {
        const std::uint32_t word = scrambled(32 * i + lane);
        const std::uint32_t sign = word & 0x80000000u;
        if (i % 5 == 0 || word % 61 == 0) return float_of(sign);
        if (word % 67 == 0) return float_of(sign | 0x7F800000u);
        return float_of(sign | (word % 0x7F800000u));
    }

    /// Never zero.
    MIR_HD static std::uint32_t some_bits(std::uint32_t i) { return scrambled(i) >> i % 32 | 1u; }

    MIR_HD void operator()(const mir::LaneGroup& group, std::uint32_t i, Workspace&) const {
        mir::LaneGroup::PerLane<float> values;
        group.each_apart([&](std::uint32_t lane) { values[lane] = number(i, lane); });
        const std::uint32_t least = bits_of_float(group.smallest(values));
        const std::uint32_t most = bits_of_float(group.largest(values));
        group.each([&](std::uint32_t lane) {
            if (lane == 0) out[i] = least + 3 * most + mir::LaneGroup::highest(some_bits(i));
        });
    }

    /// What comes out, written without groups.
    static std::uint32_t expected(std::uint32_t i) {
        const auto is_less = [](float a, float b) {
            return a < b || (a == b && std::signbit(a) && !std::signbit(b));
        };
        float least = number(i, 0);
        float most = least;
        for (std::uint32_t lane = 1; lane < 32; ++lane) {
            const float value = number(i, lane);
            if (is_less(value, least)) least = value;
            if (is_less(most, value)) most = value;
        }
        std::uint32_t highest = 0;
        for (std::uint32_t left = some_bits(i); left > 1; left /= 2) ++highest;
        return bits_of_float(least) + 3 * bits_of_float(most) + highest;
    }
};

/// Functions of strict_float.hpp that are written twice, for host and device.
enum class StrictFunction { root, reciprocal, at_most_two };

/// Their bits at numbers one after the other.
struct StrictValues {
    /// All mantissas twice, then exponents.
    static constexpr std::uint32_t count = (1u << 24) + (1u << 16);

    StrictFunction function = StrictFunction::root;
    std::uint32_t* out = nullptr;

    /// All numbers from 1 to 4, then some from 2^-100 to 2^100, of reciprocals 2^-110 to 2^110. The
    /// smaller of two is also asked for where one is none.
    MIR_HD static float number(StrictFunction function, std::uint32_t i) {
        constexpr std::uint32_t one = 127;
        if (function == StrictFunction::at_most_two && i % 7 == 0) return float_of(0x7FC00000u);
        if (i < 1u << 24) return float_of((one << 23) + i);
        const std::uint32_t most = function == StrictFunction::reciprocal ? 110 : 100;
        return float_of((one - most + i % (2 * most)) << 23 | (scrambled(i) & 0x007FFFFFu));
    }

    MIR_HD void operator()(std::uint32_t i) const {
        const float a = number(function, i);
        out[i] = bits_of_float(function == StrictFunction::root ? mir::strict::usual_sqrt(a)
                               : function == StrictFunction::reciprocal
                                   ? mir::strict::usual_reciprocal(a)
                                   : mir::strict::at_most(a, 2.0f));
    }

    /// What comes out, by the operators of the host, which are rounded once.
    static std::uint32_t expected(StrictFunction function, std::uint32_t i) {
        const float a = number(function, i);
        if (function == StrictFunction::root) return bits_of_float(std::sqrt(a));
        if (function == StrictFunction::reciprocal) return bits_of_float(1.0f / a);
        return bits_of_float(a < 2.0f ? a : 2.0f);
    }
};

}  // namespace mirtest
