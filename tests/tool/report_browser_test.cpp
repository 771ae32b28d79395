// SPDX-License-Identifier: MIT
#include "tool/browser.hpp"
#include "tool/report_file.hpp"

#include <png.h>

#include <array>

using namespace mirtest;

namespace {

/// Pixels of a PNG file, 8-bit sRGB.
struct Screenshot {
    std::uint32_t width = 0;
    std::vector<std::uint8_t> codes;

    explicit Screenshot(const std::filesystem::path& path) {
        png_image image{};
        image.version = PNG_IMAGE_VERSION;
        REQUIRE(png_image_begin_read_from_file(&image, path.c_str()) != 0);
        image.format = PNG_FORMAT_RGB;
        width = image.width;
        codes.resize(PNG_IMAGE_SIZE(image));
        REQUIRE(png_image_finish_read(&image, nullptr, codes.data(), 0, nullptr) != 0);
    }
    [[nodiscard]] std::array<int, 3> pixel(std::size_t i) const {
        return {codes[3 * i], codes[3 * i + 1], codes[3 * i + 2]};
    }
    /// Pixels that `wanted` takes.
    template <class Wanted>
    [[nodiscard]] std::size_t count(const Wanted& wanted) const {
        std::size_t n = 0;
        for (std::size_t i = 0; i < codes.size() / 3; ++i) n += wanted(pixel(i)) ? 1 : 0;
        return n;
    }
};

}  // namespace

TEST_CASE("a browser shows a report's layers in light and dark and has nothing to complain of") {
    if (browser().empty()) {
        WARN("skipped: no chromium, chromium-browser or google-chrome on the path");
        return;
    }
    const TemporaryFolder folder("report_browser");
    const auto page = folder / "r.html";
    const std::string reference = (folder / "a.exr").string();
    const auto render = [&](const std::string& name) {
        return small_render(folder / name, "builtin:cornell-box", 64, 48) + Words{"--no-png"};
    };
    REQUIRE(run_mir(render("a.exr")).exit_code == 0);
    REQUIRE(
        run_mir(render("b.exr") + Words{"--report", page.string(), "--report-reference", reference})
            .exit_code == 0);
    const Outcome dom = open_page(page, folder, {"--dump-dom"});
    CHECK(has(dom.out, "data-ready=\"true\""));
    CHECK(has(dom.out, "Beauty of the render, left 50 %"));
    CHECK_FALSE(has(dom.err, "CONSOLE"));
    // Another script in its place is none.
    std::string changed = file_bytes(page);
    changed.replace(changed.find("const find"), 10, "const  seek");
    std::ofstream(folder / "changed.html", std::ios::binary) << changed;
    const Outcome refused = open_page(folder / "changed.html", folder, {"--dump-dom"});
    CHECK(has(refused.err, "CONSOLE"));
    CHECK_FALSE(has(refused.out, "data-ready=\"true\""));
    const std::array<int, 3> light{0xe8, 0xe8, 0xe8}, dark{0x24, 0x24, 0x24};
    for (const auto& [scheme, back] : {std::pair{"1", light}, std::pair{"0", dark}}) {
        const std::string shot = (folder / "shot.png").string();
        const Outcome seen =
            open_page(page, folder,
                      {"--screenshot=" + shot,
                       std::string("--blink-settings=preferredColorScheme=") + scheme});
        CHECK_FALSE(has(seen.err, "CONSOLE"));
        const Screenshot pixels(shot);
        CHECK(pixels.pixel(0) == back);
        // The walls of the box, and the line of the split.
        CHECK(pixels.count([](auto p) { return p[0] > 3 * p[1] && p[0] > 60; }) > 5000);
        CHECK(pixels.count([](auto p) { return p[1] > p[0] + 30 && p[1] > 2 * p[2]; }) > 5000);
        CHECK(pixels.count([](auto p) { return p[0] + p[1] + p[2] == 3 * 255; }) > 300);
    }
}
