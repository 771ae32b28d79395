// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/executor.hpp"
#include "mir/data/path_luminance.hpp"
#include "mir/data/vpl_record.hpp"
#include "mir/sampling/image_probe.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace mir {

namespace detail {

/// First records of the paths that have any, and the end of the last. Bounces rise along a path.
inline std::vector<std::size_t> path_starts(const std::vector<VplRecord>& records) {
    std::vector<std::size_t> starts;
    for (std::size_t i = 0; i < records.size(); ++i)
        if (i == 0 || records[i].bounce <= records[i - 1].bounce) starts.push_back(i);
    starts.push_back(records.size());
    return starts;
}

}  // namespace detail

/// P_c by the light paths of a sampler whose intensities are final. Its standard error follows from
/// how much each path gives to the luxels of `probe`: few paths that bring most of the light make
/// it large, and a picture of such VPLs is mostly too dark and sometimes far too bright. Of more
/// than `most` records some paths are looked at, evenly; error and counts are those of all.
/// `sampled` comes as a sampler of light paths gives it, path after path. The same bits for any
/// executor.
template <Bsdf B, Visibility V, Executor E>
[[nodiscard]] PathLuminance light_path_luminance(const VplRecords& sampled,
                                                 const ImageProbe<B, V>& probe, E& executor,
                                                 std::size_t most = 1024) {
    const std::vector<std::size_t> starts = detail::path_starts(sampled.records);
    const std::size_t stride = sampled.records.size() / most + 1;
    const std::size_t lit = (starts.size() - 1 + stride - 1) / stride;
    std::vector<double> light(lit);
    executor.for_each(lit, [&](std::size_t i) {
        const std::size_t path = i * stride;
        for (std::size_t r = starts[path]; r < starts[path + 1]; ++r) {
            const Vpl& vpl = sampled.records[r].vpl;
            light[i] += static_cast<double>(probe.flux(vpl, vpl.intensity));
        }
    });
    WeightMoments moments;
    for (const double of_path : light) moments.add(of_path * static_cast<double>(sampled.paths));
    const std::uint64_t looked_at = sampled.paths / stride;
    for (std::uint64_t dark = lit; dark < looked_at; ++dark) moments.add(0.0);
    PathLuminance estimate = moments.estimate();
    estimate.standard_error /= std::sqrt(static_cast<double>(stride));
    estimate.paths = sampled.paths;
    estimate.contributing = std::min(estimate.contributing * stride, sampled.paths);
    return estimate;
}

}  // namespace mir
