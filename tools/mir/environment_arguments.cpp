// SPDX-License-Identifier: MIT
#include "arguments.hpp"
#include "option_types.hpp"

namespace mirtool {

void add_environment(CLI::App& app, EnvironmentOptions& options) {
    CLI::Option* file = app.add_option("--environment", options.file,
                                       "Light from all around: an equirectangular OpenEXR picture, "
                                       "its centre at +x")
                            ->type_name("FILE");
    app.add_option("--environment-scale", options.scale,
                   "Factor of the environment's light (default 1)")
        ->check(between(0, 1e30, "0 to 1e30"))
        ->needs(file);
    app.add_option(
           "--environment-rotation", options.rotation,
           "Turn of the environment about +y, counter-clockwise seen from above (default 0)")
        ->check(between(-360, 360, "-360 to 360"))
        ->needs(file)
        ->type_name("DEGREES");
}

}  // namespace mirtool
