// SPDX-License-Identifier: MIT
//
// What a bound of the geometry term costs, and what tracing back the light that it removes, or
// spreading it over spheres, costs: bias and noise of the indirect light with, without and beside a
// bound (docs/method.md, 4.4 and 4.5); and what VPLs lose that spread the lobe of their surface
// (4.6).
#include "mir/compare/comparable.hpp"
#include "mir/core/number_text.hpp"
#include "mir/reference/rgb_moments.hpp"
#include "mir/runtime/all_renderers.hpp"
#include "mir/runtime/check_scene.hpp"
#include "reference.hpp"
#include "tools/mir/load_scene.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>

namespace mirconvergence {
namespace {

struct BoundOptions {
    std::vector<std::string> scenes;
    std::uint32_t width = 64;
    std::uint32_t height = 48;
    std::vector<std::uint32_t> vpls{256};
    std::optional<float> roughness;  ///< of all that reflects, with an interface; else the scene's
    float metallic = 0.0f;           ///< of all that reflects, with `roughness`
    bool light_paths = false;        ///< instant radiosity, else Metropolis sampling
    std::uint32_t seeds = 32;
    std::uint32_t samples = 16384;
    std::vector<std::uint32_t> compensate{1, 4, 16};
    std::vector<float> vsl{1.0f};  ///< scales of the spheres' radii
    std::vector<float> glossy;     ///< least roughnesses of lobes that VPLs keep
    std::string cache;
};

/// A way to treat the bound.
struct Treatment {
    std::string name;
    mir::BoundPolicy::Kind bound = mir::BoundPolicy::Kind::automatic;
    std::uint32_t compensate = 0;
    float vsl = 0.0f;               ///< scale of the spheres' radii; 0: points
    std::optional<float> glossy{};  ///< least roughness of the lobes; none: Lambertian VPLs
};

std::vector<Treatment> treatments(const BoundOptions& o) {
    std::vector<Treatment> all{{"bounded"}};
    for (const std::uint32_t paths : o.compensate)
        all.push_back(
            {"compensate " + std::to_string(paths), mir::BoundPolicy::Kind::automatic, paths});
    for (const float scale : o.vsl)
        all.push_back({"spheres " + mir::fixed_text(double(scale), 2),
                       mir::BoundPolicy::Kind::automatic, 0, scale});
    for (const float roughness : o.glossy)
        all.push_back({"lobes from " + mir::fixed_text(double(roughness), 2),
                       mir::BoundPolicy::Kind::automatic, 0, 0.0f, roughness});
    all.push_back({"unbounded", mir::BoundPolicy::Kind::none});
    return all;
}

/// Mean and variance of the luminance of each pixel over renders.
class Renders {
 public:
    explicit Renders(mir::Extent size) : moments_(size) {}

    void add(const mir::RenderResult& r) {
        mir::check_comparable(r.indirect, r.indirect);  // NaN is an error
        for (std::size_t i = 0; i < moments_.pixels().size(); ++i) {
            const double y = luminance(r.indirect.pixels()[i]);
            moments_.pixels()[i].add({{y, y, y}}, count_);
        }
        ++count_;
        removed_ += r.statistics.removed_share();
        seconds_ += r.statistics.seconds.total;
    }

    /// Bias: RMS over pixels of the mean's distance from the truth, with what the noise of mean and
    /// reference adds to its square taken off. Noise: RMS of the standard deviation of one render.
    /// Both over the mean of the reference.
    void print(const std::string& scene, const Treatment& t, const BoundOptions& o,
               std::uint32_t vpls, const Reference& reference) const {
        double squares = 0.0;
        double variance = 0.0;
        double mean = 0.0;
        for (std::size_t i = 0; i < moments_.pixels().size(); ++i) {
            const mir::RgbMoments& m = moments_.pixels()[i];
            const double y = luminance(reference.indirect.pixels()[i]);
            const double of_mean = m.variance_of_mean(count_).channel[0];
            const double distance = m.mean.channel[0] - y;
            squares +=
                distance * distance - of_mean - static_cast<double>(reference.variance.pixels()[i]);
            variance += count_ * of_mean;
            mean += y;
        }
        const auto n = static_cast<double>(moments_.pixels().size());
        mean /= n;
        std::printf("%s,%s,%s,%s,%u,%u,%.4f,%.4f,%.4f,%.4f,%.3f\n", scene.c_str(),
                    o.roughness ? mir::fixed_text(double(*o.roughness), 2).c_str() : "",
                    o.light_paths ? "ir" : "mir", t.name.c_str(), vpls, count_,
                    std::sqrt(std::max(squares, 0.0) / n) / mean, std::sqrt(variance / n) / mean,
                    std::sqrt(std::max(squares + variance, 0.0) / n) / mean, removed_ / count_,
                    seconds_ / count_);
        std::fflush(stdout);
    }

 private:
    mir::Image<mir::RgbMoments> moments_;
    std::uint32_t count_ = 0;
    double removed_ = 0.0;
    double seconds_ = 0.0;
};

mir::RenderSettings settings_of(const Treatment& t, const BoundOptions& o) {
    mir::RenderSettings s;
    s.image = {o.width, o.height};
    s.luxels_per_pixel = 1;
    s.filter = mir::default_filter(mir::FilterKind::box);
    if (o.light_paths) s.sampler = mir::SamplerKind::instant_radiosity;
    s.direct_samples = 1;  // direct light is not looked at
    s.bound.kind = t.bound;
    s.compensate = t.compensate;
    s.vsl.enabled = t.vsl > 0.0f;
    if (s.vsl.enabled) s.vsl.scale = t.vsl;
    s.glossy.enabled = t.glossy.has_value();
    if (t.glossy) s.glossy.least_roughness = *t.glossy;
    return s;
}

mir::Scene scene_of(const std::string& name, const BoundOptions& o) {
    mir::Scene scene = mirtool::load_scene(name).scene;
    scene.name = mirtool::stem_of(name);
    if (o.roughness)
        for (mir::Material& m : scene.materials)
            if (!m.emits()) {
                m.specular = 1.0f;
                m.roughness = *o.roughness;
                m.metallic = o.metallic;
            }
    return scene;
}

void study(const std::string& name, const BoundOptions& o) {
    const mir::Scene scene = scene_of(name, o);
    const mir::Extent size{o.width, o.height};
    const Reference reference = cached_reference(scene, {size, o.samples, 0}, o.cache);
    mir::Registry registry;
    mir::add_cpu_to(registry);
    for (const std::uint32_t vpls : o.vpls)
        for (const Treatment& t : treatments(o)) {
            mir::RenderSettings s = settings_of(t, o);
            s.vpls = vpls;
            Renders renders(size);
            std::fprintf(stderr, "%s: %s, %u VPLs\n", scene.name.c_str(), t.name.c_str(), vpls);
            for (s.seed = 0; s.seed < o.seeds; ++s.seed)
                renders.add(registry.make(s.backend, s.scheduler)->render(scene, s, nullptr));
            renders.print(scene.name, t, o, vpls, reference);
        }
}

/// Reads the command line; an exit code, or -1 to go on.
int parse(int argc, char** argv, BoundOptions& o) {
    CLI::App app("Bias and noise of the indirect light with, without and beside a bound, as CSV.");
    app.add_option("--scene", o.scenes, "builtin:NAME or a file; several are done in turn")
        ->required();
    app.add_option("--width", o.width, "Pixels across (default 64)")->check(CLI::Range(1, 65536));
    app.add_option("--height", o.height, "Pixels down (default 48)")->check(CLI::Range(1, 65536));
    app.add_option("--vpls", o.vpls, "Numbers of VPLs (default 256)")
        ->delimiter(',')
        ->check(CLI::Range(1, 4000000));
    app.add_option("--roughness", o.roughness,
                   "Gives all that reflects an interface of this roughness")
        ->check(CLI::Range(0.0, 1.0));
    app.add_option("--metallic", o.metallic, "Makes it a metal by this share (default 0)")
        ->check(CLI::Range(0.0, 1.0));
    app.add_flag("--light-paths", o.light_paths,
                 "VPLs of instant radiosity, not of Metropolis sampling");
    app.add_option("--seeds", o.seeds, "Renders of each kind (default 32)")
        ->check(CLI::Range(2, 1000000));
    app.add_option("--samples", o.samples, "Paths per pixel of the reference (default 16384)")
        ->check(CLI::Range(1, 1 << 24));
    app.add_option("--compensate", o.compensate, "Numbers of paths per pixel (default 1,4,16)")
        ->delimiter(',')
        ->check(CLI::Range(1, 65536));
    app.add_option("--vsl", o.vsl, "Scales of the radii of spherical lights (default 1)")
        ->delimiter(',')
        ->check(CLI::Range(1e-3, 1e3));
    app.add_option("--glossy", o.glossy, "Least roughnesses of lobes that VPLs keep (default none)")
        ->delimiter(',')
        ->check(CLI::Range(0.0, 1.0));
    app.add_option("--cache", o.cache, "Folder that keeps references for the next run");
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& e) {
        return app.exit(e) == 0 ? 0 : 2;
    }
    return -1;
}

}  // namespace
}  // namespace mirconvergence

int main(int argc, char** argv) {
    try {
        mirconvergence::BoundOptions options;
        const int exit_code = mirconvergence::parse(argc, argv, options);
        if (exit_code >= 0) return exit_code;
        std::puts(
            "scene,roughness,sampler,treatment,vpls,seeds,bias,noise,rmse,removed_share,seconds");
        for (const std::string& scene : options.scenes) mirconvergence::study(scene, options);
    } catch (const std::exception& e) {
        std::fprintf(stderr, "bound_study: %s\n", e.what());
        return 3;
    }
    return 0;
}
