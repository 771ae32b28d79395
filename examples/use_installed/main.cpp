// SPDX-License-Identifier: MIT
//
// mean_radiance [OUTPUT.exr]
//
// Renders the furnace, a closed box whose radiance is 1 everywhere, with the compiled renderers,
// and prints the mean of what comes out.
#include <mir/io/exr.hpp>
#include <mir/render.hpp>
#include <mir/scenes.hpp>

#include <exception>
#include <iostream>

namespace {

mir::RenderResult render_furnace() {
    mir::RenderSettings settings;
    settings.image = {64, 48};
    settings.vpls = 4096;
    settings.backend = mir::BackendKind::cpu;
    settings.scheduler = "cpu-blocks";
    return mir::render(mir::builtin::make("furnace"), settings);
}

}  // namespace

int main(int argc, char** argv) {
    try {
        const mir::RenderResult result = render_furnace();
        double sum = 0.0;
        for (const mir::Rgb& pixel : result.beauty.pixels()) sum += mir::luminance(pixel);
        std::cout << "mean radiance " << sum / static_cast<double>(result.beauty.extent().area())
                  << " W/(m^2 sr)\n";
        if (argc > 1) mir::write_exr(argv[1], result.beauty.extent(), {{"", &result.beauty}});
    } catch (const std::exception& e) {
        std::cerr << "mean_radiance: " << e.what() << '\n';
        return 1;
    }
}
