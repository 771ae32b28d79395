// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/monitor.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

namespace mir {

/// How far a render is at one moment.
struct RenderWork {
    const char* stage = nullptr;    ///< RenderStage::title; null before the first stage
    std::uint64_t blocks = 0;       ///< of the stage's present loop: done
    std::uint64_t all_blocks = 0;   ///< 0 when no loop runs
    std::uint64_t units = 0;        ///< contributions or gathers: done
    std::uint64_t all_units = 0;    ///< 0: not known yet
    const char* unit = "";          ///< "contributions" or "gathers"
    std::uint32_t begun_bands = 0;  ///< of the image
    std::uint32_t bands = 0;        ///< 0: not known yet

    /// Of the stage's present loop, 0 to 1; none when no loop runs.
    [[nodiscard]] std::optional<double> stage_share() const { return ratio(blocks, all_blocks); }
    /// Of contributions or gathers, 0 to 1; none when they are not known.
    [[nodiscard]] std::optional<double> unit_share() const { return ratio(units, all_units); }

 private:
    static std::optional<double> ratio(std::uint64_t part, std::uint64_t whole) {
        if (whole == 0) return std::nullopt;
        return static_cast<double>(std::min(part, whole)) / static_cast<double>(whole);
    }
};

namespace detail {

/// What the loop under way has done of the contributions that count when it ends.
inline std::uint64_t looping_contributions(const Monitor& monitor, const RenderWork& work) {
    const auto all = static_cast<double>(monitor.looping_contributions.load());
    return static_cast<std::uint64_t>(all * work.stage_share().value_or(0.0));
}

}  // namespace detail

/// Reads `monitor`, which may change meanwhile.
inline RenderWork work_of(const Monitor& monitor) {
    RenderWork work;
    work.stage = monitor.stage.load();
    work.blocks = monitor.blocks.load();
    work.all_blocks = monitor.planned_blocks.load();
    const std::uint64_t gathers = monitor.planned_gathers.load();
    work.unit = gathers > 0 ? "gathers" : "contributions";
    work.units = gathers > 0
                     ? monitor.gathers.load()
                     : monitor.contributions.load() + detail::looping_contributions(monitor, work);
    work.all_units = gathers > 0 ? gathers : monitor.planned_contributions.load();
    work.begun_bands = monitor.bands.load();
    work.bands = monitor.planned_bands.load();
    return work;
}

/// Estimates how long a render still takes from what its stages took so far. Contributions (or
/// gathers) cost in proportion to their number; the rest of a band (camera rays, direct light)
/// costs in each band what it cost on average in those before. To be told often, at least five
/// times a second. One thread at a time.
class RenderPace {
 public:
    /// Takes note of `work` at `seconds` after the render's begin; times must not decrease.
    void look(const RenderWork& work, double seconds) {
        const double passed = seconds - seconds_;
        const bool counts = work.units > work_.units;
        if (counts)
            unit_seconds_ += passed;
        else if (work.begun_bands > 0)
            rest_seconds_ += passed;
        if (counts) rest_of_whole_bands_ = rest_seconds_;
        work_ = work;
        seconds_ = seconds;
    }

    /// Units per second of the time in which units were done; 0 before any was.
    [[nodiscard]] double rate() const {
        return unit_seconds_ > 0.0 ? static_cast<double>(work_.units) / unit_seconds_ : 0.0;
    }

    /// None before the first unit. No time left can be told from what was not measured.
    [[nodiscard]] std::optional<double> seconds_left() const {
        const std::optional<double> share = work_.unit_share();
        if (!share || *share == 0.0 || unit_seconds_ == 0.0) return std::nullopt;
        const double units = unit_seconds_ * (1.0 - *share) / *share;
        // As many bands have had their rest as had units.
        const double met = std::max(1.0, std::ceil(*share * work_.bands));
        const double in_this_band = rest_seconds_ - rest_of_whole_bands_;
        const double rest = rest_of_whole_bands_ * (work_.bands - met) / met - in_this_band;
        return units + std::max(rest, 0.0);
    }

 private:
    RenderWork work_;
    double seconds_ = 0.0;
    double unit_seconds_ = 0.0;         // in which units were done
    double rest_seconds_ = 0.0;         // in bands, but without units
    double rest_of_whole_bands_ = 0.0;  // of them, of bands whose units have begun
};

}  // namespace mir
