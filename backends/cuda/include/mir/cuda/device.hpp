// SPDX-License-Identifier: MIT
#pragma once

#include "mir/cuda/active_device.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace mir::cuda {

/// A GPU as its driver describes it.
struct Device {
    int ordinal = 0;                    ///< its number in this process, see CUDA_VISIBLE_DEVICES
    std::string name;                   ///< as the driver spells it
    int major = 0;                      ///< compute capability, for example 9
    int minor = 0;                      ///< and 0
    std::uint64_t memory_bytes = 0;     ///< of the GPU in all, taken or not
    std::uint32_t multiprocessors = 0;  ///< streaming multiprocessors
};

/// Version of CUDA as NVIDIA counts it: 1000 major + 10 minor; 0 for none.
struct Versions {
    int driver = 0;   ///< newest CUDA that the driver understands; 0 without a driver
    int runtime = 0;  ///< CUDA that this program was built with
};

/// Oldest compute capability that kernels are built for, 10 major + minor.
inline constexpr int oldest_capability = 75;

/// "13.0" for 13000.
[[nodiscard]] inline std::string version_text(int version) {
    return std::to_string(version / 1000) + "." + std::to_string(version % 1000 / 10);
}

/// "8.6" for a device of compute capability 8.6.
[[nodiscard]] inline std::string capability_text(const Device& device) {
    return std::to_string(device.major) + "." + std::to_string(device.minor);
}

/// True when kernels of this library can run there.
[[nodiscard]] inline bool is_supported(const Device& device) {
    return 10 * device.major + device.minor >= oldest_capability;
}

/// Versions of driver and runtime. Never fails: what cannot be asked is 0.
[[nodiscard]] inline Versions versions() {
    Versions v;
    if (cudaDriverGetVersion(&v.driver) != cudaSuccess) v.driver = 0;
    if (cudaRuntimeGetVersion(&v.runtime) != cudaSuccess) v.runtime = 0;
    return v;
}

namespace detail {

/// Number of devices, at least 1.
inline int count_devices() {
    int count = 0;
    const cudaError_t status = cudaGetDeviceCount(&count);
    if (status == cudaErrorInsufficientDriver && versions().driver == 0) {
        static_cast<void>(cudaGetLastError());
        throw Error(ErrorCode::no_device,
                    "there is no GPU to use (this machine has no NVIDIA driver); install one or "
                    "use the CPU backend");
    }
    if (status == cudaErrorInsufficientDriver) {
        static_cast<void>(cudaGetLastError());
        throw Error(ErrorCode::no_device, "the NVIDIA driver is too old (it understands CUDA " +
                                              version_text(versions().driver) +
                                              ", this build needs " +
                                              version_text(versions().runtime) +
                                              "); update the driver or use the CPU backend");
    }
    // On failure the count is left as it was and says nothing.
    check(status, "counting the GPUs");
    if (count < 1) check(cudaErrorNoDevice, "counting the GPUs");
    return count;
}

inline Device describe(int ordinal) {
    cudaDeviceProp properties{};
    check(cudaGetDeviceProperties(&properties, ordinal), "asking a GPU for its properties");
    return {ordinal,
            properties.name,
            properties.major,
            properties.minor,
            properties.totalGlobalMem,
            static_cast<std::uint32_t>(properties.multiProcessorCount)};
}

}  // namespace detail

/// All GPUs that this process sees, usable or not, in the order of their ordinals. At least one.
/// Callable from any thread.
/// @throws Error(no_device) when there is no driver, a driver too old, or no GPU.
[[nodiscard]] inline std::vector<Device> devices() {
    std::vector<Device> all;
    const int count = detail::count_devices();
    for (int i = 0; i < count; ++i) all.push_back(detail::describe(i));
    return all;
}

/// The GPU of a number.
/// @throws Error(no_device) as devices() does, when there is no such number, and for a GPU older
/// than oldest_capability.
[[nodiscard]] inline Device select_device(int ordinal = 0) {
    const int count = detail::count_devices();
    if (ordinal < 0 || ordinal >= count)
        throw Error(ErrorCode::no_device, "there is no GPU number " + std::to_string(ordinal) +
                                              " (this machine has " + std::to_string(count) +
                                              ", counted from 0); choose one of those");
    Device device = detail::describe(ordinal);
    if (!is_supported(device))
        throw Error(ErrorCode::no_device,
                    "GPU " + std::to_string(ordinal) + ", " + device.name +
                        ", is too old (its compute capability is " + capability_text(device) +
                        ", kernels need 7.5); choose a newer GPU or use the CPU backend");
    return device;
}

/// Bytes of a device's memory that nobody has taken, at this moment.
/// @throws Error when the device cannot be asked.
[[nodiscard]] inline std::uint64_t free_memory(int ordinal) {
    const ActiveDevice active(ordinal);
    std::size_t free = 0;
    std::size_t total = 0;
    check(cudaMemGetInfo(&free, &total), "asking a GPU for its free memory");
    return free;
}

}  // namespace mir::cuda
