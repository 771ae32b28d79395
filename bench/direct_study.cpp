// SPDX-License-Identifier: MIT
//
// Noise and time of direct light by ways to choose lamps, as CSV: `direct_study SCENE...`. A scene
// is `hall`, `bulbs` (the hall with point lights), or what `mir render` takes. 160 x 120 pixels of
// four luxels, seeds 1 to 4. Noise is the standard deviation of a pixel over its light, root mean
// square over the pixels; pixels much darker than the mean weigh less. One thread; seconds of CPU
// time of one picture.
#include "mir/for_each_luxel.hpp"
#include "mir/kernels/luxel_light.hpp"
#include "mir/shading/cook_torrance.hpp"
#include "support/hall_of_lamps.hpp"
#include "support/study_scene.hpp"
#include "tools/mir/load_scene.hpp"

#include <cmath>
#include <ctime>
#include <iostream>
#include <string>
#include <vector>

namespace {

using B = mir::CookTorrance;
using Picture = mir::Image<mir::Rgb>;
using Sight = mir::cpu::EmbreeVisibility;

constexpr mir::Extent pixels{160, 120};

/// Emissive triangles by power alone: the rule of before the tree.
struct PickByPower {
    template <mir::Space S>
    static mir::LightPick pick(const mir::LightTableView<S>& lights, const mir::LightReceiver&,
                               double u) {
        const std::uint32_t lamp = lights.lamps.by_power.sample(static_cast<float>(u));
        return {lamp, static_cast<double>(lights.lamps.lamp_triangles[lamp].probability)};
    }
};

/// The tree of lamps without the lobes of glossy surfaces: the rule of before LobeSamples.
struct PickAlone : mir::PickByTree {};

/// A scene and what its camera sees.
class Study {
 public:
    explicit Study(mir::Scene scene) : of_(std::move(scene), pixels, 4) {}

    [[nodiscard]] const mir::LightTable& lights() const { return of_.lights; }
    [[nodiscard]] Sight sight() const { return of_.engine.visibility(); }

    /// Means over the luxels of each pixel of light(hit, surface, x, y, band).
    template <class Light>
    [[nodiscard]] Picture picture(std::uint64_t seed, const Light& light) {
        const mir::LuxelBand band{0, of_.grid, seed};
        Picture luxels(of_.grid.luxels());
        mir::for_each_luxel(of_.gbuffer, of_.executor,
                            [&](std::uint32_t x, std::uint32_t y, const auto& of, auto i) {
                                const mir::Hit hit = of.hit(i);
                                if (is_empty(hit)) return;
                                luxels(x, y) = light(hit, of.surface(i), x, y, band);
                            });
        Picture means(pixels);
        for (std::uint32_t y = 0; y < luxels.height(); ++y)
            for (std::uint32_t x = 0; x < luxels.width(); ++x)
                means(x / of_.grid.per_pixel_x, y / of_.grid.per_pixel_y) +=
                    luxels(x, y) * (1.0f / static_cast<float>(of_.grid.per_pixel()));
        return means;
    }

 private:
    mirbench::StudyScene<B> of_;
};

/// From independent pictures of the same thing; 0 of one.
double noise(const std::vector<Picture>& pictures) {
    const auto n = static_cast<double>(pictures.size());
    if (pictures.size() < 2) return 0.0;
    std::vector<double> means;
    std::vector<double> variances;
    double all = 0.0;
    for (std::size_t i = 0; i < pictures.front().pixels().size(); ++i) {
        double sum = 0.0;
        double squares = 0.0;
        for (const Picture& p : pictures) {
            const auto y = static_cast<double>(luminance(p.pixels()[i]));
            sum += y;
            squares += y * y;
        }
        means.push_back(sum / n);
        variances.push_back((squares - sum * sum / n) / (n - 1.0));
        all += sum / n;
    }
    const double dim = 0.1 * all / static_cast<double>(means.size());
    double total = 0.0;
    for (std::size_t i = 0; i < means.size(); ++i)
        total += variances[i] / (means[i] * means[i] + dim * dim);
    return std::sqrt(total / static_cast<double>(means.size()));
}

template <class Light>
void report(Study& study, const std::string& scene, const char* method, std::uint32_t samples,
            const Light& light, std::uint32_t seeds = 4) {
    std::vector<Picture> pictures;
    const std::clock_t start = std::clock();
    for (std::uint64_t seed = 1; seed <= seeds; ++seed)
        pictures.push_back(study.picture(seed, light));
    const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC / seeds;
    double mean = 0.0;
    for (const Picture& p : pictures)
        for (const mir::Rgb& c : p.pixels()) mean += static_cast<double>(luminance(c));
    std::cout << scene << ',' << method << ',' << 4 * samples << ',' << seconds << ','
              << noise(pictures) << ',' << mean / (seeds * double{pixels.width} * pixels.height)
              << std::endl;
}

/// Samples of a pixel that know of each other, as LuxelLight has them.
template <class Pick>
auto shared_samples(const Study& study, std::uint32_t samples) {
    return [light = mir::EmitterLight<B, Sight, Pick>(study.lights(), study.sight(), samples)](
               const mir::Hit& hit, const mir::Surface<B::Params>& s, std::uint32_t x,
               std::uint32_t y, const mir::LuxelBand& band) {
        return light(hit, s, {band.grid.per_pixel(), band.cell(x, y)}, band.pixel_numbers(x, y));
    };
}

/// Samples that do not.
auto lone_samples(const Study& study, std::uint32_t samples) {
    return [light = mir::EmitterLight<B, Sight>(study.lights(), study.sight(), 1), samples](
               const mir::Hit& hit, const mir::Surface<B::Params>& s, std::uint32_t x,
               std::uint32_t y, const mir::LuxelBand& band) {
        mir::Rgb sum;
        for (std::uint32_t k = 0; k < samples; ++k) {
            const std::uint64_t luxel = std::uint64_t{y} * band.grid.luxels().width + x;
            sum += light(hit, s, {}, {band.seed, mir::Stream::test, luxel * samples + k});
        }
        return sum * (1.0f / static_cast<float>(samples));
    };
}

/// All that the scene lists, one by one.
auto summed(const Study& study) {
    return [light = mir::ListedLight<B, Sight>(study.lights(), study.sight())](
               const mir::Hit& hit, const mir::Surface<B::Params>& s, std::uint32_t, std::uint32_t,
               const mir::LuxelBand&) {
        return light(hit, s, [](std::uint32_t) { return mir::Vec2(0.5f); });
    };
}

mir::Scene scene_of(const std::string& name) {
    if (name == "hall" || name == "bulbs") return mirbench::hall_of_lamps(name == "bulbs");
    return mirtool::load_scene(name).scene;
}

void run(const std::string& name) {
    Study study(scene_of(name));
    if (!study.lights().listed().empty()) report(study, name, "sum", 0, summed(study), 1);
    if (study.lights().tree().nodes().empty()) return;
    for (const std::uint32_t samples : {1u, 4u, 8u}) {
        if (study.lights().has_emitters())
            report(study, name, "power", samples, shared_samples<PickByPower>(study, samples));
        report(study, name, "tree alone", samples, lone_samples(study, samples));
        report(study, name, "tree", samples, shared_samples<PickAlone>(study, samples));
        report(study, name, "tree and lobes", samples,
               shared_samples<mir::PickByTree>(study, samples));
    }
}

}  // namespace

int main(int argc, char** argv) {
    try {
        std::cout << "scene,method,samples,seconds,noise,mean\n";
        for (int i = 1; i < argc; ++i) run(argv[i]);
    } catch (const std::exception& e) {
        std::cerr << "direct_study: " << e.what() << '\n';
        return 1;
    }
    return 0;
}
