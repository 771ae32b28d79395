// SPDX-License-Identifier: MIT
#include "mir/runtime/light_budget.hpp"

#include "support/catch.hpp"

#include <string>
#include <vector>

using mir::Integrator;
using mir::LightClass;
using mir::RenderResult;
using mir::RenderSettings;

namespace {

/// Layers of 2 x 1 pixels with these means.
RenderResult picture(float emission, float direct, float indirect) {
    const auto layer = [](float mean) {
        mir::Image<mir::Rgb> image({2, 1});
        image(0, 0) = {2.0f * mean, 2.0f * mean, 2.0f * mean};
        return image;
    };
    RenderResult r{{}, {}, {}, {}, {}, mir::Guides({2, 1}), {}, {}, {}};
    r.emission = layer(emission);
    r.direct = layer(direct);
    r.indirect = layer(indirect);
    return r;
}

double sum_of(const std::vector<LightClass>& classes) {
    double sum = 0.0;
    for (const LightClass& c : classes) sum += c.share;
    return sum;
}

}  // namespace

TEST_CASE("shares of light are those of the layers' means") {
    const auto classes = light_budget(picture(1.0f, 2.0f, 5.0f), RenderSettings{});
    REQUIRE(classes.size() == 3);
    CHECK(classes[0].share == Approx(1.0 / 8.0));
    CHECK(classes[1].share == Approx(2.0 / 8.0));
    CHECK(classes[2].share == Approx(5.0 / 8.0));
    CHECK(classes[2].brought_by == "VPLs");
    CHECK(!classes[2].standard_error);
    CHECK(classes[2].missing.empty());
}

TEST_CASE("what paths brought is taken out of the layer that holds it") {
    RenderResult r = picture(0.0f, 2.0f, 6.0f);
    r.statistics.caustic_paths = 1;
    r.statistics.caustic_luminance = 1.5;
    r.statistics.caustic_direct_luminance = 1.0;
    r.statistics.residual_paths = 1;
    r.statistics.residual_luminance = 0.5;
    const auto classes = light_budget(r, RenderSettings{});
    REQUIRE(classes.size() == 5);
    CHECK(classes[1].share == Approx(1.0 / 8.0));
    CHECK(classes[2].share == Approx(5.0 / 8.0));
    CHECK(classes[3].share == Approx(0.5 / 8.0));
    CHECK(classes[4].share == Approx(1.5 / 8.0));
    CHECK(sum_of(classes) == Approx(1.0));
}

TEST_CASE("no share of light is negative, and all add up to one") {
    // Sums over luxels, whose filter makes less of them than the images hold.
    RenderResult r = picture(0.0f, 1.0f, 1.0f);
    r.statistics.caustic_paths = r.statistics.residual_paths = 1;
    r.statistics.caustic_luminance = 2.02;
    r.statistics.caustic_direct_luminance = 1.01;
    r.statistics.residual_luminance = 0.3;
    const auto classes = light_budget(r, RenderSettings{});
    for (const LightClass& c : classes) CHECK(c.share >= 0.0);
    CHECK(sum_of(classes) == Approx(1.0));
    CHECK(sum_of(light_budget(picture(0.0f, 0.0f, 0.0f), RenderSettings{})) == 0.0);
}

TEST_CASE("the light of VPLs has the error of its sampler, and what it lacks") {
    RenderResult r = picture(0.0f, 1.0f, 3.0f);
    r.statistics.light_path_luminance = mir::PathLuminance{2.0, 0.1, 1000, 500};
    r.statistics.removed = mir::ShareEstimate{0.02, 0.001};
    r.statistics.cut = mir::ShareEstimate{0.003, 0.0001};
    RenderSettings s;
    LightClass vpls = light_budget(r, s).at(2);
    REQUIRE(vpls.standard_error);
    CHECK(*vpls.standard_error == Approx(0.05 * 0.75));
    REQUIRE(vpls.missing.size() == 2);
    CHECK(vpls.missing[0].share.share == 0.02);
    CHECK(vpls.missing[1].share.share == 0.003);

    s.compensate = 1;  // what the bound took is not missing then
    vpls = light_budget(r, s).at(2);
    REQUIRE(vpls.missing.size() == 1);
    CHECK(vpls.missing[0].share.share == 0.003);
}

TEST_CASE("classes that tell their error have it as a share of the picture") {
    RenderResult r = picture(0.0f, 1.0f, 3.0f);
    r.statistics.direct_error = 0.02;
    r.statistics.residual_error = 0.04;
    r.statistics.caustic_error = 0.08;
    r.statistics.residual_paths = r.statistics.caustic_paths = 1;
    const auto classes = light_budget(r, RenderSettings{});
    REQUIRE(classes.size() == 5);
    CHECK(classes[1].standard_error.value() == Approx(0.005));
    CHECK(classes[3].standard_error.value() == Approx(0.01));
    CHECK(classes[4].standard_error.value() == Approx(0.02));
    for (const LightClass& c : light_budget(picture(0.0f, 1.0f, 3.0f), RenderSettings{}))
        CHECK_FALSE(c.standard_error);
}

TEST_CASE("each integrator is named for what it brings") {
    RenderSettings s;
    const auto bringer = [&] { return light_budget(picture(1, 1, 1), s).at(2).brought_by; };
    s.vpls = 100000;
    s.picks = 64;
    CHECK(bringer() == "VPLs, 64 picked by each luxel");
    s.integrator = Integrator::path;
    CHECK(bringer() == "camera paths");
    s.integrator = Integrator::micro;
    CHECK(bringer() == "discs");
    s.integrator = Integrator::vpl;
    s.direct = mir::DirectLight::vpl;
    CHECK(light_budget(picture(1, 1, 1), s).at(2).light == "scattered once or more often");
    CHECK(light_budget(picture(1, 1, 1), s).at(1).brought_by == "lights without extent");
}
