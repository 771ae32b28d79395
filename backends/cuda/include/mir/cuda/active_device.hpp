// SPDX-License-Identifier: MIT
#pragma once

#include "mir/cuda/check.hpp"

namespace mir::cuda {

/// Makes a device the calling thread's current one, and restores the former at the end. Several
/// backends, and a host program's own CUDA code, can so live side by side.
class ActiveDevice {
 public:
    /// @throws Error(no_device) when the device cannot be used.
    explicit ActiveDevice(int ordinal) : ordinal_(ordinal) {
        check(cudaGetDevice(&former_), "asking for the current device");
        // The first call also creates the device's context, which cudaGetDevice() does not.
        check(cudaSetDevice(ordinal_), "choosing a device");
    }
    ActiveDevice(const ActiveDevice&) = delete;
    ActiveDevice& operator=(const ActiveDevice&) = delete;
    ~ActiveDevice() {
        if (former_ != ordinal_) static_cast<void>(cudaSetDevice(former_));
    }

 private:
    int ordinal_ = 0;
    int former_ = 0;
};

/// The same where nothing may throw. Runs `release` with the device current if it can be, and
/// forgets failures, which the next checked call reports.
template <class Release>
void release_on(int ordinal, const Release& release) noexcept {
    int former = ordinal;
    static_cast<void>(cudaGetDevice(&former));
    static_cast<void>(cudaSetDevice(ordinal));
    release();
    if (former != ordinal) static_cast<void>(cudaSetDevice(former));
}

}  // namespace mir::cuda
