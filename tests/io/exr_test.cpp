// SPDX-License-Identifier: MIT
#include "mir/io/exr.hpp"

#include "mir/core/random.hpp"
#include "support/catch.hpp"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFloatAttribute.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <half.h>

#include <array>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;
using mir::ExrLayer;
using mir::ExrPrecision;
using mir::Extent;
using mir::Image;
using mir::Rgb;
using mir::Vec3;

/// Folder of one test case, removed with it.
struct Folder {
    explicit Folder(const std::string& name)
        : path(fs::temp_directory_path() / ("mir_exr_test_" + name)) {
        fs::remove_all(path);
        fs::create_directories(path);
    }
    ~Folder() { fs::remove_all(path); }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;

    fs::path path;
};

std::string bytes_of(const fs::path& path) {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

Image<Rgb> noise(Extent extent) {
    Image<Rgb> image(extent);
    mir::Random random(9, mir::Stream::test, 0);
    for (Rgb& p : image.pixels())
        p = {1e6f * random.next() - 1e3f, 1e-6f * random.next(), random.next() - 0.5f};
    return image;
}

bool same_bits(const Image<Rgb>& a, const Image<Rgb>& b) {
    return a.extent() == b.extent() &&
           std::memcmp(a.pixels().data(), b.pixels().data(), a.pixels().size_bytes()) == 0;
}

template <class Call>
void check_refused(mir::ErrorCode code, const std::string& part, const Call& call) {
    try {
        call();
        FAIL("nothing was thrown");
    } catch (const mir::Error& error) {
        INFO(error.what());
        CHECK(error.code() == code);
        CHECK(std::string(error.what()).find(part) != std::string::npos);
    }
}

}  // namespace

TEST_CASE("a float beauty comes back from OpenEXR in every bit") {
    const Folder folder("beauty");
    const Image<Rgb> image = noise({67, 41});
    mir::write_exr(folder.path / "a.exr", image.extent(), {{"", &image}});
    CHECK(same_bits(mir::read_exr(folder.path / "a.exr").image, image));
}

TEST_CASE("layers keep their names, precision and values") {
    const Folder folder("layers");
    const fs::path file = folder.path / "layers.exr";
    const Extent extent{5, 3};
    const Image<Rgb> beauty = noise(extent), bounce = noise(extent);
    const Image<Rgb> albedo(extent, Rgb{0.1f, 0.5f, 0.8f});
    Image<Vec3> position(extent);
    position(4, 2) = {1.5f, -2e7f, 3.0f};
    const Image<float> depth(extent, 123456.7f), samples(extent, 16.0f);
    mir::write_exr(file, extent,
                   {{"", &beauty},
                    {"bounce2", &bounce},
                    {"albedo", &albedo, ExrPrecision::half},
                    {"position", &position},
                    {"depth", &depth},
                    {"samples", &samples, ExrPrecision::single, mir::ExrScalar::luminance}});
    CHECK(same_bits(mir::read_exr(file).image, beauty));
    CHECK(same_bits(mir::read_exr(file, "bounce2").image, bounce));
    const Rgb stored = mir::read_exr(file, "albedo").image(2, 1);
    CHECK(stored.r == static_cast<float>(half(0.1f)));
    CHECK(stored.r != 0.1f);
    CHECK(stored.g == 0.5f);
    CHECK(mir::read_exr(file, "position").image(4, 2) == Rgb{1.5f, -2e7f, 3.0f});
    CHECK(mir::read_exr(file, "depth").image(0, 0) == Rgb{123456.7f, 123456.7f, 123456.7f});
    const Imf::InputFile opened(file.string().c_str());
    const Imf::ChannelList& channels = opened.header().channels();
    REQUIRE(channels.findChannel("albedo.R") != nullptr);
    CHECK(channels.findChannel("albedo.R")->type == Imf::HALF);
    CHECK(channels.findChannel("depth.Z") != nullptr);
    CHECK(channels.findChannel("samples.Y") != nullptr);
    CHECK(opened.header().compression() == Imf::ZIP_COMPRESSION);
    check_refused(mir::ErrorCode::invalid_input, "albedo.B",
                  [&] { static_cast<void>(mir::read_exr(file, "missing")); });
}

TEST_CASE("attributes are written, Rec. 709 among them, and equal input gives equal bytes") {
    const Folder folder("bytes");
    const Image<Rgb> image = noise({33, 40});
    const mir::ExrAttributes attributes{{"software", "mir 1.2"},
                                        {"mir:seed", 7},
                                        {"mir:exposure", 1.5f},
                                        {"mir:command", "x"},
                                        {"mir:origin", mir::DVec3(1e7, 0.1, -3)}};
    for (const char* name : {"a.exr", "b.exr"})
        mir::write_exr(folder.path / name, image.extent(), {{"", &image}}, attributes);
    CHECK(bytes_of(folder.path / "a.exr") == bytes_of(folder.path / "b.exr"));
    using Texts = std::vector<std::pair<std::string, std::string>>;
    CHECK(mir::read_exr(folder.path / "a.exr").attributes ==
          Texts{{"mir:command", "x"}, {"software", "mir 1.2"}});
    using Vectors = std::vector<std::pair<std::string, mir::DVec3>>;
    CHECK((mir::read_exr(folder.path / "a.exr").vectors ==
           Vectors{{"mir:origin", mir::DVec3(1e7, 0.1, -3)}}));
    const Imf::InputFile file((folder.path / "a.exr").string().c_str());
    CHECK(file.header().typedAttribute<Imf::IntAttribute>("mir:seed").value() == 7);
    CHECK(file.header().typedAttribute<Imf::FloatAttribute>("mir:exposure").value() == 1.5f);
    CHECK(Imf::whiteLuminance(file.header()) == mir::white_efficacy);
    CHECK(Imf::chromaticities(file.header()).red == Imath::V2f(0.64f, 0.33f));
    CHECK(Imf::chromaticities(file.header()).white == Imath::V2f(0.3127f, 0.3290f));
    CHECK_FALSE(Imf::hasCapDate(file.header()));
    CHECK_FALSE(Imf::hasOwner(file.header()));
}

TEST_CASE("attribute names that are reserved or come twice are refused") {
    const Folder folder("reserved");
    const Image<Rgb> image({2, 2});
    for (const char* name : {"compression", "chromaticities", "type", ""})
        check_refused(mir::ErrorCode::invalid_argument, "attribute", [&] {
            mir::write_exr(folder.path / "a.exr", {2, 2}, {{"", &image}}, {{name, 1}});
        });
    check_refused(mir::ErrorCode::invalid_argument, "mir:a", [&] {
        mir::write_exr(folder.path / "a.exr", {2, 2}, {{"", &image}}, {{"mir:a", 1}, {"mir:a", 2}});
    });
    CHECK(fs::is_empty(folder.path));
}

TEST_CASE("NaN and infinities are refused with channel and count, and no file appears") {
    const Folder folder("nan");
    Image<Rgb> image({4, 4}, Rgb{1.0f, 1.0f, 1.0f});
    image(1, 2).g = std::numeric_limits<float>::quiet_NaN();
    image(3, 3).g = -std::numeric_limits<float>::infinity();
    check_refused(mir::ErrorCode::internal, "2 of the 16 values of channel direct.G", [&] {
        mir::write_exr(folder.path / "a.exr", {4, 4}, {{"direct", &image}});
    });
    CHECK(fs::is_empty(folder.path));
}

TEST_CASE("half refuses what it cannot hold instead of storing infinity") {
    const Folder folder("half");
    Image<Rgb> image({2, 2}, Rgb{65504.0f, -65504.0f, 0.0f});
    const fs::path file = folder.path / "a.exr";
    mir::write_exr(file, {2, 2}, {{"", &image, ExrPrecision::half}});
    CHECK(same_bits(mir::read_exr(file).image, image));
    image(0, 1).b = -70000.0f;
    check_refused(mir::ErrorCode::invalid_argument, "1 of the 4 values of channel B", [&] {
        mir::write_exr(file, {2, 2}, {{"", &image, ExrPrecision::half}});
    });
}

TEST_CASE("layers of different sizes, of one name and files without layers are refused") {
    const Folder folder("sizes");
    const Image<Rgb> image({2, 2});
    const Image<float> small({1, 2});
    const fs::path file = folder.path / "a.exr";
    using enum mir::ErrorCode;
    check_refused(invalid_argument, "layer 'depth'", [&] {
        mir::write_exr(file, {2, 2}, {{"", &image}, {"depth", &small}});
    });
    check_refused(invalid_argument, "channel B", [&] {
        mir::write_exr(file, {2, 2}, {{"", &image}, {"", &image}});
    });
    check_refused(invalid_argument, "layer", [&] { mir::write_exr(file, {2, 2}, {}); });
    check_refused(invalid_argument, "layer", [&] {
        mir::write_exr(file, {2, 2}, {{"x", static_cast<const Image<float>*>(nullptr)}});
    });
    CHECK_FALSE(fs::exists(file));
}

TEST_CASE("a folder that cannot be written is an error that names the file") {
    const Folder folder("unwritable");
    const Image<Rgb> image({2, 2});
    check_refused(mir::ErrorCode::io, "missing/a.exr", [&] {
        mir::write_exr(folder.path / "missing" / "a.exr", {2, 2}, {{"", &image}});
    });
}

TEST_CASE("missing, foreign, cut and oversized files are refused by the reader") {
    const Folder folder("broken");
    const fs::path file = folder.path / "a.exr";
    const auto read = [&] { static_cast<void>(mir::read_exr(file)); };
    check_refused(mir::ErrorCode::invalid_input, "a.exr", read);
    std::ofstream(file, std::ios::binary) << "P6 2 2 255 not an image";
    check_refused(mir::ErrorCode::invalid_input, "no OpenEXR", read);
    const Image<Rgb> image = noise({64, 64});
    mir::write_exr(file, image.extent(), {{"", &image}});
    mir::Limits limits;
    limits.pixels = 64 * 64 - 1;
    check_refused(mir::ErrorCode::limit_exceeded, "4096 pixels",
                  [&] { static_cast<void>(mir::read_exr(file, "", limits)); });
    const std::string whole = bytes_of(file);
    for (std::size_t kept = 4; kept < whole.size(); kept += 97) {
        std::ofstream(file, std::ios::binary)
            .write(whole.data(), static_cast<std::streamsize>(kept));
        CHECK_THROWS_AS(read(), mir::Error);
    }
}

TEST_CASE("a header that declares more pixels than allowed is refused before memory is taken") {
    const Folder folder("huge");
    const fs::path file = folder.path / "a.exr";
    const Image<Rgb> image({2, 2});
    mir::write_exr(file, image.extent(), {{"", &image}});
    std::string bytes = bytes_of(file);
    const std::size_t box =
        bytes.find("dataWindow") + std::strlen("dataWindow") + 1 + std::strlen("box2i") + 1 + 4;
    const int huge[2] = {99'999'999, 99'999'999};
    std::memcpy(&bytes[box + 8], huge, sizeof huge);
    std::ofstream(file, std::ios::binary) << bytes;
    check_refused(mir::ErrorCode::limit_exceeded, "pixels",
                  [&] { static_cast<void>(mir::read_exr(file)); });
}

TEST_CASE("a header that announces more than the file has is refused before memory is taken") {
    const auto [name, says] = GENERATE(table<std::string, std::string>(
        {{"long_attribute.exr", "bytes, but the file has "},
         {"long_channels.exr",
          "attribute 'channels' has 55 bytes, but one of type 'chlist' has "}}));
    const fs::path file = fs::path(MIR_FOUND_INPUTS_DIR) / "exr" / name;
    check_refused(mir::ErrorCode::invalid_input, says,
                  [&] { static_cast<void>(mir::read_exr(file)); });
}

TEST_CASE("a description of tiles in a file of scan lines counts for nothing") {
    const fs::path file = fs::path(MIR_FOUND_INPUTS_DIR) / "exr" / "tiles_of_lines.exr";
    check_refused(mir::ErrorCode::invalid_input, "tiles_of_lines.exr: the image cannot be read",
                  [&] { static_cast<void>(mir::read_exr(file)); });
}

TEST_CASE("pixels that the file's bytes cannot hold are refused before memory is taken") {
    const Folder folder("bomb");
    const fs::path file = folder.path / "a.exr";
    const Image<Rgb> image({2, 2});
    mir::write_exr(file, image.extent(), {{"", &image}});
    const std::string bytes = bytes_of(file);
    const std::size_t box = bytes.find("dataWindow") + 11 + 6 + 4;
    // One row of many pixels, and one column: many parts.
    for (const auto& size : {std::array{99'999'999, 0}, std::array{0, 999'999}}) {
        std::string wrong = bytes;
        std::memcpy(&wrong[box + 8], size.data(), sizeof size);
        std::ofstream(file, std::ios::binary) << wrong;
        check_refused(mir::ErrorCode::invalid_input, "bytes cannot hold",
                      [&] { static_cast<void>(mir::read_exr(file)); });
    }
}

TEST_CASE("chunks and rows of tiles that reach far beyond the image are refused") {
    const auto [name, says] = GENERATE(table<std::string, std::string>(
        {{"wide_line.exr", "1 parts of 1330151424 bytes, which 761 bytes cannot hold"},
         {"high_tiles.exr", "25 parts of 1144263216 bytes, which 492 bytes cannot hold"}}));
    const fs::path file = fs::path(MIR_FOUND_INPUTS_DIR) / "exr" / name;
    check_refused(mir::ErrorCode::invalid_input, says,
                  [&] { static_cast<void>(mir::read_exr(file)); });
}

TEST_CASE("one flat row of many pixels is no bomb") {
    const Folder folder("wide");
    const fs::path file = folder.path / "a.exr";
    const Image<Rgb> image({200'000, 1});
    mir::write_exr(file, image.extent(), {{"", &image}});
    CHECK(fs::file_size(file) < 16 * 12 * 200'000 / 4096);
    CHECK(mir::read_exr(file).image.extent().width == 200'000);
}
