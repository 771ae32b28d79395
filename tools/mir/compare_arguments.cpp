// SPDX-License-Identifier: MIT
#include "arguments.hpp"
#include "option_types.hpp"

namespace mirtool {
namespace {

/// Files of the comparison of two pictures; the ending of --error says what it is.
void add_compare_output(CLI::App& app, CompareOptions& o) {
    app.add_option("--html", o.report, "Report to write: one HTML file with pictures")
        ->type_name("FILE");
    app.add_option("--error", o.error, "Signed error to write: a picture (.png) or values (.exr)")
        ->check(CLI::Validator(
            [](const std::string& name) {
                return name.ends_with(".png") || name.ends_with(".exr")
                           ? std::string()
                           : "'" + name + "' ends neither in .png nor in .exr";
            },
            ""))
        ->type_name("FILE");
    app.add_flag("--json", o.json, "Print the metrics as JSON on stdout");
}

}  // namespace

void add_compare(CLI::App& app, CompareOptions& o) {
    app.add_option("image", o.image, "OpenEXR picture")->required()->type_name("FILE");
    app.add_option("reference", o.reference, "OpenEXR picture to compare it with")
        ->required()
        ->type_name("FILE");
    app.add_option("--second-reference", o.second_reference,
                   "Independent second reference, whose noise and the first's then cancel in the "
                   "scaled relMSE")
        ->type_name("FILE");
    app.add_option("--layer", o.layer,
                   "Layer to compare in all files (default: the picture itself)")
        ->type_name("NAME");
    add_compare_output(app, o);
    begin_group(app, "Limits (beyond one the exit code is 1)");
    const auto limit = between(0, 1e30, "0 to 1e30");
    app.add_option("--max-rmse", o.max_rmse, "Largest root mean square error")->check(limit);
    app.add_option("--max-relmse", o.max_relmse, "Largest relative mean square error")
        ->check(limit);
    app.add_option("--max-flip", o.max_flip,
                   "Largest mean HDR-FLIP: 0, no eye sees a difference, to 1")
        ->check(limit);
    app.add_option("--max-mean-difference", o.max_mean_difference,
                   "Largest difference of the means of a channel")
        ->check(limit)
        ->type_name("PERCENT");
    begin_group(app, "Metrics");
    app.add_option(
           "--epsilon", o.epsilon,
           "Added to the squared reference in the relative error, so that black does not count "
           "most (default 0.01)")
        ->check(between(0, 1e30, "0 to 1e30"));
    app.add_option(
           "--pixels-per-degree", o.pixels_per_degree,
           "Pixels per degree of visual angle, for FLIP (default 67: a screen 0.7 m wide with "
           "3840 pixels, 0.7 m away)")
        ->check(between(1, 1000, "1 to 1000"));
    app.add_option("--exposure", o.exposure,
                   "Stops by which the report's pictures, and what LDR-FLIP sees, are brighter "
                   "(default: chosen for the reference)")
        ->check(between(-100, 100, "-100 to 100"))
        ->type_name("EV");
}

}  // namespace mirtool
