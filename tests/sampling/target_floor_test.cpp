// SPDX-License-Identifier: MIT
#include "mir/sampling/target_floor.hpp"

#include "mir/scenes.hpp"
#include "mir/shading/lambert.hpp"
#include "support/catch.hpp"
#include "support/sampler_light.hpp"

namespace {

using mir::Lambert;
using mir::TargetFloor;
using mirtest::PathLab;
using mirtest::probe_of;
using Generator = mir::VplGenerator<PathLab<Lambert>::World>;

Generator with_floor(const PathLab<Lambert>& lab, const Generator::Probe& probe, float share) {
    mir::InlineExecutor one;
    return mir::generator_with_floor<Generator>(lab.world(), probe, 3, 8, {share, 40'000}, 4, one);
}

}  // namespace

// H0: a floor of 1 doubles the target's integral. The pilot's own error is below 2 %, seed 4; the
// weights' numbers are of another stream. The test leaves it 3 of its standard errors.
TEST_CASE("the floor's share is that of the target's integral", "[statistical]") {
    const PathLab<Lambert> lab(mir::builtin::make("cornell-box"));
    const auto probe = probe_of(lab);
    const Generator with = with_floor(lab, probe, 1.0f);
    mirtest::Moments image;
    mirtest::Moments floor;
    mir::InlineExecutor one;
    mir::each_path(with, {5, mir::Stream::test, 0, 40'000}, one,
                   [&](std::uint64_t, const mir::WeightedPath& p) {
                       const double lit = p.weight > 0.0 ? 1.0 / p.density : 0.0;
                       image.add(lit * luminance(p.measure.contribution));
                       floor.add(lit * with.floor() * luminance(p.measure.leaving));
                   });
    CAPTURE(image.mean(), floor.mean());
    CHECK(floor.mean() == mirtest::Approx(image.mean()).epsilon(0.06));
    CHECK(with_floor(lab, probe, 0.25f).floor() ==
          mirtest::Approx(0.25 * with.floor()).epsilon(1e-6));
}

TEST_CASE("a probe that sees no light leaves a floor of its share alone") {
    mir::Scene scene = mir::builtin::make("cornell-box");
    scene.cameras = {mir::Camera::look_at({0, 1, 3.4f}, {0, 1, 9}, {0, 1, 0}, 0.6f)};
    const PathLab<Lambert> lab(scene);
    const auto probe = probe_of(lab);
    CHECK(with_floor(lab, probe, 0.25f).floor() == 0.25);
}

TEST_CASE("without lights no pilot is drawn") {
    mir::Scene scene = mir::builtin::make("cornell-box");
    for (mir::Material& m : scene.materials) m.emission = {};
    const PathLab<Lambert> lab(scene);
    const auto probe = probe_of(lab);
    CHECK(with_floor(lab, probe, 0.25f).floor() == 0.0);
}
