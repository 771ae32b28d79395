// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/math.hpp"

namespace mir {

/// What a random number is for. Streams never share numbers, so adding a draw to one stage leaves
/// every other stage's results as they were.
enum class Stream : std::uint32_t {
    luxel = 1,
    lens,
    direct_light,
    light_path,
    pilot,
    test,
    bootstrap,       ///< independent paths that estimate P_c and seed the chains
    seeding,         ///< choice of the chains' first states
    mutation,        ///< proposals of a chain
    suffix,          ///< refreshed light ends of recorded states
    probe,           ///< luxels that estimate image responses before there is an image
    candidate,       ///< what resampled importance sampling chooses from
    reference,       ///< path tracer
    surfel_light,    ///< lamps as discs see them
    surfel_gather,   ///< directions in which discs look for discs
    gather,          ///< directions in which luxels look for discs
    pass,            ///< seeds of the passes of a progressive render
    residual,        ///< paths that trace back what the bound removed
    distant_vpls,    ///< directions towards the environment that all luxels share
    vsl,             ///< directions in which luxels see the spheres of VSLs
    missing,         ///< paths that tell what VPLs leave out
    surfel_place,    ///< where on a disc lamps are looked for, and rays begin
    cut,             ///< which VPL of a node a luxel gathers
    caustic,         ///< light paths that the camera sees through mirrors and glass
    specular_chain,  ///< where camera rays go on from mirrors and glass
    sky              ///< rays that tell where luxels see the environment
};

/// 128 bits as four words; a plain array, because device code cannot index std::array.
struct Bits128 {
    std::uint32_t word[4] = {};  ///< word[0] holds the lowest bits
    /// True when all bits are equal.
    friend MIR_HD constexpr bool operator==(const Bits128&, const Bits128&) = default;
};

/// Philox 4x32 with 10 rounds. 128 random bits from a 128-bit counter and a 64-bit key. Source:
/// Salmon et al., "Parallel random numbers: as easy as 1, 2, 3", SC 2011.
MIR_HD constexpr Bits128 philox4x32(Bits128 counter, std::uint64_t key) {
    std::uint32_t c0 = counter.word[0], c1 = counter.word[1];
    std::uint32_t c2 = counter.word[2], c3 = counter.word[3];
    std::uint32_t k0 = static_cast<std::uint32_t>(key), k1 = static_cast<std::uint32_t>(key >> 32);
    for (int round = 0; round < 10; ++round) {
        const std::uint64_t p0 = std::uint64_t{0xD2511F53u} * c0;
        const std::uint64_t p1 = std::uint64_t{0xCD9E8D57u} * c2;
        c0 = static_cast<std::uint32_t>(p1 >> 32) ^ c1 ^ k0;
        c2 = static_cast<std::uint32_t>(p0 >> 32) ^ c3 ^ k1;
        c1 = static_cast<std::uint32_t>(p1);
        c3 = static_cast<std::uint32_t>(p0);
        k0 += 0x9E3779B9u;
        k1 += 0xBB67AE85u;
    }
    return {{c0, c1, c2, c3}};
}

/// Maps 32 random bits to the 2^24 floats k 2^-24 of [0, 1). Never returns 1.
MIR_HD constexpr float to_unit_float(std::uint32_t bits) {
    return static_cast<float>(bits >> 8) * 0x1p-24f;
}

/// Counter-based source of uniform numbers in [0, 1). The i-th number is a pure function of (seed,
/// stream, index, i), on any machine and in any order. A small value; not shared by threads.
class Random {
 public:
    /// `index` names the consumer inside the stream, for example the luxel or the light path.
    MIR_HD constexpr Random(std::uint64_t seed, Stream stream, std::uint64_t index)
        : key_(seed), stream_(static_cast<std::uint32_t>(stream)), index_(index) {}

    /// Number of dimension `dimension`; leaves the sequence of next() alone.
    [[nodiscard]] MIR_HD constexpr float at(std::uint32_t dimension) const {
        return to_unit_float(block(dimension / 4).word[dimension % 4]);
    }

    /// The next number of the sequence, which begins with dimension 0.
    MIR_HD constexpr float next() {
        if (dimension_ % 4 == 0) block_ = block(dimension_ / 4);
        return to_unit_float(block_.word[dimension_++ % 4]);
    }

    /// The next two numbers of the sequence, x first.
    MIR_HD Vec2 next_2d() {
        const float x = next();
        return {x, next()};
    }

    /// Bits of the dimensions 4 number .. 4 number + 3.
    [[nodiscard]] MIR_HD constexpr Bits128 block(std::uint32_t number) const {
        return philox4x32({{number, stream_, static_cast<std::uint32_t>(index_),
                            static_cast<std::uint32_t>(index_ >> 32)}},
                          key_);
    }

 private:
    std::uint64_t key_;
    std::uint32_t stream_;
    std::uint64_t index_;
    std::uint32_t dimension_ = 0;
    Bits128 block_{};
};

/// Random::at() for who asks for neighbouring dimensions one after the other. The last four numbers
/// are kept, because making one costs as much as making four. Not shared by threads.
class NearbyNumbers {
 public:
    /// Begins with the numbers of dimensions 0 to 3 at hand.
    MIR_HD constexpr explicit NearbyNumbers(const Random& random)
        : random_(random), block_(random.block(0)) {}

    /// Random::at(), with its bits.
    [[nodiscard]] MIR_HD constexpr float at(std::uint32_t dimension) {
        if (dimension / 4 != number_) block_ = random_.block(number_ = dimension / 4);
        return to_unit_float(block_.word[dimension % 4]);
    }

 private:
    Random random_;
    std::uint32_t number_ = 0;
    Bits128 block_;
};

}  // namespace mir
