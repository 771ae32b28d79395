// SPDX-License-Identifier: MIT
#include "mir/validation/sampler.hpp"

#include "conformance/passes.hpp"
#include "mir/sampling/instant_radiosity_sampler.hpp"
#include "support/catch.hpp"
#include "validation/finds.hpp"

#include <limits>

namespace {

using mir::Lambert;
using mir::Normalisation;
using mir::VplRecord;
using mir::VplRecords;
using mir::validation::Bounces;
using mir::validation::BruteForceRayCaster;
using mir::validation::check_sampler;
using mir::validation::check_sampler_light;
using mir::validation::check_sampler_records;
using mir::validation::check_vpl_places;
using mir::validation::KnownLight;
using mir::validation::Report;
using mirtest::finds;
using mirtest::finds_only;
using Sampler = mir::InstantRadiositySampler<Lambert, BruteForceRayCaster>;

/// What is wrong with a sampler.
enum class Bug {
    none,
    twice_the_power,
    too_bright,
    turned_normals,
    long_normals,
    wrong_bounces,
    other_lamps,
    one_place,
    not_lifted,
    forgets_its_seed,
    makes_others_each_time,
    not_a_number,
    black,
    forgets_a_channel,
    negative_weight,
    strange_share
};

constexpr float nan = std::numeric_limits<float>::quiet_NaN();

/// What a bug makes of one record.
void spoil(VplRecord& r, Bug bug) {
    mir::Rgb& j = r.vpl.intensity;
    switch (bug) {
        case Bug::twice_the_power:
            j = j * 2.0f;
            break;
        case Bug::too_bright:
            j = j * 1.2f;
            break;
        case Bug::turned_normals:
            r.vpl.normal = -r.vpl.normal;
            break;
        case Bug::long_normals:
            r.vpl.normal = 1.001f * r.vpl.normal;
            break;
        case Bug::wrong_bounces:
            ++r.bounce;
            break;
        case Bug::one_place:  // on the wall that the camera does not see
            r.vpl.position = {-0.5f, -0.9f, 0.9999f};
            r.vpl.normal = {0, 0, -1};
            break;
        case Bug::not_lifted:
            r.vpl.position -= 3e-5f * r.vpl.normal;
            break;
        case Bug::forgets_a_channel:
            j.b = 0.0f;
            break;
        default:
            break;
    }
}

/// Instant radiosity and a bug.
struct Buggy {
    static constexpr Normalisation normalisation = Normalisation::none;

    Sampler right;
    Bug bug;
    std::uint16_t* calls;

    template <mir::Executor E>
    [[nodiscard]] VplRecords sample(E& executor) const {
        VplRecords out = right.sample(executor);
        for (VplRecord& r : out.records) spoil(r, bug);
        VplRecord& one = out.records[out.records.size() / 2];
        if (bug == Bug::other_lamps) out.emitted_power *= 1.001f;
        if (bug == Bug::makes_others_each_time) one.light_group = ++*calls;
        if (bug == Bug::not_a_number) one.vpl.intensity.g = nan;
        if (bug == Bug::black) one.vpl.intensity = {};
        if (bug == Bug::negative_weight) one.weight = -1.0f;
        if (bug == Bug::strange_share) out.non_lambertian_share = 1.5f;
        return out;
    }
};
static_assert(mir::Sampler<Buggy>);

/// Collects records in the order in which the executor makes them.
struct AsTheyCome {
    static constexpr Normalisation normalisation = Normalisation::none;

    std::uint64_t seed;

    template <mir::Executor E>
    [[nodiscard]] VplRecords sample(E& executor) const {
        VplRecords out;
        executor.for_each(4, [&](std::size_t i) {
            mir::Random random(seed, mir::Stream::test, i);
            out.records.push_back({{{random.next(), 0, 0}, {0, 0, 1}, {1, 1, 1}}, {}});
        });
        return out;
    }
};

/// A scene of known light and what a sampler reads of it.
struct Stage {
    const KnownLight& room;
    mir::LightTable lights{room.scene(), room.geometry()};
    mir::SurfaceTable<Lambert> surfaces{room.scene()};

    /// Calls a check with the maker of samplers.
    template <class Check>
    [[nodiscard]] Report with(Bug bug, Bounces bounces, const Check& check) const {
        std::uint16_t calls = 0;
        mir::InstantRadiosityOptions options;
        options.emitter_vpls = bounces.first == 1;
        options.max_bounce = bounces.last;
        return check([&](std::uint64_t seed) {
            options.seed = bug == Bug::forgets_its_seed ? 1 : seed;
            return Buggy{Sampler({room.geometry(), lights, surfaces, {&room.geometry()}}, options),
                         bug, &calls};
        });
    }
    [[nodiscard]] Report all(Bounces bounces) const {
        return with(Bug::none, bounces, [&](const auto& make) {
            mir::archetype::Executor backwards{mir::archetype::make};
            return check_sampler(make, room, bounces, backwards);
        });
    }
    [[nodiscard]] Report records(Bug bug) const {
        return with(bug, {}, [](const auto& make) { return check_sampler_records(make); });
    }
    [[nodiscard]] Report places(Bug bug) const {
        return with(bug, {}, [&](const auto& make) {
            return check_vpl_places(make(std::uint64_t{0}), room.geometry());
        });
    }
    [[nodiscard]] Report light(Bug bug, Bounces bounces = {}) const {
        return with(bug, bounces,
                    [&](const auto& make) { return check_sampler_light(make, room, bounces); });
    }
};

constexpr const char* off_surfaces = "VPLs lie on surfaces, on the side of their normal";

/// One bounce and all together are other than they should be.
bool misses_light(const Report& report) {
    return finds(report, "bounce 2 brings its light") &&
           finds(report, "all bounces bring their light");
}

}  // namespace

// H0, level and seeds: see check_sampler_light().
TEST_CASE("check_sampler passes instant radiosity in scenes of known light", "[statistical]") {
    const KnownLight furnace = mir::validation::known_furnace();
    mirtest::passes(Stage{furnace}.all({}));
    mirtest::passes(Stage{furnace}.light(Bug::none, {1, 5}));
    const KnownLight squares = mir::validation::known_squares();
    mirtest::passes(Stage{squares}.all({1, 3}));
}

TEST_CASE("check_sampler finds light that is too bright, lost or elsewhere", "[statistical]") {
    const KnownLight furnace = mir::validation::known_furnace();
    const Stage stage{furnace};
    for (const Bug bug : {Bug::twice_the_power, Bug::too_bright, Bug::forgets_a_channel,
                          Bug::turned_normals, Bug::one_place, Bug::not_a_number}) {
        const Report report = stage.light(bug);
        CAPTURE(int(bug), report.text());
        CHECK(misses_light(report));
    }
    const Report shifted = stage.light(Bug::wrong_bounces);
    CHECK(finds(shifted, "bounce 2 brings its light"));
    CHECK_FALSE(finds(shifted, "all bounces bring their light"));
    CHECK(finds_only(stage.light(Bug::other_lamps), "the emitted power is that of the lamps"));
    const KnownLight squares = mir::validation::known_squares();
    const Report bright = Stage{squares}.light(Bug::twice_the_power, {1, 3});
    CHECK(finds(bright, "bounce 1 brings its light"));
    CHECK_FALSE(finds(bright, "bounce 2 brings its light"));
}

TEST_CASE("check_sampler finds records that are not sound, not repeatable or off their surface") {
    const KnownLight furnace = mir::validation::known_furnace();
    const Stage stage{furnace};
    CHECK(finds(stage.records(Bug::not_a_number), "records send out finite light"));
    CHECK(finds_only(stage.records(Bug::black), "records send out finite light"));
    CHECK(finds_only(stage.records(Bug::long_normals), "records have a place and a unit normal"));
    CHECK(finds_only(stage.records(Bug::negative_weight),
                     "records have a bounce and a positive weight"));
    CHECK(finds_only(stage.records(Bug::strange_share), "the non-Lambertian share is 0 to 1"));
    CHECK(finds_only(stage.records(Bug::forgets_its_seed), "another seed makes other records"));
    CHECK(finds(stage.records(Bug::makes_others_each_time),
                "a sampler makes the same records each time"));
    CHECK(
        finds(stage.records(Bug::makes_others_each_time), "the same seed makes the same records"));
    CHECK(stage.places(Bug::none).passed());
    for (const Bug bug : {Bug::turned_normals, Bug::not_lifted, Bug::long_normals})
        CHECK(finds(stage.places(bug), off_surfaces) == (bug != Bug::long_normals));
}

TEST_CASE("check_sampler finds records that depend on the executor, and sets without any") {
    const KnownLight furnace = mir::validation::known_furnace();
    mir::archetype::Executor backwards{mir::archetype::make};
    const auto make = [](std::uint64_t seed) { return AsTheyCome{seed}; };
    CHECK(
        finds_only(check_sampler_records(make, backwards), "any executor makes the same records"));
    const auto nothing = [](std::uint64_t) {
        return mir::archetype::Sampler{mir::archetype::make};
    };
    CHECK(finds(check_sampler_records(nothing), "there are records"));
    CHECK(finds(check_sampler_light(nothing, furnace), "all bounces bring their light"));
}
