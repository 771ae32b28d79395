// SPDX-License-Identifier: MIT
#include "arguments.hpp"
#include "option_types.hpp"

namespace mirtool {
namespace {

/// Files of the comparison of two pictures; the ending of --error says what it is.
void add_compare_output(CLI::App& app, CompareOptions& o) {
    app.add_option("--html", o.report, "Report to write, one HTML file with pictures");
    app.add_option("--error", o.error, "Signed error to write: a picture (.png) or values (.exr)")
        ->check(CLI::Validator(
            [](const std::string& name) {
                return name.ends_with(".png") || name.ends_with(".exr")
                           ? std::string()
                           : "'" + name + "' ends neither in .png nor in .exr";
            },
            ""));
    app.add_flag("--json", o.json, "Print the metrics as JSON on stdout");
}

}  // namespace

void add_compare(CLI::App& app, CompareOptions& o) {
    app.add_option("image", o.image, "OpenEXR picture")->required();
    app.add_option("reference", o.reference, "OpenEXR picture to compare it with")->required();
    app.add_option("--second-reference", o.second_reference,
                   "Independent second reference, whose noise and the first's then cancel in the "
                   "scaled relMSE");
    app.add_option("--layer", o.layer, "Layer to compare in all files (default: the beauty)");
    add_compare_output(app, o);
    const auto limit = between(0, 1e30, "0 to 1e30");
    app.add_option("--max-rmse", o.max_rmse, "Exit with 1 when the RMSE is above")->check(limit);
    app.add_option("--max-relmse", o.max_relmse, "Exit with 1 when the relMSE is above")
        ->check(limit);
    app.add_option("--max-flip", o.max_flip, "Exit with 1 when the mean HDR-FLIP is above")
        ->check(limit);
    app.add_option(
           "--max-mean-difference", o.max_mean_difference,
           "Exit with 1 when the mean of a channel is further from the reference's, percent")
        ->check(limit);
    app.add_option("--epsilon", o.epsilon, "Epsilon of the relMSE (default 0.01)")
        ->check(between(0, 1e30, "0 to 1e30"));
    app.add_option("--pixels-per-degree", o.pixels_per_degree,
                   "Pixels per degree of visual angle, for FLIP (default 67)")
        ->check(between(1, 1000, "1 to 1000"));
    app.add_option("--exposure", o.exposure,
                   "Exposure of pictures and LDR-FLIP, EV (default: automatic)")
        ->check(between(-100, 100, "-100 to 100"));
}

}  // namespace mirtool
