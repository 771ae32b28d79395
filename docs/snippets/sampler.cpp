// SPDX-License-Identifier: MIT
//
// Quoted by docs/extending.md: a sampler of a user's own.
#include "mir/validation/sampler.hpp"

#include "mir/runtime/vpl_frame.hpp"
#include "mir/sampling/emission.hpp"
#include "mir/sampling/light_path.hpp"
#include "mir/scenes.hpp"
#include "support/catch.hpp"

// region: sampler
/// VPLs on the lamps and nowhere else: direct light of emissive triangles. Model of mir::Sampler.
class LampSampler {
 public:
    static constexpr mir::Normalisation normalisation = mir::Normalisation::none;

    LampSampler(const mir::LightTable& lights, std::uint32_t vpls, std::uint64_t seed)
        : lights_(lights), vpls_(vpls), seed_(seed) {}

    template <mir::Executor E>
    [[nodiscard]] mir::VplRecords sample(E& executor) const {
        mir::VplRecords out;
        out.paths = vpls_;
        out.emitted_power = static_cast<float>(lights_.power());
        if (lights_.empty()) return out;
        std::vector<mir::Emission> starts(vpls_);
        executor.for_each(starts.size(), [&](std::size_t i) {
            mir::PathNumbers numbers(mir::Sequence::random, seed_, mir::Stream::light_path, i);
            starts[i] = mir::sample_emission(lights_, numbers);
        });
        for (const mir::Emission& e : starts) {
            if (!e.is_lamp) continue;  // a light without extent
            mir::Vpl vpl = mir::emitter_vpl(e);
            vpl.intensity = vpl.intensity * (1.0f / static_cast<float>(vpls_));
            out.records.push_back(
                {vpl,
                 {mir::VplKind::emitter, e.emitter.triangle, e.emitter.barycentrics},
                 1,
                 e.light_group});
        }
        return out;
    }

 private:
    const mir::LightTable& lights_;
    std::uint32_t vpls_;
    std::uint64_t seed_;
};
static_assert(mir::Sampler<LampSampler>);
// endregion: sampler

namespace {

// region: frame
mir::RenderResult draw(const mir::Scene& scene, const mir::RenderSettings& settings) {
    mir::VplFrame frame(scene, settings);
    const LampSampler sampler(frame.lights(), settings.vpls, settings.seed);
    return render_vpls(frame, {sampler.sample(frame.executor()), LampSampler::normalisation});
}
// endregion: frame

}  // namespace

// H0, level and seeds: see check_sampler_light().
TEST_CASE("The sampler of the documentation keeps the axioms of Sampler", "[statistical]") {
    // region: axioms
    const mir::validation::KnownLight room = mir::validation::known_squares();
    const mir::LightTable lights(room.scene(), room.geometry());
    const auto make = [&](std::uint64_t seed) { return LampSampler(lights, 256, seed); };
    mir::archetype::Executor backwards{mir::archetype::make};
    // Direct light is all that it brings: bounces 1 to 1.
    const auto report = mir::validation::check_sampler(make, room, {1, 1}, backwards);
    INFO(report.text());
    CHECK(report.passed());
    // endregion: axioms
}

TEST_CASE("The sampler of the documentation draws a picture") {
    const mir::RenderResult result =
        draw(mir::builtin::make("sphere"), {.image = {24, 18}, .vpls = 32});
    CHECK(result.vpls.size() == 32);
    CHECK(result.statistics.indirect_luminance > 0.0);
    CHECK(result.statistics.normalisation == "none");
}

TEST_CASE("The sampler of the documentation brings a furnace its direct light, and no more") {
    const mir::validation::KnownLight room = mir::validation::known_furnace();
    const mir::LightTable lights(room.scene(), room.geometry());
    const auto check = [&](std::uint8_t last) {
        return mir::validation::check_sampler_light(
            [&](std::uint64_t seed) { return LampSampler(lights, 512, seed); }, room, {1, last});
    };
    const auto direct = check(1);
    INFO(direct.text());
    CHECK(direct.passed());
    CHECK_FALSE(check(2).passed());
}
