// SPDX-License-Identifier: MIT
#include "runtime/image_bands.hpp"

#include "mir/core/limits.hpp"
#include "mir/data/blocked_layout.hpp"
#include "mir/data/visibility_matrix.hpp"
#include "mir/film/tap_table.hpp"

#include <algorithm>
#include <numeric>

namespace mir {
namespace {

/// Luxels scheduled together unless the settings say.
constexpr Extent default_tile{256, 256};

/// Tells a monitor, unless that is null, of a loop as long as it lasts.
class LoopingPairs {
 public:
    LoopingPairs(Monitor* monitor, std::uint64_t pairs) : monitor_(monitor), pairs_(pairs) {
        if (monitor_ == nullptr) return;
        monitor_->begin_loop(0);  // what the loop before has done is none of these
        monitor_->looping_contributions += pairs_;
    }
    LoopingPairs(const LoopingPairs&) = delete;
    LoopingPairs& operator=(const LoopingPairs&) = delete;
    ~LoopingPairs() {
        if (monitor_ != nullptr) monitor_->looping_contributions -= pairs_;
    }

 private:
    Monitor* monitor_;
    std::uint64_t pairs_;
};

}  // namespace

ImageBands::ImageBands(const RenderFrame& frame, std::uint32_t vpls, std::uint32_t end,
                       std::uint32_t first)
    : frame_(frame),
      tile_(whole_blocks(frame.job().settings.tile.value_or(default_tile))),
      first_(first),
      end_(end),
      rows_(choose_rows(vpls)) {}

ImageBands ImageBands::of_rows(const RenderFrame& frame, std::uint32_t vpls) {
    const RenderJob& job = frame.job();
    const LuxelGrid& grid = job.rays.grid;
    const PixelRows& rows = job.settings.rows;
    if (rows.count == 0) return {frame, vpls};
    // Luxels of other rows shine into these through the filter. Whole blocks and pixels, as of the
    // whole image: what is found block by block is the same.
    const std::uint32_t reach = detail::TapTable(grid, job.settings.filter).reach();
    const std::uint32_t grain = std::lcm(grid.per_pixel_y, BlockedLayout::side);
    const std::uint32_t first = (rows.first - std::min(rows.first, reach)) * grid.per_pixel_y;
    const std::uint32_t last =
        std::min(rows.first + rows.count + reach, grid.pixels.height) * grid.per_pixel_y;
    return {frame, vpls, std::min((last + grain - 1) / grain * grain, grid.luxels().height),
            first / grain * grain};
}

std::uint32_t ImageBands::choose_rows(std::uint32_t vpls) const {
    // Some 2 million luxels at a time, fewer where parts of a frame would have few bands each or
    // luxels have sums of paths; whole pixels, and whole tiles unless those are huge or bands low.
    const RenderSettings& settings = frame_.job().settings;
    const std::uint64_t parts = frame_.traits().parts;
    const bool has_paths = settings.integrator == Integrator::path;
    const std::uint64_t most = has_paths ? 1u << 18 : 1u << 21;
    const std::uint64_t luxels_per_band =
        parts == 1 ? most
                   : std::min(most, std::uint64_t{luxels().width} * (end_ - first_) / (4 * parts));
    const std::uint64_t pixel = frame_.job().rays.grid.per_pixel_y;
    const bool cuts_tiles = parts > 1 || has_paths;
    const std::uint64_t grain =
        pixel * (cuts_tiles ? BlockedLayout::side : std::min<std::uint64_t>(tile_.height, 256));
    const std::uint64_t rows =
        std::max<std::uint64_t>(luxels_per_band / luxels().width / grain, 1) * grain;
    const std::uint64_t least = pixel * BlockedLayout::side;
    const std::uint64_t least_bytes = saturating_mul(
        VisibilityMatrix::bytes_for({{0, 0, luxels().width, BlockedLayout::side}}, vpls), pixel);
    const std::uint64_t fitting = matrix_bytes(vpls) / std::max<std::uint64_t>(least_bytes, 1);
    const std::uint64_t fitting_rows = saturating_mul(std::max<std::uint64_t>(fitting, 1), least);
    return static_cast<std::uint32_t>(std::min({rows, fitting_rows, std::uint64_t{end_ - first_}}));
}

/// Of the matrix of one band. The host gains nothing by larger ones when bands are not kept.
std::uint64_t ImageBands::matrix_bytes(std::uint32_t vpls) const {
    const std::uint64_t limit = frame_.job().settings.limits.visibility_bytes;
    if (!frame_.traits().on_host || fit_together(vpls)) return limit;
    return std::min(limit, std::uint64_t{1} << 30);
}

BandPtr ImageBands::make(RenderFrame& by, std::uint32_t i) const {
    const auto stage = by.job().clock.measure(&StageSeconds::gbuffer);
    const std::uint32_t first_row = first_ + i * rows_;
    return by.trace({luxels().width, std::min(rows_, end_ - first_row)}, tile_, first_row);
}

bool ImageBands::fit_together(std::uint32_t vpls) const {
    const std::uint64_t padded = whole_blocks(luxels()).area();
    const std::uint64_t limit = frame_.job().settings.limits.visibility_bytes;
    return saturating_mul(padded, 8 * frame_.traits().luxel_bytes + vpls) / 8 <= limit;
}

void find_visible(RenderFrame& by, FrameBand& band, VplSpan<Space::host> vpls) {
    const auto stage = by.job().clock.measure(&StageSeconds::visibility);
    const std::uint64_t pairs = band.extent().area() * vpls.size();
    Monitor* const monitor = by.job().monitor;
    {
        const LoopingPairs looping(monitor, pairs);
        by.find_visible(band, vpls);
    }
    if (monitor != nullptr) monitor->contributions += pairs;
}

}  // namespace mir
