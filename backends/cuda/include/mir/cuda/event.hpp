// SPDX-License-Identifier: MIT
#pragma once

#include "mir/cuda/active_device.hpp"

#include <utility>

namespace mir::cuda {

/// A point in the work of a queue, with its time. Move-only. Asking and waiting is thread-safe.
class Event {
 public:
    /// An event of a device that nothing has recorded yet: it counts as passed.
    /// @throws Error(device), Error(no_device)
    explicit Event(int device) : device_(device) {
        const ActiveDevice active(device_);
        check(cudaEventCreate(&event_), "making an event");
    }
    Event(const Event&) = delete;
    Event& operator=(const Event&) = delete;
    /// `other` is no event afterwards: it may end or be assigned to.
    Event(Event&& other) noexcept { swap(other); }
    /// What this was ends; `other` is no event afterwards.
    Event& operator=(Event&& other) noexcept {
        Event moved(std::move(other));
        swap(moved);
        return *this;
    }
    ~Event() {
        if (event_ == nullptr) return;
        release_on(device_, [this] { static_cast<void>(cudaEventDestroy(event_)); });
    }

    /// Waits until the work before the event is done.
    /// @throws Error(device) when that work failed.
    void sync() const {
        const ActiveDevice active(device_);
        check(cudaEventSynchronize(event_), "work on the GPU");
    }

    /// CUDA's handle, owned by this object.
    [[nodiscard]] cudaEvent_t handle() const { return event_; }

    /// Seconds between two events of one device by the GPU's clock. Exact to about half a
    /// microsecond; waits until both have passed.
    /// @throws Error(device) when the work before them failed.
    friend double seconds_between(const Event& from, const Event& to) {
        from.sync();
        to.sync();
        const ActiveDevice active(from.device_);
        float milliseconds = 0.0f;
        check(cudaEventElapsedTime(&milliseconds, from.event_, to.event_), "measuring time");
        return 1e-3 * static_cast<double>(milliseconds);
    }

 private:
    void swap(Event& other) noexcept {
        std::swap(device_, other.device_);
        std::swap(event_, other.event_);
    }

    int device_ = 0;
    cudaEvent_t event_ = nullptr;
};

}  // namespace mir::cuda
