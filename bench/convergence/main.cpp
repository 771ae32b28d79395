// SPDX-License-Identifier: MIT
//
// Error of the indirect light against the number of VPLs, for each sampler: docs/convergence.md.
#include "image_error.hpp"
#include "mir/io/exr.hpp"
#include "mir/io/png.hpp"
#include "mir/runtime/all_renderers.hpp"
#include "mir/runtime/renderer.hpp"
#include "montage.hpp"
#include "options.hpp"
#include "tools/mir/load_scene.hpp"

#include <cinttypes>
#include <cmath>
#include <cstdio>

namespace mirconvergence {
namespace {

/// One render of a study.
struct Run {
    std::string scene;
    NamedSampler sampler;
    std::uint32_t vpls = 0;
    std::uint64_t seed = 0;

    [[nodiscard]] std::string name() const {
        return scene + "-" + sampler.name + "-" + std::to_string(vpls) + "-" + std::to_string(seed);
    }
};

/// One luxel in the middle of each pixel and a box filter, so that pixels are luxels.
mir::RenderSettings settings_of(const Run& run, const Options& options) {
    mir::RenderSettings s;
    s.image = options.size;
    s.luxels_per_pixel = 1;
    s.filter = mir::default_filter(mir::FilterKind::box);
    s.sampler = run.sampler.kind;
    s.vpls = run.vpls;
    s.metropolis = options.chains;
    s.seed = run.seed;
    s.threads = options.threads;
    s.direct_samples = 1;  // direct light is not looked at
    if (!options.bounded) s.bound.kind = mir::BoundPolicy::Kind::none;
    return s;
}

void print_row(const Run& run, const ImageError& error, const mir::RenderStatistics& s) {
    std::printf("%s,%s,%" PRIu32 ",%" PRIu64 ",%.6g,%.6g,%.6g,%" PRIu32 ",%.4g\n",
                run.scene.c_str(), run.sampler.name.c_str(), run.vpls, run.seed, error.rmse,
                error.relative_rmse(), error.mean, s.vpls,
                s.seconds.bootstrap + s.seconds.sampling);
    std::fflush(stdout);
}

/// A reference whose own error is a large part of a difference makes that difference uncertain.
void warn_of_noise(const Run& run, const ImageError& error) {
    if (error.reference_share > 0.25)
        std::fprintf(
            stderr,
            "%s: %.0f %% of the squared difference is noise of the reference (it was taken "
            "off, but the rest is uncertain); ask for more --samples\n",
            run.name().c_str(), 100.0 * error.reference_share);
}

/// All renders of one scene.
class SceneStudy {
 public:
    SceneStudy(const std::string& scene, const Options& options)
        : options_(options), scene_(mirtool::load_scene(scene).scene) {
        scene_.name = mirtool::stem_of(scene);
        if (scene_.cameras.empty())
            throw mir::Error(mir::ErrorCode::invalid_input,
                             scene +
                                 ": the scene has no camera (there is no view to compare); "
                                 "add one");
        // A pinhole, so that a pixel sees the same point whatever the seed.
        scene_.cameras.front().lens_radius = 0.0f;
        reference_ = cached_reference(scene_, {options.size, options.samples, options.threads},
                                      options.cache);
    }

    void run() {
        for (const NamedSampler& sampler : options_.samplers)
            for (const std::uint32_t vpls : options_.vpls)
                for (std::uint64_t seed = 0; seed < options_.seeds; ++seed)
                    compare({scene_.name, sampler, vpls, seed});
        if (options_.montage.empty()) return;
        pictures_.push_back(reference_.indirect);
        const float exposure = mir::auto_exposure(reference_.indirect);
        const float white = std::exp2(-exposure);
        mir::write_png(options_.montage, montage(pictures_, 4, {white, white, white}), {exposure});
    }

 private:
    void compare(const Run& run) {
        std::fprintf(stderr, "%s\n", run.name().c_str());
        mir::Registry registry;
        mir::add_cpu_to(registry);
        const mir::RenderSettings settings = settings_of(run, options_);
        const mir::RenderResult result =
            registry.make(settings.backend, settings.scheduler)->render(scene_, settings, nullptr);
        const ImageError error = image_error(result.indirect, reference_);
        warn_of_noise(run, error);
        print_row(run, error, result.statistics);
        if (!options_.images.empty())
            mir::write_exr(std::filesystem::path(options_.images) / (run.name() + ".exr"),
                           options_.size, {{"", &result.indirect}});
        if (!options_.montage.empty() && run.seed == 0) pictures_.push_back(result.indirect);
    }

    const Options& options_;
    mir::Scene scene_;
    Reference reference_;
    std::vector<mir::Image<mir::Rgb>> pictures_;
};

}  // namespace
}  // namespace mirconvergence

int main(int argc, char** argv) {
    try {
        const auto [options, exit_code] = mirconvergence::parse(argc, argv);
        if (exit_code >= 0) return exit_code;
        std::puts("scene,sampler,vpls,seed,rmse,relative_rmse,mean,placed_vpls,sampling_seconds");
        for (const std::string& scene : options.scenes)
            mirconvergence::SceneStudy(scene, options).run();
    } catch (const std::exception& e) {
        std::fprintf(stderr, "convergence: %s\n", e.what());
        return 3;
    }
    return 0;
}
