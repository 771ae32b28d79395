// SPDX-License-Identifier: MIT
#include "mir/concepts/ray_caster.hpp"

#include "conformance/brute_force.hpp"
#include "conformance/ray_caster_suite.hpp"
#include "mir/concepts/archetypes.hpp"
#include "support/catch.hpp"

namespace {

namespace archetype = mir::archetype;

static_assert(mir::RayCaster<archetype::RayCaster>);

struct WithoutClosestHit : archetype::RayCaster {
    void closest_hit();
};
static_assert(!mir::RayCaster<WithoutClosestHit>);

struct AlwaysHits : archetype::RayCaster {
    [[nodiscard]] mir::SurfacePoint closest_hit(mir::Ray) const { return {}; }
};
static_assert(!mir::RayCaster<AlwaysHits>);

struct ChangesItself : archetype::RayCaster {
    std::optional<mir::SurfacePoint> closest_hit(mir::Ray) { return std::nullopt; }
};
static_assert(!mir::RayCaster<ChangesItself>);

}  // namespace

TEST_CASE("Brute force keeps the axioms of RayCaster, which checks the suite") {
    mirtest::ray_caster_suite<mirtest::BruteForceScene>();
}
