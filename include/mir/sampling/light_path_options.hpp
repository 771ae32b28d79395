// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace mir {

/// When a light path ends.
enum class Termination {
    roulette,  ///< by chance, with the albedo as odds of survival: unbiased
    levels     ///< Keller's: floor(rho^n N) particles survive n bounces; consistent
};

/// Where the numbers of a light path come from.
enum class Sequence {
    random,  ///< independent Philox numbers
    halton   ///< Halton sequence over paths, shifted by the seed; random past its dimensions
};

/// How many VPLs instant radiosity wants, from what numbers, and where paths end.
struct InstantRadiosityOptions {
    std::uint32_t vpls = 256;  ///< wanted; the set comes close, see InstantRadiositySampler
    Termination termination = Termination::roulette;  ///< when paths end
    Sequence sequence = Sequence::random;             ///< numbers that paths are made of
    bool emitter_vpls = false;     ///< also place VPLs on the lamps: direct light by VPLs
    std::uint8_t max_bounce = 32;  ///< largest number of scattering events, 1..254
    /// Also keep how light arrives at VPLs (VplRecords::arrivals). The intensity of a VPL that is
    /// not Lambertian is then a guide alone, by Bsdf::albedo(): its light is that of the lobe.
    bool arrivals = false;
    std::uint64_t seed = 0;  ///< of all numbers, the pilot's too
};

}  // namespace mir
