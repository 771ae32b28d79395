// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

namespace mirpaper {

/// What a queue may be busy with. `fused` is rays and shading in one kernel; `other` belongs to no
/// scheduler of the library.
enum class Work {
    upload,
    download,
    fused,
    visibility,
    order,    ///< luxels put into clusters, and bits back
    records,  ///< of clusters, for shafts
    facing,
    blocks,    ///< shafts of 256 luxels
    clusters,  ///< shafts of 32
    lists,     ///< of their triangles
    segments,  ///< that no shaft decided
    shading,
    other
};

inline constexpr std::array work_names{"upload",   "download", "fused",  "visibility", "order",
                                       "records",  "facing",   "blocks", "clusters",   "lists",
                                       "segments", "shading",  "other"};

inline constexpr bool is_transfer(Work w) { return w == Work::upload || w == Work::download; }

/// One operation of a queue, seconds since any fixed moment.
struct Interval {
    Work work = Work::other;
    double begin = 0.0;
    double end = 0.0;
};

/// Where the time of an image went, seconds.
struct StageSeconds {
    std::array<double, work_names.size()> of{};  ///< summed lengths by kind of work
    double transfer_busy = 0.0;                  ///< time in which something was copied
    double kernels_busy = 0.0;                   ///< time in which a kernel ran
    double busy = 0.0;                           ///< time in which anything happened
    double span = 0.0;                           ///< from the first operation to the last

    [[nodiscard]] double sum() const {
        double all = 0.0;
        for (const double s : of) all += s;
        return all;
    }
    /// Share of the work's time that was saved by doing it at once: 1 - busy / sum, 0..1.
    [[nodiscard]] double overlap() const {
        return sum() > 0.0 ? std::max(0.0, 1.0 - busy / sum()) : 0.0;
    }
    /// Share of the time of copying in which a kernel ran, 0..1.
    [[nodiscard]] double hidden_transfer() const {
        const double hidden = std::max(0.0, transfer_busy + kernels_busy - busy);
        return transfer_busy > 0.0 ? hidden / transfer_busy : 0.0;
    }
};

/// Length of the union of those intervals that `wanted` picks.
template <class Wanted>
double busy_seconds(std::vector<Interval> intervals, const Wanted& wanted) {
    std::erase_if(intervals, [&](const Interval& i) { return !wanted(i.work); });
    std::sort(intervals.begin(), intervals.end(),
              [](const Interval& a, const Interval& b) { return a.begin < b.begin; });
    double busy = 0.0;
    std::optional<double> reached;
    for (const Interval& i : intervals) {
        const double begin = reached ? std::max(*reached, i.begin) : i.begin;
        busy += std::max(0.0, i.end - begin);
        reached = reached ? std::max(*reached, i.end) : i.end;
    }
    return busy;
}

inline StageSeconds summarise(const std::vector<Interval>& intervals) {
    StageSeconds s;
    if (intervals.empty()) return s;
    double first = intervals.front().begin;
    double last = intervals.front().end;
    for (const Interval& i : intervals) {
        s.of[static_cast<std::size_t>(i.work)] += i.end - i.begin;
        first = std::min(first, i.begin);
        last = std::max(last, i.end);
    }
    s.transfer_busy = busy_seconds(intervals, is_transfer);
    s.kernels_busy = busy_seconds(intervals, [](Work w) { return !is_transfer(w); });
    s.busy = busy_seconds(intervals, [](Work) { return true; });
    s.span = last - first;
    return s;
}

}  // namespace mirpaper
