// SPDX-License-Identifier: MIT
//
// A library with the part of Open Image Denoise's C API that is used, for tests: its output says
// what it was given. MIR_FAKE_VERSION 1 gives functions their names of version 1; 0 lacks one of
// them. The environment variable MIR_FAKE_OIDN makes calls fail.
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <map>
#include <string>

// NOLINTBEGIN(*-avoid-non-const-global-variables, readability-identifier-naming): a C API that
// others named.
namespace {

int live_objects = 0;
int error = 0;
const char* error_text = nullptr;

bool is_told(const char* word) {
    const char* told = std::getenv("MIR_FAKE_OIDN");
    return told != nullptr && std::strcmp(told, word) == 0;
}

void fail(int code, const char* text) {
    error = code;
    error_text = text;
}

}  // namespace

extern "C" {

struct Device {
    int threads;
};

struct Filter {
    std::map<std::string, float*> images;
    std::map<std::string, bool> switches;
    std::size_t floats = 0;
    bool committed = false;
    bool (*goes_on)(void*, double) = nullptr;
    void* user = nullptr;
};

/// Devices and filters that were made and not released.
int fake_live_objects() { return live_objects; }

Device* oidnNewDevice(int type) {
    if (is_told("no device")) fail(5, "no such processor");
    if (is_told("null device") || is_told("no device") || type != 1) return nullptr;
    ++live_objects;
    return new Device{0};
}
void oidnCommitDevice(Device*) {}
void oidnReleaseDevice(Device* device) {
    --live_objects;
    delete device;
}
int oidnGetDeviceError(Device*, const char** message) {
    const int code = error;
    *message = error_text;
    error = 0;
    return code;
}
#if MIR_FAKE_VERSION == 1
#define MIR_FAKE_DEVICE_INT oidnGetDevice1i
#define MIR_FAKE_SET_DEVICE_INT oidnSetDevice1i
#define MIR_FAKE_SET_DEVICE_BOOL oidnSetDevice1b
#define MIR_FAKE_SET_FILTER_BOOL oidnSetFilter1b
#else
#define MIR_FAKE_DEVICE_INT oidnGetDeviceInt
#define MIR_FAKE_SET_DEVICE_INT oidnSetDeviceInt
#define MIR_FAKE_SET_DEVICE_BOOL oidnSetDeviceBool
#define MIR_FAKE_SET_FILTER_BOOL oidnSetFilterBool
#endif
int MIR_FAKE_DEVICE_INT(Device*, const char* name) {
    return std::strcmp(name, "version") == 0 ? 10000 * MIR_FAKE_VERSION + 403 : -1;
}
void MIR_FAKE_SET_DEVICE_INT(Device* device, const char* name, int value) {
    if (std::strcmp(name, "numThreads") == 0) device->threads = value;
}
void MIR_FAKE_SET_DEVICE_BOOL(Device*, const char* name, bool value) {
    if (std::strcmp(name, "setAffinity") != 0 || value) fail(2, "threads would be moved");
}

Filter* oidnNewFilter(Device*, const char* type) {
    if (std::strcmp(type, "RT") != 0) fail(2, "unknown filter");
    ++live_objects;
    return new Filter;
}
void oidnReleaseFilter(Filter* filter) {
    --live_objects;
    delete filter;
}
void oidnSetSharedFilterImage(Filter* filter, const char* name, void* pixels, int format,
                              std::size_t width, std::size_t height, std::size_t, std::size_t,
                              std::size_t) {
    if (format != 3) fail(2, "unknown format");
    filter->images[name] = static_cast<float*>(pixels);
    filter->floats = 3 * width * height;
}
void oidnSetFilterProgressMonitorFunction(Filter* filter, bool (*goes_on)(void*, double),
                                          void* user) {
    filter->goes_on = goes_on;
    filter->user = user;
}
#if MIR_FAKE_VERSION != 0
void MIR_FAKE_SET_FILTER_BOOL(Filter* filter, const char* name, bool value) {
    filter->switches[name] = value;
}
#endif
void oidnCommitFilter(Filter* filter) {
    filter->committed = true;
    if (filter->images.count("normal") > filter->images.count("albedo"))
        fail(2, "a normal without an albedo");
}
/// Half the colour, a hundredth of the albedo, a thousandth of the normal.
void oidnExecuteFilter(Filter* filter) {
    if (is_told("failure")) return fail(4, "out of memory");
    if (!filter->committed || !filter->switches["hdr"]) return fail(3, "not ready");
    if (filter->goes_on != nullptr && !filter->goes_on(filter->user, 0.5))
        return fail(6, "cancelled");
    const float* albedo = filter->images["albedo"];
    const float* normal = filter->images["normal"];
    for (std::size_t i = 0; i < filter->floats; ++i)
        filter->images["output"][i] = 0.5f * filter->images["color"][i] +
                                      (albedo != nullptr ? 0.01f * albedo[i] : 0.0f) +
                                      (normal != nullptr ? 0.001f * normal[i] : 0.0f);
}

}  // extern "C"
// NOLINTEND(*-avoid-non-const-global-variables, readability-identifier-naming)
