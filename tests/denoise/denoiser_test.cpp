// SPDX-License-Identifier: MIT
#include "mir/denoise/denoiser.hpp"

#include "denoise/told.hpp"
#include "support/catch.hpp"

#include <dlfcn.h>

#include <cstdlib>
#include <functional>
#include <utility>

// By libraries that the tests build, whose output says what they were given; the real one is met by
// the tests of the program.

namespace {

using mir::Denoiser;
using mir::Image;
using mir::Rgb;
using mirtest::Approx;

constexpr mir::Extent size{5, 3};

Image<Rgb> plain(float r, float g, float b) { return Image<Rgb>(size, {r, g, b}); }

int live_objects() {
    void* library = dlopen(MIR_FAKE_OIDN_2, RTLD_NOW);
    REQUIRE(library != nullptr);
    const auto count = reinterpret_cast<int (*)()>(dlsym(library, "fake_live_objects"));
    REQUIRE(count != nullptr);
    return count();
}

void check_all(const Image<Rgb>& image, Rgb wanted) {
    REQUIRE(image.extent() == size);
    for (const Rgb& pixel : image.pixels()) {
        CHECK(pixel.r == Approx(wanted.r));
        CHECK(pixel.g == Approx(wanted.g));
        CHECK(pixel.b == Approx(wanted.b));
    }
}

void check_refused(const std::function<void()>& work, mir::ErrorCode code,
                   const std::string& part) {
    try {
        work();
        FAIL("nothing was refused");
    } catch (const mir::Error& e) {
        INFO(e.what());
        CHECK(e.code() == code);
        CHECK(std::string(e.what()).find(part) != std::string::npos);
    }
}

}  // namespace

TEST_CASE("a denoiser of version 1 or 2 gets picture and guides") {
    const Image<Rgb> picture = plain(1.0f, 2.0f, 4.0f);
    const Image<Rgb> albedo = plain(0.5f, 0.5f, 1.0f);
    const Image<mir::Vec3> normal(size, {0.0f, 1.0f, 0.0f});
    for (const auto& [library, name] : {std::pair(MIR_FAKE_OIDN_1, "Open Image Denoise 1.4.3"),
                                        std::pair(MIR_FAKE_OIDN_2, "Open Image Denoise 2.4.3")}) {
        const Denoiser denoiser(library, 2);
        CHECK(denoiser.name() == name);
        check_all(denoiser.denoise(picture), {0.5f, 1.0f, 2.0f});
        check_all(denoiser.denoise(picture, {&albedo}), {0.505f, 1.005f, 2.01f});
        check_all(denoiser.denoise(picture, {&albedo, &normal}), {0.505f, 1.006f, 2.01f});
        // Without an albedo the library would refuse it.
        check_all(denoiser.denoise(picture, {nullptr, &normal}), {0.5f, 1.0f, 2.0f});
    }
}

TEST_CASE("direct and indirect light are denoised apart, and emission is added as it is") {
    mir::RenderResult result{{}, {}, {}, {}, {}, mir::Guides({0, 0}), {}, {}, {}};
    result.emission = plain(10.0f, 0.0f, 0.0f);
    result.direct = plain(1.0f, 2.0f, 0.0f);
    result.indirect = plain(0.0f, 4.0f, 8.0f);
    const Denoiser denoiser(MIR_FAKE_OIDN_2);
    check_all(mir::denoise(result, denoiser), {10.5f, 3.0f, 4.0f});
    result.guides = mir::Guides(size);
    for (Rgb& pixel : result.guides.albedo.pixels()) pixel = {1.0f, 1.0f, 1.0f};
    check_all(mir::denoise(result, denoiser), {10.52f, 3.02f, 4.02f});
}

TEST_CASE("a library that is missing, or is no denoiser, is named with what helps") {
    const auto load = [](const char* name) { return [name] { Denoiser denoiser(name); }; };
    const auto none = mir::ErrorCode::no_device;
    check_refused(load("/nowhere/libdenoise.so"), none, "/nowhere/libdenoise.so: no denoiser can");
    check_refused(load("/nowhere/libdenoise.so"), none, "--denoiser");
    check_refused(load("libm.so.6"), none, "the function oidnNewDevice is missing");
    check_refused(load(MIR_FAKE_OIDN_0), none, "the function oidnSetFilterBool is missing");
}

TEST_CASE("the library is found by the environment variable") {
    setenv("MIR_OIDN_LIBRARY", MIR_FAKE_OIDN_1, 1);
    CHECK(Denoiser().name() == "Open Image Denoise 1.4.3");
    // What the caller names comes first.
    CHECK(Denoiser(MIR_FAKE_OIDN_2).name() == "Open Image Denoise 2.4.3");
    setenv("MIR_OIDN_LIBRARY", "/nowhere/else.so", 1);
    check_refused([] { Denoiser denoiser; }, mir::ErrorCode::no_device, "/nowhere/else.so");
    unsetenv("MIR_OIDN_LIBRARY");
}

TEST_CASE("failures of a denoiser come with its words, and nothing of it stays behind") {
    const int before = live_objects();
    const auto failed = mir::ErrorCode::device;
    {
        const mirtest::Told told("no device");
        check_refused([] { Denoiser denoiser(MIR_FAKE_OIDN_2); }, failed, "(no such processor)");
    }
    {
        const mirtest::Told told("null device");
        check_refused([] { Denoiser denoiser(MIR_FAKE_OIDN_2); }, failed, "gives no reason");
    }
    {
        const Denoiser denoiser(MIR_FAKE_OIDN_2);
        const Image<Rgb> picture = plain(1.0f, 1.0f, 1.0f);
        {
            const mirtest::Told told("failure");
            check_refused([&] { static_cast<void>(denoiser.denoise(picture)); }, failed,
                          "(out of memory)");
        }
        mir::Monitor monitor;
        check_all(denoiser.denoise(picture, {}, &monitor), {0.5f, 0.5f, 0.5f});
        monitor.cancelled = true;
        check_refused([&] { static_cast<void>(denoiser.denoise(picture, {}, &monitor)); },
                      mir::ErrorCode::cancelled, "cancelled");
    }
    CHECK(live_objects() == before);
}

TEST_CASE("pictures without pixels and guides of another size are refused") {
    const Denoiser denoiser(MIR_FAKE_OIDN_2);
    const Image<Rgb> picture = plain(1.0f, 1.0f, 1.0f);
    const Image<Rgb> other({3, 5}, {1.0f, 1.0f, 1.0f});
    const auto wrong = mir::ErrorCode::invalid_argument;
    check_refused([&] { static_cast<void>(denoiser.denoise({})); }, wrong, "without pixels");
    check_refused([&] { static_cast<void>(denoiser.denoise(picture, {&other})); }, wrong,
                  "another size");
}
