// SPDX-License-Identifier: MIT
//
// Quoted by docs/extending.md: a sampler of a user's own.
#include "mir/concepts/sampler.hpp"

#include "conformance/brute_force.hpp"
#include "conformance/sampler_suite.hpp"
#include "conformance/worlds.hpp"
#include "mir/data/gbuffer.hpp"
#include "mir/sampling/emission.hpp"
#include "mir/sampling/light_path.hpp"
#include "mir/scene/builtin/cornell_box.hpp"
#include "support/catch.hpp"

// region: sampler
/// VPLs on the lamps and nowhere else: direct light of emissive triangles. Model of mir::Sampler.
class LampSampler {
 public:
    static constexpr mir::Normalisation normalisation = mir::Normalisation::none;

    LampSampler(const mir::LightTable& lights, float ray_offset, std::uint32_t vpls,
                std::uint64_t seed)
        : lights_(lights), ray_offset_(ray_offset), vpls_(vpls), seed_(seed) {}

    template <mir::Executor E>
    [[nodiscard]] mir::VplRecords sample(E& executor) const {
        mir::VplRecords out;
        out.paths = vpls_;
        out.emitted_power = static_cast<float>(lights_.power());
        if (lights_.empty()) return out;
        std::vector<mir::Emission> starts(vpls_);
        executor.for_each(starts.size(), [&](std::size_t i) {
            mir::PathNumbers numbers(mir::Sequence::random, seed_, mir::Stream::light_path, i);
            starts[i] = mir::sample_emission(lights_, ray_offset_, numbers);
        });
        for (const mir::Emission& e : starts) {
            if (!e.emitter) continue;  // a light without extent
            mir::Vpl vpl = mir::emitter_vpl(e);
            vpl.intensity = vpl.intensity * (1.0f / static_cast<float>(vpls_));
            out.records.push_back(
                {vpl,
                 {mir::VplKind::emitter, e.emitter->triangle, e.emitter->barycentrics},
                 1,
                 e.light_group});
        }
        return out;
    }

 private:
    const mir::LightTable& lights_;
    float ray_offset_;
    std::uint32_t vpls_;
    std::uint64_t seed_;
};
static_assert(mir::Sampler<LampSampler>);
// endregion: sampler

TEST_CASE("The sampler of the documentation keeps the axioms of Sampler") {
    const mirtest::World world(mir::builtin::cornell_box(mir::builtin::Lamp::down));
    const mir::LightTable lights(world.scene, world.geometry);
    // region: axioms
    const auto make = [&](std::uint64_t seed) {
        return LampSampler(lights, world.geometry.ray_offset(), 64, seed);
    };
    mirtest::sampler_suite(make);
    // endregion: axioms
    // The intensities times pi add up to the emitted power, whatever the points: each VPL of the
    // only lamp has the same.
    mir::InlineExecutor executor;
    const mir::VplRecords found = make(3).sample(executor);
    double power = 0.0;
    for (const mir::VplRecord& r : found.records)
        power += static_cast<double>(mir::pi * luminance(r.vpl.intensity));
    CHECK(power == mirtest::Approx(lights.power()).epsilon(1e-4));
}
