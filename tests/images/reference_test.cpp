// SPDX-License-Identifier: MIT
//
// A render against the published picture of a scene that others rendered.
#include "mir/io/exr.hpp"
#include "mir/io/gltf_reader.hpp"
#include "support.hpp"
#include "support/catch.hpp"
#include "support/shared_scenes.hpp"

using namespace mirtest;

TEST_CASE("the Cornell box has the mean radiance of its reference picture", "[statistical]") {
    // H0: equal means per channel. The reference is itself a Monte Carlo picture, good to about
    // 0.1 %; IR with roulette and no bound is averaged over 16 seeds. Criterion: within 1 %, and
    // the standard error must be small enough for that to mean something.
    const auto scenes = shared_scenes();
    if (!scenes) {
        WARN("skipped: the shared scenes are not on this machine");
        return;
    }
    const mir::Scene scene = mir::read_gltf(*scenes / "cornell-box/cornell-box.glb").scene;
    const Mean reference = mean_of(mir::read_exr(*scenes / "cornell-box/reference.exr").image);
    std::vector<double> r;
    std::vector<double> g;
    std::vector<double> b;
    for (std::uint64_t seed = 0; seed < 16; ++seed) {
        auto settings = small_settings(64, 4096);
        settings.sampler = mir::SamplerKind::instant_radiosity;
        settings.luxels_per_pixel = 2;
        settings.seed = seed;
        const Mean m = mean_of(render(scene, settings).beauty);
        r.push_back(m.r);
        g.push_back(m.g);
        b.push_back(m.b);
    }
    CHECK(reference.r == mirtest::Approx(0.19625).epsilon(1e-3));
    for (const auto& [mine, theirs] : {std::pair{estimate(r), reference.r},
                                       {estimate(g), reference.g},
                                       {estimate(b), reference.b}}) {
        CAPTURE(mine.mean, mine.error, theirs);
        CHECK(mine.error < 0.004 * theirs);
        CHECK(std::abs(mine.mean - theirs) < 0.01 * theirs);
    }
}
