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
#include <span>
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

/// Mean image luminance of a VPL, by so many parts of a probe's luxels from part `first` on. The
/// probe is an ImageProbe or what kernels read of one. W m^-2 sr^-1.
#if defined(__CUDACC__)
#pragma nv_exec_check_disable
#endif
template <class Probe>
MIR_HD double flux_by_looks(const Probe& probe, const Vpl& vpl, std::uint64_t first,
                            std::size_t looks) {
    if (looks == probe.parts()) return static_cast<double>(probe.flux(vpl, vpl.intensity));
    double sum = 0.0;
    for (std::size_t k = 0; k < looks; ++k)
        sum +=
            static_cast<double>(luminance(probe.response_of_part(vpl, first + k) * vpl.intensity));
    return sum / static_cast<double>(looks);
}

/// Which records of light paths are looked at for light_path_luminance(), by how many luxels.
class LightPathLooks {
 public:
    /// As many looks as all luxels of a probe of so many parts have at `most` records.
    LightPathLooks(const VplRecords& sampled, std::size_t probe_parts, std::size_t most)
        : starts_(detail::path_starts(sampled.records)), paths_(sampled.paths) {
        const std::size_t records = sampled.records.size();
        const std::size_t parts = std::max<std::size_t>(probe_parts, 1);
        stride_ = std::max<std::size_t>((records + most * parts - 1) / (most * parts), 1);
        looks_ = std::clamp<std::size_t>(most * parts / std::max<std::size_t>(records / stride_, 1),
                                         1, parts);
    }

    /// Paths with records that are looked at.
    [[nodiscard]] std::size_t lit() const { return (starts_.size() - 1 + stride_ - 1) / stride_; }
    /// First record of one of them.
    [[nodiscard]] std::size_t first(std::size_t i) const { return starts_[i * stride_]; }
    /// The record behind its last.
    [[nodiscard]] std::size_t end(std::size_t i) const { return starts_[i * stride_ + 1]; }
    /// Parts of the probe that look at each record.
    [[nodiscard]] std::size_t looks() const { return looks_; }

    /// What they say of P_c; `light` is what each path gives to the image, W m^-2 sr^-1, its power
    /// shared out over all paths.
    [[nodiscard]] PathLuminance estimate(std::span<const double> light) const;

 private:
    std::vector<std::size_t> starts_;
    std::uint64_t paths_;
    std::size_t stride_ = 1;
    std::size_t looks_ = 1;
};

inline PathLuminance LightPathLooks::estimate(std::span<const double> light) const {
    WeightMoments moments;
    for (const double of_path : light) moments.add(of_path * static_cast<double>(paths_));
    const std::uint64_t looked_at = paths_ / stride_;
    for (std::uint64_t dark = light.size(); dark < looked_at; ++dark) moments.add(0.0);
    PathLuminance estimate = moments.estimate();
    estimate.standard_error /= std::sqrt(static_cast<double>(stride_));
    estimate.paths = paths_;
    estimate.contributing = std::min<std::uint64_t>(estimate.contributing * stride_, paths_);
    return estimate;
}

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
    const LightPathLooks looks(sampled, probe.parts(), most);
    std::vector<double> light(looks.lit());
    executor.for_each(light.size(), [&](std::size_t i) {
        for (std::size_t r = looks.first(i); r < looks.end(i); ++r)
            light[i] += flux_by_looks(probe, sampled.records[r].vpl, r, looks.looks());
    });
    return looks.estimate(light);
}

}  // namespace mir
