// SPDX-License-Identifier: MIT
#include "runtime/caustic_light.hpp"

#include "mir/runtime/film_layer.hpp"
#include "mir/sampling/faint_splats.hpp"

#include <algorithm>
#include <optional>
#include <span>
#include <tuple>

namespace mir {
namespace {

CausticPaths paths_of(const RenderSettings& s) {
    const std::uint64_t paths = saturating_mul(s.caustics, s.image.area());
    return {paths, s.bounce_limit(), s.sequence, s.seed};
}

/// What several paths bring to the luxels of some rows, added up in the order of paths.
class SplatSums {
 public:
    SplatSums(std::uint32_t first_row, std::uint32_t end_row, bool has_bounces)
        : first_row_(first_row), end_row_(end_row), most_bounces_(has_bounces ? 255 : 2) {}

    void add(const std::vector<CausticSplat>& splats) {
        for (CausticSplat s : splats) {
            if (s.y < first_row_ || s.y >= end_row_) continue;
            s.bounce = std::min(s.bounce, most_bounces_);
            all_.push_back(s);
        }
        if (all_.size() > 2 * merged_ + least) merge();
    }
    /// By rows, then columns, then bounces.
    [[nodiscard]] std::vector<CausticSplat> take() {
        merge();
        return std::move(all_);
    }

 private:
    static constexpr std::size_t least = 1u << 18;  ///< too few to look after

    void merge() {
        const auto place = [](const CausticSplat& s) { return std::tuple(s.y, s.x, s.bounce); };
        std::stable_sort(all_.begin(), all_.end(),
                         [&](const auto& a, const auto& b) { return place(a) < place(b); });
        std::size_t kept = 0;
        for (const CausticSplat& s : all_)
            if (kept > 0 && place(all_[kept - 1]) == place(s))
                all_[kept - 1].radiance += s.radiance;
            else
                all_[kept++] = s;
        all_.resize(kept);
        merged_ = kept;
    }

    std::uint32_t first_row_;
    std::uint32_t end_row_;
    std::uint8_t most_bounces_;  ///< further ones are shown together
    std::vector<CausticSplat> all_;
    std::size_t merged_ = 0;  ///< of them at the last merge()
};

/// Mean luminance of indirect light as the sampler of the VPLs knows it, or null.
const PathLuminance* indirect_light(const RenderStatistics& s) {
    if (s.health) return &s.health->luminance;
    return s.light_path_luminance ? &*s.light_path_luminance : nullptr;
}

/// Light paths that say whether all of them are worth their while; none where that is not asked or
/// would cost what it saves.
std::uint64_t paths_to_try(const RenderJob& job) {
    constexpr std::uint64_t enough = 1u << 17;
    const bool is_asked = job.settings.skip_faint_caustics &&
                          indirect_light(job.result.statistics) != nullptr &&
                          paths_of(job.settings).paths >= 2 * enough;
    return is_asked ? enough : 0;
}

/// How much all light paths bring at most, where the first ones say that it is next to nothing.
std::optional<double> faint(const RenderJob& job, std::span<const CausticSplat> first,
                            std::uint64_t tried) {
    constexpr double least_share = 1e-3;
    if (tried == 0) return std::nullopt;
    const auto share =
        faint_share(first, tried, paths_of(job.settings).paths,
                    *indirect_light(job.result.statistics), job.rays.grid.luxels().area());
    return share && *share < least_share ? share : std::nullopt;
}

/// The splats of all paths in some rows, those of the first `tried` ones known.
std::vector<CausticSplat> traced(RenderFrame& frame, const ImageBands& bands,
                                 const std::vector<CausticSplat>& first, std::uint64_t tried) {
    const RenderJob& job = frame.job();
    const CausticPaths paths = paths_of(job.settings);
    SplatSums sums(bands.first_row(), bands.end_row(), job.settings.bounce_layers);
    sums.add(first);
    constexpr std::uint64_t at_once = 1u << 18;
    for (std::uint64_t begin = tried; begin < paths.paths; begin += at_once)
        sums.add(frame.trace_caustics(paths, begin, std::min(begin + at_once, paths.paths)));
    return sums.take();
}

/// Adds splats of a band's rows to its layers.
void add_to_layers(std::span<const CausticSplat> splats, RenderFrame& by, const FrameBand& band,
                   std::vector<LayerPtr>& layers) {
    if (splats.empty()) return;
    const auto add_where = [&](FrameLayer& layer, const auto& wanted) {
        Image<Rgb> light(band.extent());
        for (const CausticSplat& s : splats)
            if (wanted(s.bounce)) light(s.x, s.y - band.first_row) += s.radiance;
        by.add(layer, *by.layer_of(band, std::move(light)));
    };
    add_where(*layers[direct_layer], [](std::uint8_t bounce) { return bounce == 1; });
    add_where(*layers[indirect_layer], [](std::uint8_t bounce) { return bounce > 1; });
    const std::size_t bounces = layers.size() - first_bounce_layer;
    for (std::size_t b = 1; b < bounces; ++b)
        add_where(*layers[first_bounce_layer + b], [&](std::uint8_t bounce) {
            return bounce == b + 1 || (b + 1 == bounces && bounce > bounces);
        });
}

}  // namespace

CausticLight::CausticLight(RenderFrame& frame, const ImageBands& bands) {
    RenderJob& job = frame.job();
    if (job.settings.caustics == 0 || job.lights.empty()) return;
    const auto stage = job.clock.measure(&StageSeconds::caustics);
    is_traced_ = job.with_surfaces([](const auto& surfaces) { return surfaces.bends_rays(); });
    if (!is_traced_) return;
    const CausticPaths paths = paths_of(job.settings);
    const std::uint64_t tried = paths_to_try(job);
    const std::vector<CausticSplat> first =
        tried > 0 ? frame.trace_caustics(paths, 0, tried) : std::vector<CausticSplat>{};
    RenderStatistics& s = job.result.statistics;
    s.faint_caustics = faint(job, first, tried);
    s.caustic_paths = s.faint_caustics ? tried : paths.paths;
    if (!s.faint_caustics) splats_ = traced(frame, bands, first, tried);
}

CausticRows CausticLight::add(RenderFrame& by, const FrameBand& band,
                              std::vector<LayerPtr>& layers) const {
    if (!is_traced_) return {};
    const CausticLayers seen =
        by.seen_caustics(band, std::span<const LayerPtr>(layers).subspan(first_bounce_layer));
    by.add(*layers[direct_layer], *seen.direct);
    by.add(*layers[indirect_layer], *seen.indirect);
    CausticRows rows{by.row_luminances(*seen.indirect), by.row_luminances(*seen.direct)};
    for (std::size_t y = 0; y < rows.all.size(); ++y) rows.all[y] += rows.direct[y];

    const std::uint32_t end = band.first_row + band.extent().height;
    const auto row_before = [](const CausticSplat& s, std::uint32_t y) { return s.y < y; };
    const auto first = std::lower_bound(splats_.begin(), splats_.end(), band.first_row, row_before);
    const auto last = std::lower_bound(first, splats_.end(), end, row_before);
    const std::span<const CausticSplat> splats(first, last);
    add_to_layers(splats, by, band, layers);
    for (const CausticSplat& s : splats) {
        const auto light = static_cast<double>(luminance(s.radiance));
        rows.all[s.y - band.first_row] += light;
        if (s.bounce == 1) rows.direct[s.y - band.first_row] += light;
    }
    return rows;
}

}  // namespace mir
