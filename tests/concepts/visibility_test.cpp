// SPDX-License-Identifier: MIT
#include "mir/concepts/visibility.hpp"

#include "conformance/brute_force.hpp"
#include "conformance/packet_suite.hpp"
#include "conformance/visibility_suite.hpp"
#include "mir/concepts/archetypes.hpp"
#include "support/catch.hpp"

namespace {

namespace archetype = mir::archetype;

static_assert(mir::Visibility<archetype::Visibility>);
static_assert(mir::Visibility<archetype::DeviceVisibility>);
static_assert(!mir::PacketVisibility<archetype::Visibility>);
static_assert(mir::PacketVisibility<archetype::PacketVisibility>);
static_assert(!mir::BlockVisibility<archetype::PacketVisibility>);
static_assert(mir::BlockVisibility<archetype::BlockVisibility>);
static_assert(mir::AccessibleFrom<archetype::Visibility, mir::Space::host>);
static_assert(!mir::AccessibleFrom<archetype::DeviceVisibility, mir::Space::host>);

struct WithoutVisible : archetype::PacketVisibility {
    void visible();
};
static_assert(!mir::Visibility<WithoutVisible> && !mir::PacketVisibility<WithoutVisible>);

struct ReturnsInt : archetype::Visibility {
    [[nodiscard]] int visible(mir::Vec3, mir::Vec3) const { return 1; }
};
static_assert(!mir::Visibility<ReturnsInt>);

struct ChangesItself : archetype::Visibility {
    bool visible(mir::Vec3, mir::Vec3) { return true; }
};
static_assert(!mir::Visibility<ChangesItself>);

struct WithoutSpace : archetype::Value {
    [[nodiscard]] bool visible(mir::Vec3, mir::Vec3) const { return true; }
};
static_assert(!mir::Visibility<WithoutSpace>);

struct OwnsMemory : archetype::Visibility {
    std::vector<int> memory;
};
static_assert(!mir::Visibility<OwnsMemory>);

struct PacketOfBools : archetype::Visibility {
    [[nodiscard]] bool visible_packet(mir::Vec3, const mir::PointPacket&, std::uint32_t) const {
        return true;
    }
};
static_assert(mir::Visibility<PacketOfBools> && !mir::PacketVisibility<PacketOfBools>);

}  // namespace

TEST_CASE("Brute force keeps the axioms of Visibility, which checks the suite", "[slow]") {
    mirtest::visibility_suite<mirtest::BruteForceScene>();
}

TEST_CASE("Brute force keeps the axiom of PacketVisibility, which checks the suite", "[slow]") {
    mirtest::packet_suite<mirtest::BruteForceScene>(200);
}
