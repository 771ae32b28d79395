// SPDX-License-Identifier: MIT
#include "mir/shading/packet_of_light.hpp"

#include "conformance/worlds.hpp"
#include "mir/scene/shapes.hpp"
#include "mir/shading/cook_torrance.hpp"
#include "mir/shading/environment_light.hpp"
#include "mir/shading/scene_light.hpp"
#include "mir/validation/detail/shaded_places.hpp"
#include "support/catch.hpp"
#include "support/free_sight.hpp"
#include "support/instruction_sets.hpp"
#include "support/packet_points.hpp"
#include "support/same_records.hpp"
#include "support/test_sky.hpp"

#include <cmath>
#include <limits>
#include <vector>

// Light of packets against the same samples, shaded and asked about one after the other: the same
// operations in the same order, so the same bits.
namespace {

using mir::CookTorrance;
using mir::Hit;
using mir::LitPoint;
using mir::Rgb;
using mir::Scene;
using mir::Vec3;
using mirtest::bits_of;
using Surface = mir::Surface<CookTorrance::Params>;

/// Hides pairs whose middle lies to the left.
struct RightSight {
    static constexpr mir::Space space = mir::Space::host;
    [[nodiscard]] bool visible(Vec3 a, Vec3 b) const { return a.x + b.x >= 0.0f; }
};

/// The same, asked about packets.
struct RightPackets : RightSight {
    [[nodiscard]] std::uint32_t visible_packet(Vec3 origin, const mir::PointPacket& points,
                                               std::uint32_t active) const {
        std::uint32_t seen = 0;
        for (std::uint32_t k = 0; k < mir::PointPacket::width; ++k)
            if ((active >> k & 1u) != 0 && visible(origin, mirtest::point_of(points, k)))
                seen |= 1u << k;
        return seen;
    }
};
static_assert(mir::PacketVisibility<RightPackets> && !mir::PacketVisibility<RightSight>);

/// Sees nothing when it is asked about a luxel first.
struct LightFirst {
    static constexpr mir::Space space = mir::Space::host;
    Vec3 luxel;
    [[nodiscard]] bool visible(Vec3 a, Vec3 b) const { return a != luxel && b == luxel; }
};

struct Sample {
    Vec3 place;
    Rgb power;
    std::uint32_t is_on;
};

/// No light from some samples, and light that is no number from others, which are off.
Sample random_sample(mir::Random& random) {
    const bool is_on = random.next() < 0.8f;
    const float red = is_on ? random.next() : std::numeric_limits<float>::quiet_NaN();
    return {mirtest::point_in_cube(random),
            {red, random.next() < 0.2f ? 0.0f : 1.0f, 0.0f},
            is_on ? 1u : 0u};
}

LitPoint shaded(const Sample& s) {
    const float d2 = mir::length_squared(s.place);
    return {s.place * 1.5f, mir::kept_if(s.is_on != 0, s.power * (1.0f / (d2 + std::sqrt(d2))))};
}

Rgb one_by_one(const std::vector<Sample>& samples, Vec3 origin) {
    Rgb sum;
    for (const Sample& s : samples) {
        const LitPoint p = shaded(s);
        if (!mir::is_black(p.light) && RightSight{}.visible(origin, p.place)) sum += p.light;
    }
    return sum;
}

/// Lamps of one side and of both, and a sky.
Scene lit_scene() {
    Scene s;
    mir::Material both = mir::emitter("both", {}, {3, 2, 1});
    both.emits_from_both_sides = true;
    s.place(mir::builtin::quad("both", s.add(both), {-1, 1, -1}, {2, 0, 0}, {0, 0.5f, 2}));
    s.place(mir::builtin::quad("one", s.add(mir::emitter("one", {}, {1, 5, 2})), {-1, -1, 0},
                               {0, 2, 0}, {2, 0, 0.1f}));
    s.environment = mirtest::test_sky();
    return s;
}

struct Luxel {
    Hit hit;
    Surface surface;
};

/// Anywhere among the lamps.
Luxel random_luxel(mir::Random& random) {
    const auto place = mir::validation::detail::random_shaded_place(random);
    const auto colour = [&] { return Rgb{random.next(), random.next(), random.next()}; };
    return {{mirtest::point_in_cube(random), mirtest::direction(random)},
            {place.normal, place.wo, {}, {colour(), colour(), 1.0f, 0.1f + 0.9f * random.next()}}};
}

}  // namespace

TEST_CASE("A packet of light brings what its samples bring, with every instruction set") {
    mir::Random random = mirtest::test_random(141);
    for (const mir::InstructionSet set : mirtest::instruction_sets()) {
        INFO("instruction set " << static_cast<int>(set));
        for (int round = 0; round < 500; ++round) {
            const Vec3 origin = mirtest::point_in_cube(random);
            mir::PacketOfLight<Sample> packet;
            // Samples of the longer list, which the shorter one must not count.
            for (const std::uint32_t count : {16u, 1u + static_cast<std::uint32_t>(round) % 15u}) {
                std::vector<Sample> samples;
                for (std::uint32_t k = 0; k < count; ++k) {
                    samples.push_back(random_sample(random));
                    packet.set(k, samples.back());
                }
                const Rgb made = packet.seen_from(
                    origin, RightPackets{}, count, [](const Sample& s) { return shaded(s); }, set);
                REQUIRE(bits_of(made) == bits_of(one_by_one(samples, origin)));
            }
        }
    }
}

TEST_CASE("Lamps and sky light a luxel by packets as by samples asked one by one") {
    const Scene scene = lit_scene();
    const mir::WorldGeometry geometry(scene);
    const mir::LightTable lights(scene, geometry);
    mir::Random random = mirtest::test_random(142);
    int lit = 0;
    for (const std::uint32_t samples : {1u, 15u, 16u, 17u, 40u}) {
        INFO(samples << " samples");
        const mir::EmitterLight<CookTorrance, RightSight> lamp{lights, {}, samples};
        const mir::EmitterLight<CookTorrance, RightPackets> lamp_packets{lights, {}, samples};
        const mir::EnvironmentLight<CookTorrance, RightSight> sky{lights, {}, samples};
        const mir::EnvironmentLight<CookTorrance, RightPackets> sky_packets{lights, {}, samples};
        for (std::uint64_t i = 0; i < 400; ++i) {
            const Luxel at = random_luxel(random);
            const mir::Random numbers(7, mir::Stream::test, i);
            const mir::SharedSamples shared{4, static_cast<std::uint32_t>(i) % 4};
            const Rgb by_lamp = lamp(at.hit, at.surface, shared, numbers);
            const Rgb by_sky = sky(at.hit, at.surface, shared, numbers);
            lit += mir::is_black(by_lamp) ? 0 : 1;
            REQUIRE(bits_of(lamp_packets(at.hit, at.surface, shared, numbers)) == bits_of(by_lamp));
            REQUIRE(bits_of(sky_packets(at.hit, at.surface, shared, numbers)) == bits_of(by_sky));
        }
    }
    CHECK(lit > 500);
}

TEST_CASE("Single shadow rays of lamps and sky start at the light") {
    const Scene scene = lit_scene();
    const mir::WorldGeometry geometry(scene);
    const mir::LightTable lights(scene, geometry);
    mir::Random random = mirtest::test_random(143);
    for (std::uint64_t i = 0; i < 100; ++i) {
        const Luxel at = random_luxel(random);
        const mir::Random numbers(7, mir::Stream::test, i);
        const auto lamp = [&](auto sight) {
            return mir::EmitterLight<CookTorrance, decltype(sight)>(lights, sight, 16)(
                at.hit, at.surface, {}, numbers);
        };
        const auto sky = [&](auto sight) {
            return mir::EnvironmentLight<CookTorrance, decltype(sight)>(lights, sight, 16)(
                at.hit, at.surface, {}, numbers);
        };
        const LightFirst light_first{at.hit.position};
        REQUIRE(bits_of(lamp(light_first)) == bits_of(lamp(mirtest::FreeSight{})));
        REQUIRE(bits_of(sky(light_first)) == bits_of(sky(mirtest::FreeSight{})));
    }
}
