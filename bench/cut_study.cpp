// SPDX-License-Identifier: MIT
//
// Error and time of cuts beside plain VPLs, as CSV: `cut_study SCENE [VPLS]`. The truth is the sum
// of all VPLs of a tree (instant radiosity, seed 1) at 320 x 240 luxels. Plain VPLs are those of
// another seed under the same bound. One thread; seconds of CPU time, without sampling.
#include "mir/cuts/deviation_cut.hpp"
#include "mir/reconstruct_cuts.hpp"
#include "mir/sampling/instant_radiosity_sampler.hpp"
#include "mir/sampling/visible_area.hpp"
#include "mir/scenes.hpp"
#include "mir/sched/cpu_blocks.hpp"
#include "mir/shading/lambert.hpp"
#include "mir/shading/vpl_shading.hpp"
#include "support/study_scene.hpp"

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <iostream>
#include <numeric>
#include <string>
#include <vector>

namespace {

using B = mir::Lambert;
using Picture = mir::Image<mir::Rgb>;

constexpr mir::Extent luxels{320, 240};

/// A scene, what its camera sees, and VPLs.
class Study {
 public:
    explicit Study(const std::string& name) : of_(mir::builtin::make(name), luxels, 1) {}

    [[nodiscard]] mir::VplList vpls(std::uint32_t count, std::uint64_t seed) {
        mir::InstantRadiosityOptions options;
        options.vpls = count;
        options.seed = seed;
        const mir::InstantRadiositySampler<B, mir::cpu::EmbreeRayCaster> sampler(
            {of_.geometry, of_.lights, of_.surfaces, of_.engine.ray_caster()}, options);
        return aggregate(sampler.sample(of_.executor));
    }

    [[nodiscard]] mir::VplShading<B> shading(std::uint32_t count) const {
        const float aspect = static_cast<float>(luxels.width) / static_cast<float>(luxels.height);
        const mir::LuxelTracer tracer{of_.engine.ray_caster(), of_.surfaces.view()};
        return {mir::default_bound(mir::visible_area(of_.rays.camera, aspect, tracer), count)};
    }

    [[nodiscard]] Picture sum(mir::VplSpan<mir::Space::host> vpls,
                              const mir::VplShading<B>& shading) {
        return reconstruct(mir::sched::CpuBlocks{of_.executor}, of_.gbuffer, vpls,
                           of_.engine.visibility(), shading);
    }

    [[nodiscard]] Picture cuts(const mir::VplTree& tree, std::uint32_t picks,
                               const mir::VplShading<B>& shading) {
        return reconstruct_cuts(of_.gbuffer, tree, of_.engine.visibility(), shading,
                                mir::DeviationCut{picks}, {5}, of_.executor);
    }

    [[nodiscard]] mir::VplTree tree(const mir::VplList& vpls) {
        return {vpls.span(), of_.executor};
    }

 private:
    mirbench::StudyScene<B> of_;
};

/// Means of squares of 4 x 4.
Picture pooled(const Picture& picture) {
    Picture means({picture.width() / 4, picture.height() / 4});
    for (std::uint32_t y = 0; y < means.height(); ++y)
        for (std::uint32_t x = 0; x < means.width(); ++x)
            for (std::uint32_t i = 0; i < 16; ++i)
                means(x, y) += picture(4 * x + i % 4, 4 * y + i / 4) * (1.0f / 16.0f);
    return means;
}

/// Mean of (L - T)^2 / (T^2 + 0.01 mean^2) without the worst 0.5 %.
double relative_mse(const Picture& picture, const Picture& truth) {
    double mean = 0.0;
    for (const mir::Rgb& t : truth.pixels()) mean += static_cast<double>(luminance(t));
    mean /= static_cast<double>(truth.pixels().size());
    std::vector<double> errors;
    for (std::size_t i = 0; i < truth.pixels().size(); ++i) {
        const auto t = static_cast<double>(luminance(truth.pixels()[i]));
        const double d = static_cast<double>(luminance(picture.pixels()[i])) - t;
        errors.push_back(d * d / (t * t + 0.01 * mean * mean));
    }
    std::sort(errors.begin(), errors.end());
    errors.resize(errors.size() * 995 / 1000);
    return std::accumulate(errors.begin(), errors.end(), 0.0) / static_cast<double>(errors.size());
}

template <class Make>
void report(const char* method, std::uint32_t picks, const Picture& truth, const Make& make) {
    const std::clock_t start = std::clock();
    const Picture picture = make();
    const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    std::cout << method << ',' << picks << ',' << seconds << ',' << relative_mse(picture, truth)
              << ',' << relative_mse(pooled(picture), pooled(truth)) << std::endl;
}

}  // namespace

int main(int argc, char** argv) {
    const std::string name = argc > 1 ? argv[1] : "cornell-box";
    const auto count = static_cast<std::uint32_t>(argc > 2 ? std::atoi(argv[2]) : 16384);
    try {
        Study study(name);
        const mir::VplList all = study.vpls(count, 1);
        const auto shading = study.shading(count);
        const mir::VplTree tree = study.tree(all);
        const Picture truth = study.sum(all.span(), shading);
        std::cout << "method,picks,seconds,relmse,relmse_4x4\n";
        for (const std::uint32_t picks : {16u, 64u, 256u, 1024u}) {
            const mir::VplList few = study.vpls(picks, 99);
            report("plain", picks, truth, [&] { return study.sum(few.span(), shading); });
            report("cuts", picks, truth, [&] { return study.cuts(tree, picks, shading); });
        }
    } catch (const std::exception& e) {
        std::cerr << "cut_study: " << e.what() << '\n';
        return 1;
    }
    return 0;
}
