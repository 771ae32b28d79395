// SPDX-License-Identifier: MIT
#include "mir/runtime/picture_bytes.hpp"

#include "mir/runtime/check_settings.hpp"
#include "support/catch.hpp"

namespace {

mir::RenderSettings of(std::uint32_t width, std::uint32_t height) {
    mir::RenderSettings s;
    s.image = {width, height};
    return s;
}

}  // namespace

TEST_CASE("a picture's memory is estimated by its pixels and layers") {
    mir::RenderSettings s = of(100, 10);
    CHECK(mir::picture_bytes(s, 4) == 1000 * (8 * 13 + 12 * 5 + 40 + 4));
    CHECK(mir::picture_bytes(s, 5) == 1000 * (8 * 16 + 12 * 6 + 40 + 4));
    s.luxels_per_pixel = 4;
    CHECK(mir::picture_bytes(s, 4) == 1000 * 208);
}

TEST_CASE(
    "a picture that memory has no room for is refused before it is taken, with both figures") {
    mir::RenderSettings s = of(65536, 4096);
    CHECK_THROWS_WITH(check(s), Catch::Contains("55.8 GB") && Catch::Contains("34.4 GB"));
    s.limits.picture_bytes = 56ull << 30;
    CHECK_NOTHROW(check(s));
}

TEST_CASE("layers count for a picture's memory") {
    mir::RenderSettings s = of(7680, 4320);
    CHECK_NOTHROW(mir::check_picture(s, 4));
    CHECK_THROWS_AS(mir::check_picture(s, 40), mir::Error);
}
