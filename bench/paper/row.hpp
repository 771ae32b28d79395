// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/kd/kd_options.hpp"
#include "mir/data/tile.hpp"
#include "ray_counters.hpp"
#include "spread.hpp"
#include "timeline.hpp"

#include <optional>
#include <string>
#include <vector>

namespace mirpaper {

/// One measured line of a figure.
struct Row {
    std::string figure;
    std::string scene;
    std::string backend;  ///< "cpu", "cuda"
    std::string
        algorithm;        ///< cpu, cpu-blocks, embree-blocks, os, rc, rcvp; kernels: their variant
    std::string variant;  ///< what else there is to say: resident, kernel variants
    std::string clock;    ///< what `seconds` is measured by: "events", "wall" or ""
    mir::Extent image;
    mir::Extent tile;
    std::uint32_t vpls = 0;
    Spread seconds;
    Spread wall;                    ///< of the whole call; nothing for kernels alone
    double visibility_seconds = 0;  ///< kernels alone, cut in two
    double shading_seconds = 0;
    double paper_seconds = 0;        ///< 0: not in the paper
    double paper_contributions = 0;  ///< per second; 0: not in the paper
    double mean_luminance = 0;       ///< of the image, with intensities as the chains left them
    std::optional<StageSeconds> stages;
    std::optional<RayCounters> counters;

    /// Luxel-VPL pairs, whether they face each other or not, as the paper counts.
    [[nodiscard]] double pairs() const {
        return static_cast<double>(image.area()) * static_cast<double>(vpls);
    }
    /// Contributions per second, from the median.
    [[nodiscard]] double rate() const {
        return seconds.median > 0.0 ? pairs() / seconds.median : 0.0;
    }
};

/// A scene of the run, for the report.
struct SceneNote {
    std::string name;
    std::string hash;
    std::uint64_t triangles = 0;
    double tree_seconds = 0.0;
    double tree_sah_cost = 0.0;
    std::uint64_t tree_bytes = 0;
    mir::KdTreeOptions tree;
    float splits = 0.0f;  ///< WideBvhOptions::splits
};

/// Everything that was measured.
struct Results {
    std::vector<std::string> devices;  ///< "backend: device"
    std::vector<SceneNote> scenes;
    std::vector<Row> rows;
    mir::Extent image;
    unsigned repeat = 0;
    unsigned host_repeat = 0;
};

inline std::string text_of(mir::Extent e) {
    return std::to_string(e.width) + "x" + std::to_string(e.height);
}

}  // namespace mirpaper
