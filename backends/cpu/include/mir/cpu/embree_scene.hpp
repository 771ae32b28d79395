// SPDX-License-Identifier: MIT
#pragma once

#include "mir/accel/exact/find_surface.hpp"
#include "mir/concepts/ray_caster.hpp"
#include "mir/core/monitor.hpp"
#include "mir/cpu/detail/embree.hpp"
#include "mir/cpu/detail/embree_opacity.hpp"
#include "mir/cpu/embree_visibility.hpp"
#include "mir/scene/world_geometry.hpp"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <cstring>
#include <limits>
#include <memory>
#include <mutex>
#include <new>
#include <optional>
#include <string>

namespace mir::cpu {

/// Finds closest hits through Embree. Model of ShortRayCaster; a handle that the EmbreeScene
/// outlives.
struct EmbreeRayCaster {
    RTCScene scene = nullptr;                 ///< belongs to the EmbreeScene
    const WorldGeometry* geometry = nullptr;  ///< of the same triangles

    /// `reach` in metres: nothing farther is found.
    [[nodiscard]] std::optional<SurfacePoint> closest_hit(
        Ray ray, float reach = std::numeric_limits<float>::infinity()) const;
};

static_assert(ShortRayCaster<EmbreeRayCaster>);

/// Embree device and scene over the triangles of a WorldGeometry, which must outlive it. Move-only
/// owner; the handles it gives out may be used from any thread.
class EmbreeScene {
 public:
    /// No bound of memory.
    static constexpr std::int64_t any_bytes = std::numeric_limits<std::int64_t>::max();

    /// Builds the acceleration structure in at most `max_bytes` of memory, until `monitor` is
    /// cancelled; that may be null. The threads are those of the task library.
    /// @throws Error(device) with Embree's words when it reports a failure, the memory bound
    ///         included; when some triangle is not opaque and Embree was built without filter
    ///         functions. Error(invalid_input) when a coordinate is beyond 1.8e18 m, where Embree
    ///         ends the process. Rays must not start there either. Error(cancelled).
    explicit EmbreeScene(const WorldGeometry& geometry, std::int64_t max_bytes = any_bytes,
                         Monitor* monitor = nullptr);

    /// Visibility that reads this scene.
    [[nodiscard]] EmbreeVisibility visibility() const { return {scene_.get()}; }
    /// Ray caster that reads this scene and its geometry.
    [[nodiscard]] EmbreeRayCaster ray_caster() const { return {scene_.get(), geometry_}; }

    /// For callers that measure Embree itself.
    [[nodiscard]] RTCScene handle() const { return scene_.get(); }

 private:
    struct ReleaseDevice {
        void operator()(RTCDevice d) const { rtcReleaseDevice(d); }
    };
    struct ReleaseScene {
        void operator()(RTCScene s) const { rtcReleaseScene(s); }
    };
    /// First failure that Embree reported; the callback may run on any of its threads.
    struct DeviceErrors {
        std::mutex mutex;
        std::string first;
    };
    /// Bytes that Embree holds and may hold; counted from any of its threads.
    struct MemoryBudget {
        std::atomic<std::int64_t> used{0};
        std::atomic<std::int64_t> most{0};

        MemoryBudget() = default;
        MemoryBudget(const MemoryBudget&) = delete;
        MemoryBudget& operator=(const MemoryBudget&) = delete;
        // Embree's threads come after construction and are done before destruction; acquire and
        // release say so once more for thread sanitizers, which cannot see into its binary.
        ~MemoryBudget() { static_cast<void>(used.load(std::memory_order_acquire)); }
    };

    /// What a Monitor counts of a build as Monitor::blocks.
    static constexpr std::uint32_t progress_steps = 1000;

    void add_triangles();
    void throw_if_failed() const;
    static void remember(void* errors, RTCError code, const char* text);
    static bool account(void* budget, ssize_t bytes, bool after);
    static bool goes_on(void* monitor, double done);
    void commit(Monitor* monitor);

    const WorldGeometry* geometry_;
    std::unique_ptr<OpacityView<Space::host>> opacity_;  ///< read by Embree's filters
    std::unique_ptr<DeviceErrors> errors_ = std::make_unique<DeviceErrors>();
    std::unique_ptr<MemoryBudget> budget_ = std::make_unique<MemoryBudget>();
    std::unique_ptr<std::remove_pointer_t<RTCDevice>, ReleaseDevice> device_;
    std::unique_ptr<std::remove_pointer_t<RTCScene>, ReleaseScene> scene_;
};

inline std::optional<SurfacePoint> EmbreeRayCaster::closest_hit(Ray ray, float reach) const {
    RTCRayHit query{};
    query.ray.org_x = ray.origin.x;
    query.ray.org_y = ray.origin.y;
    query.ray.org_z = ray.origin.z;
    query.ray.dir_x = ray.direction.x;
    query.ray.dir_y = ray.direction.y;
    query.ray.dir_z = ray.direction.z;
    query.ray.tfar = reach;
    query.ray.mask = detail::all_rays;
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    detail::intersect1(scene, query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
    const float u = query.hit.u;
    const float v = query.hit.v;
    SurfacePoint point = geometry->surface_point(query.hit.primID, {u, v}, ray);
    // Beyond what Embree rounds where it is near.
    constexpr float by_edge = 0x1p-16f;
    if (std::min(std::min(u, v), 1.0f - u - v) <= by_edge)
        keep_in_sight(point, geometry->view(), ray, query.ray.tfar,
                      [sight = EmbreeVisibility{scene}](Vec3 from, Vec3 to) {
                          return sight.is_blocked(from, to);
                      });
    return point;
}

inline EmbreeScene::EmbreeScene(const WorldGeometry& geometry, std::int64_t max_bytes,
                                Monitor* monitor)
    : geometry_(&geometry),
      opacity_(geometry.is_opaque()
                   ? nullptr
                   : std::make_unique<OpacityView<Space::host>>(geometry.opacity())),
      device_(rtcNewDevice(nullptr)) {
    constexpr float embree_reach = 1.8e18f;
    const Bounds& bounds = geometry.bounds();
    if (!bounds.empty() && !(std::max(max_abs(bounds.low), max_abs(bounds.high)) <= embree_reach))
        throw Error(ErrorCode::invalid_input,
                    "the scene reaches farther than 1.8e+18 m from its origin (Embree takes no "
                    "more); leave out what lies so far away");
    if (device_ == nullptr) {
        const RTCError reason = rtcGetDeviceError(nullptr);
        if (reason == RTC_ERROR_OUT_OF_MEMORY) throw std::bad_alloc();
        throw Error(ErrorCode::device, "Embree cannot make a device on this processor (error " +
                                           std::to_string(reason) +
                                           "); check that its library matches the machine");
    }
    rtcSetDeviceErrorFunction(device_.get(), &EmbreeScene::remember, errors_.get());
    budget_->most.store(max_bytes, std::memory_order_release);
    rtcSetDeviceMemoryMonitorFunction(device_.get(), &EmbreeScene::account, budget_.get());
    if (opacity_) detail::require_filters(device_.get());
    scene_.reset(rtcNewScene(device_.get()));
    throw_if_failed();
    rtcSetSceneFlags(scene_.get(), RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(scene_.get(), RTC_BUILD_QUALITY_HIGH);
    add_triangles();
    commit(monitor);
}

inline void EmbreeScene::add_triangles() {
    if (geometry_->triangles().empty()) return;
    RTCGeometry mesh = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
    // Copies, not shared buffers: Embree reads sixteen bytes at the last vertex, one float too far.
    const auto positions = geometry_->positions();
    const auto triangles = geometry_->triangles();
    void* vertices = rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                             sizeof(Vec3), positions.size());
    void* indices = rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                            sizeof(TriangleIndices), triangles.size());
    if (vertices != nullptr && indices != nullptr) {
        std::memcpy(vertices, positions.data(), positions.size_bytes());
        std::memcpy(indices, triangles.data(), triangles.size_bytes());
        rtcSetGeometryMask(mesh, detail::all_rays);
        if (opacity_) detail::filter_by(mesh, *opacity_);
        rtcCommitGeometry(mesh);
        rtcAttachGeometry(scene_.get(), mesh);
    }
    rtcReleaseGeometry(mesh);
    throw_if_failed();
}

inline void EmbreeScene::commit(Monitor* monitor) {
    if (monitor != nullptr) {
        monitor->begin_loop(progress_steps);
        // Embree calls it while it commits, and at no other time.
        rtcSetSceneProgressMonitorFunction(scene_.get(), &EmbreeScene::goes_on, monitor);
    }
    rtcCommitScene(scene_.get());
    // That it was stopped is an error to Embree, too.
    if (monitor != nullptr) monitor->check();
    throw_if_failed();
}

inline void EmbreeScene::throw_if_failed() const {
    const std::lock_guard lock(errors_->mutex);
    if (!errors_->first.empty())
        throw Error(ErrorCode::device, "Embree reported: " + errors_->first +
                                           " (the scene could not be prepared for ray tracing); "
                                           "try a smaller scene or more memory");
}

inline bool EmbreeScene::account(void* budget, ssize_t bytes, bool /*after*/) {
    auto* b = static_cast<MemoryBudget*>(budget);
    const std::int64_t most = b->most.load(std::memory_order_acquire);
    // Embree ignores the answer for memory that is given back.
    return b->used.fetch_add(bytes) + bytes <= most;
}

inline bool EmbreeScene::goes_on(void* monitor, double done) {
    auto* m = static_cast<Monitor*>(monitor);
    if (m->cancelled.load(std::memory_order_relaxed)) return false;
    m->blocks = static_cast<std::uint64_t>(std::clamp(done, 0.0, 1.0) * progress_steps);
    return true;
}

inline void EmbreeScene::remember(void* errors, RTCError code, const char* text) {
    auto* e = static_cast<DeviceErrors*>(errors);
    const std::lock_guard lock(e->mutex);
    if (!e->first.empty()) return;
    e->first = "error " + std::to_string(code);
    if (text != nullptr) e->first += std::string(", ") + text;
}

}  // namespace mir::cpu
