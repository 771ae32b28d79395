// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>

// The part of Open Image Denoise's C API that is used here, of versions 1.2 to 2. None of its
// headers is needed.
namespace mir::oidn {

struct DeviceObject;
struct FilterObject;
using Device = DeviceObject*;
using Filter = FilterObject*;

inline constexpr int processor_device = 1;
inline constexpr int three_floats = 3;
inline constexpr int error_none = 0;
inline constexpr int error_cancelled = 6;

/// Told how much is done, 0..1; false cancels.
using Progress = bool (*)(void* user, double done);

/// The functions of a loaded library.
struct Api {
    Device (*new_device)(int type);
    void (*commit_device)(Device);
    void (*release_device)(Device);
    int (*get_device_error)(Device, const char** message);
    int (*get_device_int)(Device, const char* name);
    void (*set_device_int)(Device, const char* name, int value);
    void (*set_device_bool)(Device, const char* name, bool value);
    Filter (*new_filter)(Device, const char* type);
    void (*commit_filter)(Filter);
    void (*execute_filter)(Filter);
    void (*release_filter)(Filter);
    void (*set_filter_bool)(Filter, const char* name, bool value);
    void (*set_filter_image)(Filter, const char* name, void* pixels, int format, std::size_t width,
                             std::size_t height, std::size_t offset, std::size_t pixel_stride,
                             std::size_t row_stride);
    void (*set_filter_progress)(Filter, Progress, void* user);
};

/// Loads the library of a Denoiser. It is never unloaded: it has threads of its own.
/// @throws Error(no_device) when there is none, or when one lacks a function.
Api load(const std::filesystem::path& library);

}  // namespace mir::oidn
