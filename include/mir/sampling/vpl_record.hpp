// SPDX-License-Identifier: MIT
#pragma once

#include "mir/data/vpl_list.hpp"

#include <vector>

namespace mir {

/// What separates a sampler's records from intensities.
enum class Normalisation {
    none  ///< the weights are final: `intensity` is J in W sr^-1
};

/// One path VPL: a vertex that lights what the camera sees, with the light path behind it summed
/// into `intensity`.
struct VplRecord {
    Vpl vpl;
    VplOrigin origin;
    bool lambertian = true;  ///< false: the surface's lobe was spread as a Lambertian one
};

/// Share of the records' summed intensity (luminance) that stands on non-Lambertian surfaces, 0..1.
inline float share_of_non_lambertian(const std::vector<VplRecord>& records) {
    double all = 0.0;
    double spread = 0.0;
    for (const VplRecord& r : records) {
        const double j = luminance(r.vpl.intensity);
        all += j;
        if (!r.lambertian) spread += j;
    }
    return all > 0.0 ? static_cast<float>(spread / all) : 0.0f;
}

/// What a sampler yields, in an order that depends on the sampler's options alone.
struct VplRecords {
    std::vector<VplRecord> records;
    std::uint64_t paths = 0;            ///< light paths traced, those without a record included
    float emitted_power = 0.0f;         ///< luminance of the scene's emitted power, W
    float non_lambertian_share = 0.0f;  ///< of the records' intensity, from surfaces with a lobe
};

/// Algorithm 2's aggregation: consecutive records of one point and bounce become one geometric VPL,
/// their intensities added. The list is sorted by bounce.
inline VplList aggregate(const VplRecords& from) {
    VplList list;
    for (const VplRecord& r : from.records) list.append(r.vpl, r.origin);
    list.sort_by_bounce();
    return list;
}

}  // namespace mir
