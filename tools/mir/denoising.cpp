// SPDX-License-Identifier: MIT
#include "denoising.hpp"

#include "mir/core/stopwatch.hpp"
#include "text.hpp"

#include <cstdio>

namespace mirtool {
namespace {

using Json = nlohmann::ordered_json;

Json change_of(double before, double after) { return {{"before", before}, {"after", after}}; }

}  // namespace

void Denoising::measure(const mir::Image<mir::Rgb>& noisy, const mir::Image<mir::Rgb>& clean,
                        const mir::Image<mir::Rgb>& by, const std::string& name) {
    if (by.extent().area() == 0) return;
    reference = name;
    before = mir::compare_images(noisy, by);
    after = mir::compare_images(clean, by);
}

Denoising denoise_result(mir::RenderResult& result, const mir::Denoiser& denoiser,
                         mir::Monitor& monitor) {
    Denoising done;
    if (monitor.cancelled) return done;
    try {
        const mir::Stopwatch watch(done.seconds);
        result.denoised = mir::denoise(result, denoiser, &monitor);
    } catch (const mir::Error& e) {
        if (e.code() != mir::ErrorCode::cancelled) throw;
        return done;
    }
    result.denoiser = done.denoiser = denoiser.name();
    return done;
}

std::string filter_remark(const std::string& filter) {
    if (filter.empty() || filter == "box") return "";
    return "the pixel filter " + shown(filter) +
           " spreads noise over neighbours, so that a denoiser takes it for detail; render with "
           "--filter box";
}

Json json_of(const Denoising& d) {
    if (d.denoiser.empty()) return {};
    Json out{{"denoiser", d.denoiser}, {"seconds", d.seconds}};
    out["reference"] = d.reference.empty() ? Json() : Json(d.reference);
    out["rmse"] = d.before ? change_of(d.before->rmse(), d.after->rmse()) : Json();
    out["relmse"] = d.before ? change_of(d.before->rel_mse, d.after->rel_mse) : Json();
    return out;
}

void print(const Denoising& d) {
    if (d.denoiser.empty()) return;
    std::fprintf(stderr, "mir: denoised by %s in %.2f s\n", d.denoiser.c_str(), d.seconds);
    if (!d.before) return;
    std::fprintf(stderr, "mir: error by %s: RMSE %.4g before, %.4g after; relMSE %.4g, %.4g\n",
                 shown(d.reference).c_str(), d.before->rmse(), d.after->rmse(), d.before->rel_mse,
                 d.after->rel_mse);
}

}  // namespace mirtool
