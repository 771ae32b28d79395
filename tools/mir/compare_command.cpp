// SPDX-License-Identifier: MIT
#include "commands.hpp"
#include "compare_output.hpp"
#include "exit_code.hpp"
#include "mir/host/tbb_executor.hpp"
#include "mir/io/png.hpp"
#include "mir/runtime/cancellable_executor.hpp"
#include "progress.hpp"
#include "read_picture.hpp"
#include "text.hpp"

#include <cmath>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

namespace mirtool {
namespace {

mir::Image<mir::Rgb> exposed(mir::Image<mir::Rgb> image, float exposure_ev) {
    const float scale = std::exp2(exposure_ev);
    for (mir::Rgb& pixel : image.pixels()) pixel = pixel * scale;
    return image;
}

/// A metric with its limit.
struct Check {
    const char* name;
    const char* option;
    double value;
    std::optional<double> limit;
};

/// Names the metrics that are above their limits and says so.
std::vector<std::string> find_exceeded(const Comparison& c, const CompareOptions& o) {
    std::vector<std::string> exceeded;
    for (const Check& check : {Check{"rmse", "--max-rmse", c.metrics.rmse(), o.max_rmse},
                               Check{"relmse", "--max-relmse", c.metrics.rel_mse, o.max_relmse},
                               Check{"flip", "--max-flip", c.flip, o.max_flip},
                               Check{"mean_difference_percent", "--max-mean-difference",
                                     100.0 * c.metrics.mean_difference(), o.max_mean_difference}}) {
        if (!check.limit || check.value <= *check.limit) continue;
        exceeded.emplace_back(check.name);
        std::fprintf(stderr, "mir: %s: %s is %.6g, above the %.6g of %s\n", shown(o.image).c_str(),
                     check.name, check.value, *check.limit, check.option);
    }
    return exceeded;
}

/// From both references where there are two.
mir::ScaledRelMse scaled_error(const Comparison& c, const CompareOptions& o) {
    if (o.second_reference.empty()) return mir::scaled_rel_mse(c.image, c.reference);
    const mir::Image<mir::Rgb> second = read_picture(o.second_reference, o.layer).image;
    mir::check_comparable(c.image, second, o.image, o.second_reference);
    return mir::scaled_rel_mse(c.image, c.reference, second);
}

Comparison compare(const CompareOptions& o, mir::Monitor& monitor) {
    Comparison c;
    Picture image = read_picture(o.image, o.layer);
    Picture reference = read_picture(o.reference, o.layer);
    c.image = std::move(image.image);
    c.reference = std::move(reference.image);
    c.origin = image.origin;
    c.reference_origin = reference.origin;
    mir::check_comparable(c.image, c.reference, o.image, o.reference);
    c.metrics = mir::compare_images(c.image, c.reference, o.epsilon);
    c.scaled = scaled_error(c, o);
    c.exposure = o.exposure ? *o.exposure : mir::auto_exposure(c.reference);
    c.flip_exposures = mir::flip_exposures(c.reference);
    mir::TbbExecutor threads;
    mir::CancellableExecutor executor(threads, &monitor);
    c.flip_map = mir::hdr_flip(c.image, c.reference, o.pixels_per_degree, executor);
    c.flip = mir::mean_of(c.flip_map);
    c.ldr_flip =
        mir::mean_of(mir::ldr_flip(exposed(c.image, c.exposure), exposed(c.reference, c.exposure),
                                   o.pixels_per_degree, executor));
    monitor.check();
    return c;
}

}  // namespace

int run(const CompareOptions& options) {
    check_outputs(options);
    // Also while files are written, since a signal that ended the program there would leave halves.
    mir::Monitor monitor;
    const CancelOnInterrupt cancel(monitor);
    Comparison comparison;
    try {
        comparison = compare(options, monitor);
    } catch (const mir::Error& e) {
        if (e.code() != mir::ErrorCode::cancelled) throw;
        throw mir::Error(e.code(), "the comparison was cancelled; nothing was written", e.where());
    }
    comparison.exceeded = find_exceeded(comparison, options);
    write_outputs(comparison, options);
    print_metrics(comparison, options);
    return comparison.exceeded.empty() ? exit_done : exit_failure;
}

}  // namespace mirtool
