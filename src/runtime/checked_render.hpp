// SPDX-License-Identifier: MIT
#pragma once

#include "mir/host/tbb_executor.hpp"
#include "mir/scene/recentre.hpp"
#include "runtime/render_job.hpp"

#include <future>
#include <string>
#include <vector>

namespace mir {

/// What every renderer does around its work. Checks settings and scene, brings the scene near its
/// origin, places its triangles, and completes what the work made of them.
class CheckedRender {
 public:
    /// `monitor` may be null, all else must outlive it. `fingerprint` says when that of the scene
    /// is made: beside the work or behind it. `share` is null, or that of this process in a picture
    /// of several.
    /// @throws Error for settings or scene that cannot be used.
    CheckedRender(const Scene& scene, const RenderSettings& settings, Monitor* monitor,
                  std::launch fingerprint, const PictureShare* share);
    CheckedRender(const CheckedRender&) = delete;
    CheckedRender& operator=(const CheckedRender&) = delete;
    ~CheckedRender() = default;

    /// What is to be rendered.
    [[nodiscard]] const PlacedScene& placed() const { return placed_; }

    /// Adds fingerprint, times, counts of triangles and warnings to a result. To be called once.
    [[nodiscard]] RenderResult complete(RenderResult result);

 private:
    std::vector<std::string> warnings_;
    StageClock clock_;
    std::future<std::string> fingerprint_;
    NearScene near_;
    TbbExecutor threads_;
    WorldGeometry geometry_;
    PlacedScene placed_;
};

}  // namespace mir
