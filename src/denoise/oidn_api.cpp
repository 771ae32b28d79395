// SPDX-License-Identifier: MIT
#include "denoise/oidn_api.hpp"

#include "mir/core/error.hpp"

#include <dlfcn.h>

#include <cstdlib>
#include <initializer_list>
#include <string>

namespace mir::oidn {
namespace {

constexpr const char* variable = "MIR_OIDN_LIBRARY";
constexpr const char* remedy =
    "name its library, libOpenImageDenoise.so of version 1.2 to 2, by --denoiser or by the "
    "environment variable MIR_OIDN_LIBRARY";

void* open(const std::string& name) {
    return dlopen(name.c_str(), RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
}

/// A library and how messages name it.
struct Opened {
    void* handle;
    std::string name;
};

Opened open_named(const std::string& name) {
    if (void* handle = open(name)) return {handle, name};
    throw Error(ErrorCode::no_device,
                name + ": no denoiser can be loaded (" + std::string(dlerror()) + "); " + remedy);
}

Opened open_of_system() {
    for (const char* name :
         {"libOpenImageDenoise.so", "libOpenImageDenoise.so.2", "libOpenImageDenoise.so.1"})
        if (void* handle = open(name)) return {handle, name};
    throw Error(ErrorCode::no_device,
                "there is no denoiser (the system has no libOpenImageDenoise.so, .so.2 or .so.1); "
                "install Open Image Denoise, for example by 'pip install pyoidn', and " +
                    std::string(remedy));
}

Opened open_library(const std::filesystem::path& library) {
    if (!library.empty()) return open_named(library.string());
    const char* named = std::getenv(variable);
    return named != nullptr && *named != '\0' ? open_named(named) : open_of_system();
}

/// Finds a function by the first of its names that the library has.
template <class F>
void find(const Opened& library, F*& function, std::initializer_list<const char*> names) {
    for (const char* name : names)
        if (void* found = dlsym(library.handle, name)) {
            function = reinterpret_cast<F*>(found);
            return;
        }
    throw Error(ErrorCode::no_device, library.name + ": no denoiser is in it (the function " +
                                          *names.begin() + " is missing); " + remedy);
}

}  // namespace

Api load(const std::filesystem::path& library) {
    const Opened opened = open_library(library);
    Api api{};
    find(opened, api.new_device, {"oidnNewDevice"});
    find(opened, api.commit_device, {"oidnCommitDevice"});
    find(opened, api.release_device, {"oidnReleaseDevice"});
    find(opened, api.get_device_error, {"oidnGetDeviceError"});
    // The second names are those of version 1.
    find(opened, api.get_device_int, {"oidnGetDeviceInt", "oidnGetDevice1i"});
    find(opened, api.set_device_int, {"oidnSetDeviceInt", "oidnSetDevice1i"});
    find(opened, api.set_device_bool, {"oidnSetDeviceBool", "oidnSetDevice1b"});
    find(opened, api.new_filter, {"oidnNewFilter"});
    find(opened, api.commit_filter, {"oidnCommitFilter"});
    find(opened, api.execute_filter, {"oidnExecuteFilter"});
    find(opened, api.release_filter, {"oidnReleaseFilter"});
    find(opened, api.set_filter_bool, {"oidnSetFilterBool", "oidnSetFilter1b"});
    find(opened, api.set_filter_image, {"oidnSetSharedFilterImage"});
    find(opened, api.set_filter_progress, {"oidnSetFilterProgressMonitorFunction"});
    return api;
}

}  // namespace mir::oidn
