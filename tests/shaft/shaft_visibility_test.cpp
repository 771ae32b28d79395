// SPDX-License-Identifier: MIT
#include "mir/shaft/host/shaft_visibility.hpp"

#include "conformance/block_suite.hpp"
#include "conformance/packet_suite.hpp"
#include "conformance/ray_caster_suite.hpp"
#include "conformance/visibility_suite.hpp"
#include "mir/host/shaft_scene.hpp"
#include "support/catch.hpp"

TEST_CASE("Visibility by shafts keeps the axioms of every face", "[slow]") {
    mirtest::visibility_suite<mir::ShaftScene>();
    mirtest::packet_suite<mir::ShaftScene>(300);
    mirtest::block_suite<mir::ShaftScene>();
}

TEST_CASE("The ray caster of a scene with shafts keeps the axioms") {
    mirtest::ray_caster_suite<mir::ShaftScene>();
}
