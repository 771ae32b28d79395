// SPDX-License-Identifier: MIT
#include "mir/shading/contribution.hpp"

#include "mir/shading/lambert.hpp"
#include "mir/shading/vpl_shading.hpp"
#include "support/catch.hpp"

namespace {

using mir::Hit;
using mir::Lambert;
using mir::Rgb;
using mir::Vec3;
using mir::Vpl;

const Vec3 up(0, 0, 1);
const Hit ground{{0, 0, 0}, up};
const mir::Surface<Lambert::Params> white{up, up, {}, {{1, 1, 1}}};
const Vpl lamp{{0.5f, 0, 2}, {0, 0, -1}, {3, 3, 3}};

/// Counts its questions and remembers the last pair.
struct Witness {
    static constexpr mir::Space space = mir::Space::host;
    struct Log {
        int asked = 0;
        Vec3 from{0};
        Vec3 to{0};
    };
    Log* log;
    bool answer;
    bool visible(Vec3 a, Vec3 b) const {
        ++log->asked;
        log->from = a;
        log->to = b;
        return answer;
    }
};
static_assert(mir::Visibility<Witness>);

}  // namespace

TEST_CASE("luxel and VPL face each other only above both tangent planes") {
    CHECK(mir::faces(ground, lamp));
    CHECK_FALSE(mir::faces(ground, {{0, 0, -1}, up, {}}));
    CHECK_FALSE(mir::faces(ground, {{0, 0, 1}, up, {}}));
    CHECK_FALSE(mir::faces(ground, {{1, 0, 0}, {-1, 0, 0}, {}}));  // in the luxel's plane
    CHECK_FALSE(mir::faces(ground, {{0, 0, 1}, {1, 0, 0}, {}}));   // luxel in the VPL's plane
}

TEST_CASE("a seen VPL contributes its shading, a hidden one nothing") {
    Witness::Log log;
    const mir::VplShading<Lambert> shade;
    const Rgb seen = mir::contribution(ground, white, lamp, Witness{&log, true}, shade);
    CHECK(seen == shade(ground, white, lamp));
    CHECK_FALSE(is_black(seen));
    CHECK(is_black(mir::contribution(ground, white, lamp, Witness{&log, false}, shade)));
    CHECK(log.asked == 2);
}

TEST_CASE("visibility is asked from the VPL to the luxel") {
    Witness::Log log;
    mir::contribution(ground, white, lamp, Witness{&log, true}, mir::VplShading<Lambert>{});
    CHECK(log.from == lamp.position);
    CHECK(log.to == ground.position);
}

TEST_CASE("no ray is spent on pairs that cannot see each other or reflect nothing") {
    Witness::Log log;
    const mir::VplShading<Lambert> shade;
    const Vpl behind{{0, 0, -1}, up, {1, 1, 1}};
    mir::contribution(ground, white, behind, Witness{&log, true}, shade);
    const mir::Surface<Lambert::Params> black{up, up, {}, {{0, 0, 0}}};
    mir::contribution(ground, black, lamp, Witness{&log, true}, shade);
    const Vpl dark{lamp.position, lamp.normal, {0, 0, 0}};
    mir::contribution(ground, white, dark, Witness{&log, true}, shade);
    CHECK(log.asked == 0);
}

TEST_CASE("an empty luxel receives nothing") {
    Witness::Log log;
    const Rgb l =
        mir::contribution(Hit{}, white, lamp, Witness{&log, true}, mir::VplShading<Lambert>{});
    CHECK(is_black(l));
    CHECK(log.asked == 0);
}

TEST_CASE("the geometric side decides even when the shading normal disagrees") {
    Witness::Log log;
    const Vpl below{{1, 0, -0.2f}, glm::normalize(Vec3(-1, 0, 0.2f)), {1, 1, 1}};
    const mir::Surface<Lambert::Params> tilted{glm::normalize(Vec3(1, 0, 1)), up, {}, {{1, 1, 1}}};
    CHECK_FALSE(is_black(mir::VplShading<Lambert>{}(ground, tilted, below)));
    CHECK(is_black(
        mir::contribution(ground, tilted, below, Witness{&log, true}, mir::VplShading<Lambert>{})));
}
