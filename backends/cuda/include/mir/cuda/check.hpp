// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/error.hpp"

#include <cuda_runtime_api.h>

#include <string>

namespace mir::cuda {

/// True for failures after which CUDA refuses all further work of this process. Only a new process
/// can use the GPU again. What runs on the CPU is not touched.
[[nodiscard]] inline bool ends_all_work(cudaError_t status) {
    switch (status) {
        case cudaErrorIllegalAddress:
        case cudaErrorMisalignedAddress:
        case cudaErrorInvalidAddressSpace:
        case cudaErrorIllegalInstruction:
        case cudaErrorInvalidPc:
        case cudaErrorHardwareStackError:
        case cudaErrorLaunchFailure:
        case cudaErrorLaunchTimeout:
        case cudaErrorAssert:
        case cudaErrorECCUncorrectable:
            return true;
        default:
            return false;
    }
}

/// Which kind of failure a status is; the status must not be cudaSuccess.
[[nodiscard]] inline ErrorCode error_code_of(cudaError_t status) {
    switch (status) {
        case cudaErrorMemoryAllocation:
            return ErrorCode::out_of_memory;
        case cudaErrorNoDevice:
        case cudaErrorInvalidDevice:
        case cudaErrorInsufficientDriver:
        case cudaErrorStubLibrary:
        case cudaErrorInitializationError:
        case cudaErrorDevicesUnavailable:
        case cudaErrorDeviceNotLicensed:
        case cudaErrorSystemNotReady:
        case cudaErrorSystemDriverMismatch:
        case cudaErrorCompatNotSupportedOnDevice:
        case cudaErrorNoKernelImageForDevice:
        case cudaErrorUnsupportedPtxVersion:
            return ErrorCode::no_device;
        default:
            return ErrorCode::device;
    }
}

namespace detail {

/// Likely reason of a failure and what helps, "reason); remedy".
inline const char* reason_and_remedy(cudaError_t status) {
    switch (status) {
        case cudaErrorMemoryAllocation:
            return "the GPU or the host has not enough free memory); use smaller tiles, fewer VPLs "
                   "or a smaller scene, or end other programs that use the GPU";
        case cudaErrorNoDevice:
            return "this machine shows no CUDA device to the process, see CUDA_VISIBLE_DEVICES); "
                   "use the CPU backend";
        case cudaErrorInsufficientDriver:
        case cudaErrorStubLibrary:
        case cudaErrorSystemDriverMismatch:
        case cudaErrorCompatNotSupportedOnDevice:
            return "the NVIDIA driver is missing or older than this build needs); install or "
                   "update the driver, or use the CPU backend";
        case cudaErrorNoKernelImageForDevice:
        case cudaErrorUnsupportedPtxVersion:
            return "this build holds no code for this GPU); build with its compute capability in "
                   "CMAKE_CUDA_ARCHITECTURES";
        default:
            break;
    }
    if (error_code_of(status) == ErrorCode::no_device)
        return "the device cannot be used now); choose another one or use the CPU backend";
    if (ends_all_work(status))
        return "most likely a kernel, perhaps an earlier one, read or wrote where it must not, and "
               "this process can no longer use the GPU); start the program again, and if it "
               "happens again run it under compute-sanitizer and report what that prints";
    return "the driver refused the call); report it with the versions that `mir devices` prints";
}

}  // namespace detail

/// Message of a failed call: "`doing` failed", CUDA's name for it, likely reason, remedy. "`doing`
/// failed", CUDA's name for it, likely reason, remedy.
[[nodiscard]] inline std::string failure_sentence(cudaError_t status, const std::string& doing) {
    return doing + " failed (CUDA says " + cudaGetErrorName(status) + ": " +
           cudaGetErrorString(status) + "; " + detail::reason_and_remedy(status);
}

/// Passes a successful status; every CUDA call of the library goes through here. A failed call
/// leaves nothing behind in the runtime that a later check would mistake for its own failure.
/// `doing` is a noun phrase, such as "a copy to the GPU". Kernels fail late: what is reported may
/// have gone wrong in any earlier kernel of the same device.
/// @throws Error(out_of_memory), Error(no_device) or Error(device), see error_code_of().
inline void check(cudaError_t status, const char* doing, Where at = Where::here()) {
    if (status == cudaSuccess) return;
    static_cast<void>(cudaGetLastError());
    throw Error(error_code_of(status), failure_sentence(status, doing), at);
}

}  // namespace mir::cuda
