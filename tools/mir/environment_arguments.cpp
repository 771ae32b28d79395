// SPDX-License-Identifier: MIT
#include "arguments.hpp"
#include "option_types.hpp"

namespace mirtool {

void add_environment(CLI::App& app, EnvironmentOptions& options) {
    CLI::Option* file = app.add_option("--environment", options.file,
                                       "OpenEXR picture of the light from all around, "
                                       "equirectangular, its centre at +x");
    app.add_option("--environment-scale", options.scale, "Factor of its light (default 1)")
        ->check(between(0, 1e30, "0 to 1e30"))
        ->needs(file);
    app.add_option("--environment-rotation", options.rotation,
                   "Degrees by which it is turned about +y, counter-clockwise seen from above "
                   "(default 0)")
        ->check(between(-360, 360, "-360 to 360"))
        ->needs(file);
}

}  // namespace mirtool
