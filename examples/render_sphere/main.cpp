// SPDX-License-Identifier: MIT
//
// render_sphere [SCHEDULER [OUTPUT.exr]]
//
// Renders the built-in sphere scene with a scheduler that is chosen by name while the program runs,
// and writes an OpenEXR file and a PNG preview beside it.
#include "mir/io/exr.hpp"
#include "mir/io/png.hpp"
#include "mir/render.hpp"
#include "mir/scenes.hpp"

#include <exception>
#include <filesystem>
#include <iostream>

namespace {

void render_sphere(const std::string& scheduler, const std::filesystem::path& picture) {
    const mir::Scene scene = mir::builtin::make("sphere");
    mir::RenderSettings settings;
    settings.image = {320, 240};
    settings.vpls = 256;
    settings.scheduler = scheduler;
    const mir::RenderResult result = mir::render(scene, settings);

    auto preview = picture;
    preview.replace_extension(".png");
    mir::write_exr(picture, settings.image, {{"", &result.beauty}});
    mir::write_png(preview, result.beauty);
    std::cout << picture.string() << ": " << result.statistics.vpls << " VPLs\n";
    for (const std::string& warning : result.warnings)
        std::cerr << "render_sphere: warning: " << warning << '\n';
}

}  // namespace

int main(int argc, char** argv) {
    if (argc > 3) {
        std::cerr << "usage: render_sphere [SCHEDULER [OUTPUT.exr]]\n";
        return 2;
    }
    try {
        render_sphere(argc > 1 ? argv[1] : "", argc > 2 ? argv[2] : "sphere.exr");
    } catch (const std::exception& e) {
        std::cerr << "render_sphere: " << e.what() << '\n';
        return 1;
    }
}
