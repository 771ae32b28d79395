// SPDX-License-Identifier: MIT
#pragma once

#include "mir/data/chain_health.hpp"
#include "mir/data/path_luminance.hpp"
#include "mir/data/vertex_attributes.hpp"
#include "mir/data/vpl_list.hpp"

#include <optional>
#include <vector>

namespace mir {

/// What separates a sampler's records from intensities.
enum class Normalisation {
    none,           ///< weights are final: `intensity` is J in W sr^-1
    image_response  ///< `intensity` is R, the radiance that leaves the point towards the camera's
                    ///< side, W m^-2 sr^-1; the normalisation stage makes J of it
};

/// One path VPL: a vertex that lights what the camera sees. The light path behind it is summed into
/// `intensity`.
struct VplRecord {
    Vpl vpl;                  ///< its intensity is what Normalisation says
    VplOrigin origin;         ///< surface or light that it lies on; equal for records of one point
    std::uint8_t bounce = 2;  ///< scattering events up to the camera: 1 direct, 2 one bounce
    std::uint16_t light_group = 0;  ///< group of the light that feeds it
    float weight = 1.0f;            ///< recorded states that it stands for
    float lobe_share = 0.0f;        ///< of its light: what leaves the surface in a lobe, spread as
                              ///< Lambertian here; 0 only on lamps and Lambertian surfaces, and
                              ///< of what has gone through a surface diffusely
};

/// The light that arrives at a VPL: what its surface makes a lobe of.
struct VplArrival {
    Vec3 towards_light{0};       ///< unit
    Vec3 shading_normal{0};      ///< unit, of the VPL's surface
    Rgb power;                   ///< P, W: radiant intensity towards w is P f(towards_light, w) cos
    std::uint32_t material = 0;  ///< of the surface
    VertexAttributes attributes;  ///< of the point
    bool is_front = true;         ///< the side where it arrives
};

/// True when two records lie at one geometric VPL.
MIR_HD inline bool is_same_vpl(const VplRecord& a, const VplRecord& b) {
    return same_place(a.origin, b.origin) && a.vpl.normal == b.vpl.normal;
}

/// Share of the records' summed intensity (luminance) that their surfaces send in lobes, 0..1.
inline float share_of_non_lambertian(const std::vector<VplRecord>& records) {
    double all = 0.0;
    double spread = 0.0;
    for (const VplRecord& r : records) {
        const double j = luminance(r.vpl.intensity);
        all += j;
        spread += j * static_cast<double>(r.lobe_share);
    }
    return all > 0.0 ? static_cast<float>(spread / all) : 0.0f;
}

/// What a sampler yields, in an order that depends on the sampler's options alone.
struct VplRecords {
    std::vector<VplRecord> records;    ///< aggregate() joins neighbours of one point
    std::vector<VplArrival> arrivals;  ///< one for each record where they were asked for, else none
    std::uint64_t paths = 0;           ///< light paths traced, those without a record included
    float emitted_power = 0.0f;        ///< luminance of the scene's emitted power, W
    float non_lambertian_share = 0.0f;  ///< of the records' intensity: what left in lobes
    double path_luminance = 0.0;  ///< P_c: mean image luminance of the paths that the records stand
                                  ///< for, W m^-2 sr^-1; only with Normalisation::image_response
    double states = 0.0;          ///< n: summed weights of all recorded states, the same
    std::optional<ChainHealth> health;  ///< of samplers that run Markov chains
    /// P_c by light paths with final intensities, from a few luxels, where measured.
    std::optional<PathLuminance> light_paths;
    double bootstrap_seconds = 0.0;  ///< wall time that they took until chains started
};

/// What a sampler recorded, and what is left to do to it.
struct SampledVpls {
    VplRecords records;                                 ///< as they come from the sampler
    Normalisation normalisation = Normalisation::none;  ///< none: intensities are final
};

/// Algorithm 2's aggregation: consecutive records of one point become one geometric VPL. Where
/// light keeps the direction that it came from, every record becomes one.
inline VplList aggregate(const VplRecords& from) {
    VplList list;
    list.reserve(from.records.size());
    if (!from.arrivals.empty()) {
        for (const VplRecord& r : from.records)
            list.push_back(r.vpl, r.origin, r.bounce, r.light_group, r.weight);
        return list;
    }
    for (const VplRecord& r : from.records)
        list.append(r.vpl, r.origin, r.bounce, r.light_group, r.weight);
    return list;
}

}  // namespace mir
