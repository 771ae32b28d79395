// SPDX-License-Identifier: MIT
#include "arguments.hpp"
#include "option_types.hpp"

namespace mirtool {

CLI::Option* add_denoiser(CLI::App& app, std::string& library) {
    return app
        .add_option("--denoiser", library,
                    "Library of Open Image Denoise (default: what MIR_OIDN_LIBRARY names, else the "
                    "system's)")
        ->type_name("FILE");
}

void add_denoise(CLI::App& app, DenoiseOptions& o) {
    app.add_option("image", o.image, "OpenEXR picture")->required()->type_name("FILE");
    app.add_option("output", o.output, "OpenEXR picture to write")->required()->type_name("FILE");
    app.add_option("--reference", o.reference,
                   "OpenEXR picture; the errors before and after are told by it")
        ->type_name("FILE");
    add_denoiser(app, o.denoiser);
    app.add_option("--threads", o.threads, "Threads of the processor (default 0: one per core)")
        ->check(between(0, 1024, "0 to 1024"));
    app.add_flag("--json", o.json, "Print what was done as JSON on stdout");
    app.add_flag("-q,--quiet", o.quiet, "No remarks");
}

}  // namespace mirtool
