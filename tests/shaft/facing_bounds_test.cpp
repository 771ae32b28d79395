// SPDX-License-Identifier: MIT
#include "mir/shaft/device/facing_bounds.hpp"

#include "conformance/worlds.hpp"
#include "mir/core/random.hpp"
#include "mir/shading/contribution.hpp"
#include "support/catch.hpp"
#include "support/soa_run.hpp"

#include <limits>
#include <vector>

using namespace mirtest;
using mir::Facing;
using mir::Hit;
using mir::LaneGroup;
using mir::Vec3;
using mir::Vpl;

namespace {

using Luxels = std::vector<Hit>;

mir::FacingBounds bounds_of(const Luxels& luxels) {
    const HitRun run(luxels);
    return mir::facing_bounds(LaneGroup{}, run.view(), 0,
                              static_cast<std::uint32_t>(luxels.size()));
}

/// How luxels lie.
struct Cluster {
    float scale;                              ///< of coordinates, metres
    float size;                               ///< of the cluster, of the scale
    float bend;                               ///< how far normals differ
    std::uint32_t luxels = LaneGroup::width;  ///< a multiple of that
};

Luxels draw(const Cluster& c, mir::Random& random) {
    const Vec3 centre = c.scale * direction(random);
    const Vec3 normal = direction(random);
    Luxels luxels(c.luxels);
    for (Hit& luxel : luxels) {
        const Vec3 off = direction(random);
        const Vec3 flat = off - glm::dot(off, normal) * normal;
        luxel = {centre + c.scale * c.size * (flat + c.bend * off),
                 glm::normalize(normal + c.bend * direction(random))};
        if (random.next() < 0.1f) luxel = {};
    }
    return luxels;
}

/// Anywhere, or in the plane of a luxel, or with a luxel in its own, but for rounding, or on a wall
/// with one.
Vpl draw_vpl(const Luxels& luxels, float scale, mir::Random& random) {
    const Vec3 anywhere = 2.0f * scale * direction(random);
    const auto any = static_cast<float>(luxels.size()) - 0.1f;
    const Hit& hit = luxels[static_cast<std::uint32_t>(any * random.next())];
    Vpl vpl{anywhere, direction(random), {}};
    if (random.next() < 0.4f)
        vpl.position = anywhere - glm::dot(anywhere - hit.position, hit.normal) * hit.normal;
    const Vec3 to = vpl.position - hit.position;
    if (random.next() < 0.4f && glm::length(to) > 0.0f)
        vpl.normal = glm::normalize(glm::cross(to, direction(random)));
    if (random.next() < 0.2f) vpl.normal = hit.normal;
    return vpl;
}

struct Tally {
    std::uint32_t wrong = 0;
    std::uint32_t sure = 0;

    void count(const Luxels& luxels, const Vpl& vpl) {
        const Facing facing = facing_of(bounds_of(luxels), vpl);
        if (facing == Facing::some) return;
        ++sure;
        for (const Hit& luxel : luxels) {
            if (is_empty(luxel)) continue;
            wrong += mir::faces(luxel, vpl) == (facing == Facing::all) ? 0 : 1;
        }
    }
};

}  // namespace

TEST_CASE("What faces all luxels of a cluster or none faces each of them or not", "[slow]") {
    const Cluster cluster = {GENERATE(1e-6f, 1.0f, 1e6f), GENERATE(0.0f, 1e-5f, 0.1f),
                             GENERATE(0.0f, 1e-6f, 0.3f), GENERATE(32u, 256u)};
    mir::Random random = test_random(2301);
    Tally tally;
    for (int i = 0; i < 400; ++i) {
        const Luxels luxels = draw(cluster, random);
        for (int j = 0; j < 16; ++j) tally.count(luxels, draw_vpl(luxels, cluster.scale, random));
    }
    CHECK(tally.wrong == 0);
    if (cluster.size < 1e-3f && cluster.bend < 1e-3f) CHECK(tally.sure > 400 * 16 / 3);
}

TEST_CASE("Nothing is sure of luxels and VPLs that are no number or overflow") {
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    mir::Random random = test_random(2302);
    const Luxels usual = draw({1.0f, 0.01f, 0.0f}, random);
    for (const float odd : {nan, 1e30f, std::numeric_limits<float>::infinity()}) {
        Luxels luxels = usual;
        luxels[5] = {Vec3(odd, 0, 0), Vec3(0, 0, 1)};
        const Vpl vpl{Vec3(0, 0, 5), Vec3(0, 0, -1), {}};
        CHECK(facing_of(bounds_of(luxels), vpl) == Facing::some);
        const auto bounds = bounds_of(usual);
        CHECK(facing_of(bounds, Vpl{Vec3(odd, 0, 0), Vec3(0, 0, 1), {}}) == Facing::some);
        CHECK(facing_of(bounds, Vpl{Vec3(0, 0, 1), Vec3(0, odd, 1), {}}) == Facing::some);
    }
    const Luxels none(LaneGroup::width);
    CHECK(facing_of(bounds_of(none), Vpl{}) == Facing::none);
}

TEST_CASE("Luxels and a VPL on one wall do not face each other, however its plane is rounded") {
    mir::Random random = test_random(2303);
    std::uint32_t near_plane = 0;
    for (int i = 0; i < 200; ++i) {
        const Luxels luxels = draw({1.0f, 0.1f, 0.0f, 256}, random);
        const Hit& own = luxels[static_cast<std::uint32_t>(255.9f * random.next())];
        if (is_empty(own)) continue;
        const Vec3 to = direction(random);
        const Vpl vpl{own.position + to - glm::dot(to, own.normal) * own.normal, own.normal, {}};
        CHECK(facing_of(bounds_of(luxels), vpl) == Facing::none);
        const Vpl turned{vpl.position, -vpl.normal, {}};
        near_plane += facing_of(bounds_of(luxels), turned) == Facing::some ? 1 : 0;
    }
    CHECK(near_plane > 150);
}

TEST_CASE("A VPL's normal amid those of luxels is not taken for theirs") {
    Luxels luxels(LaneGroup::width);
    for (std::size_t k = 0; k < luxels.size(); ++k)
        luxels[k] = {Vec3(0.0f), Vec3(k % 2 == 0 ? 0.6f : -0.6f, 0.0f, 0.8f)};
    const Vpl vpl{Vec3(1.0f, 0.0f, -0.5f), Vec3(0.0f, 0.0f, 0.8f), {}};
    REQUIRE(bounds_of(luxels).normal == vpl.normal);
    REQUIRE(mir::faces(luxels[0], vpl));
    CHECK(facing_of(bounds_of(luxels), vpl) == Facing::some);
}
