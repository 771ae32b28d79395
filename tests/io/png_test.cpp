// SPDX-License-Identifier: MIT
#include "mir/io/png.hpp"

#include "support/catch.hpp"

#include <png.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;
using mir::Image;
using mir::Rgb;
using mirtest::Approx;

/// File of one test case, removed with it.
struct File {
    explicit File(const std::string& name)
        : path(fs::temp_directory_path() / ("mir_png_test_" + name + ".png")) {}
    ~File() { fs::remove(path); }
    File(const File&) = delete;
    File& operator=(const File&) = delete;

    fs::path path;
};

std::string bytes_of(const fs::path& path) {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

/// 8-bit RGB as stored.
std::vector<std::uint8_t> decode(const fs::path& path, std::uint32_t width, std::uint32_t height) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    REQUIRE(png_image_begin_read_from_file(&image, path.string().c_str()) != 0);
    CHECK(image.width == width);
    CHECK(image.height == height);
    image.format = PNG_FORMAT_RGB;
    std::vector<std::uint8_t> codes(PNG_IMAGE_SIZE(image));
    REQUIRE(png_image_finish_read(&image, nullptr, codes.data(), 0, nullptr) != 0);
    return codes;
}

}  // namespace

TEST_CASE("the sRGB curve has its known codes and clamps both ends") {
    CHECK(mir::to_srgb8(0.0f) == 0);
    CHECK(mir::to_srgb8(-3.0f) == 0);
    CHECK(mir::to_srgb8(std::numeric_limits<float>::quiet_NaN()) == 0);
    CHECK(mir::to_srgb8(0.0031308f) == 10);
    CHECK(mir::to_srgb8(0.18f) == 118);
    CHECK(mir::to_srgb8(0.5f) == 188);
    CHECK(mir::to_srgb8(1.0f) == 255);
    CHECK(mir::to_srgb8(std::numeric_limits<float>::infinity()) == 255);
}

TEST_CASE("a preview holds exposed, clamped sRGB codes and an sRGB chunk") {
    const File file("codes");
    Image<Rgb> image({3, 2});
    image(0, 0) = {0.25f, 0.09f, 0.5f};
    image(2, 1) = {-1.0f, 1e9f, 0.0f};
    mir::write_png(file.path, image, {1.0f});
    const std::vector<std::uint8_t> codes = decode(file.path, 3, 2);
    CHECK(codes == std::vector<std::uint8_t>{188, 118, 255, 0, 0, 0, 0, 0, 0,  //
                                             0, 0, 0, 0, 0, 0, 0, 255, 0});
    CHECK(bytes_of(file.path).find("sRGB") != std::string::npos);
}

TEST_CASE("dithered codes have the mean of what they stand for, and leave black and white alone") {
    const File file("dither");
    Image<Rgb> image({64, 64}, Rgb{0.0f, 0.002f, 1.0f});
    mir::write_png(file.path, image, {0.0f, mir::ToneCurve::none, true});
    std::array<double, 3> sums{};
    const std::vector<std::uint8_t> codes = decode(file.path, 64, 64);
    for (std::size_t i = 0; i < codes.size(); ++i) sums[i % 3] += codes[i];
    CHECK(sums[0] == 0.0);
    // 12.92 0.002 255 codes, between 6 and 7.
    CHECK(sums[1] / 4096 == Approx(6.5892).margin(0.02));
    CHECK(sums[2] / 4096 == 255.0);
}

TEST_CASE("equal input gives equal bytes of PNG") {
    const File a("a"), b("b");
    const Image<Rgb> image({20, 10}, Rgb{0.1f, 0.2f, 0.3f});
    mir::write_png(a.path, image);
    mir::write_png(b.path, image);
    CHECK(bytes_of(a.path) == bytes_of(b.path));
}

TEST_CASE("automatic exposure maps the 90th percentile of luminance to 0.8") {
    Image<Rgb> image({100, 10});
    float value = 0.0f;
    for (Rgb& pixel : image.pixels()) {
        value += 0.01f;
        pixel = {value, value, value};
    }
    CHECK(9.0f * std::exp2(mir::auto_exposure(image)) == Approx(0.8f).epsilon(0.01));
    for (Rgb& pixel : image.pixels()) pixel = pixel * 1024.0f;
    CHECK(9.0f * 1024.0f * std::exp2(mir::auto_exposure(image)) == Approx(0.8f).epsilon(0.01));
}

TEST_CASE("automatic exposure of a black image is 0 and of a small bright object is not") {
    Image<Rgb> image({100, 10});
    CHECK(mir::auto_exposure(image) == 0.0f);
    CHECK(mir::auto_exposure(Image<Rgb>{}) == 0.0f);
    image(3, 3) = {0.2f, 0.2f, 0.2f};
    image(4, 3).r = std::numeric_limits<float>::quiet_NaN();
    CHECK(mir::auto_exposure(image) == Approx(2.0f));
}

TEST_CASE("a preview that cannot be written is an error that names the file") {
    const Image<Rgb> image({2, 2});
    try {
        mir::write_png(fs::temp_directory_path() / "mir_png_test_missing" / "a.png", image);
        FAIL("nothing was thrown");
    } catch (const mir::Error& error) {
        CHECK(error.code() == mir::ErrorCode::io);
        CHECK(std::string(error.what()).find("a.png") != std::string::npos);
    }
    CHECK_THROWS_AS(mir::write_png("a.png", Image<Rgb>{}), mir::Error);
}
