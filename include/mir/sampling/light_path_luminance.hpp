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

/// Mean image luminance of a VPL by so many parts of the probe's luxels, from part `first` on.
template <Bsdf B, Visibility V>
double flux_by_looks(const ImageProbe<B, V>& probe, const Vpl& vpl, std::size_t first,
                     std::size_t looks) {
    if (looks == probe.parts()) return static_cast<double>(probe.flux(vpl, vpl.intensity));
    double sum = 0.0;
    for (std::size_t k = 0; k < looks; ++k)
        sum +=
            static_cast<double>(luminance(probe.response_of_part(vpl, first + k) * vpl.intensity));
    return sum / static_cast<double>(looks);
}

}  // namespace detail

/// P_c by the light paths of a sampler whose intensities are final. Its standard error follows from
/// how much each path gives to the luxels of `probe`: few paths that bring most of the light make
/// it large, and a picture of such VPLs is mostly too dark and sometimes far too bright. There are
/// as many looks as all luxels have at `most` records: of more records each is looked at by fewer
/// luxels, sixteen at least, and of more than that allows some paths, evenly. Error and counts are
/// those of all.
/// `sampled` comes as a sampler of light paths gives it, path after path. The same bits for any
/// executor.
template <Bsdf B, Visibility V, Executor E>
[[nodiscard]] PathLuminance light_path_luminance(const VplRecords& sampled,
                                                 const ImageProbe<B, V>& probe, E& executor,
                                                 std::size_t most = 1024) {
    const std::vector<std::size_t> starts = detail::path_starts(sampled.records);
    const std::size_t parts = std::max<std::size_t>(probe.parts(), 1);
    const std::size_t stride =
        std::max<std::size_t>((sampled.records.size() + most * parts - 1) / (most * parts), 1);
    const std::size_t looks = std::clamp<std::size_t>(
        most * parts / std::max<std::size_t>(sampled.records.size() / stride, 1), 1, parts);
    const std::size_t lit = (starts.size() - 1 + stride - 1) / stride;
    std::vector<double> light(lit);
    executor.for_each(lit, [&](std::size_t i) {
        const std::size_t path = i * stride;
        for (std::size_t r = starts[path]; r < starts[path + 1]; ++r)
            light[i] += detail::flux_by_looks(probe, sampled.records[r].vpl, r, looks);
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
