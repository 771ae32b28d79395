// SPDX-License-Identifier: MIT
#include "mir/normalise/response.hpp"

#include "mir/concepts/archetypes.hpp"
#include "mir/reconstruct.hpp"
#include "mir/sched/cpu.hpp"
#include "mir/shading/vpl_shading.hpp"
#include "normalise/lit_box.hpp"
#include "support/analytic_sphere.hpp"
#include "support/catch.hpp"
#include "support/free_sight.hpp"
#include "support/instruction_sets.hpp"
#include "support/quadrature.hpp"

namespace {

using mir::ImageResponse;
using mir::ResponseSum;
using mir::Rgb;
using mir::Vec3;
using mirtest::Approx;
using Matte = mir::VplShading<mir::Lambert>;
using GBuffer = mir::BlockedGBuffer<mir::Lambert::Params>;

const mirtest::AnalyticSphere sphere{2.0f, 0, 0};

/// `count` points of the inside of the sphere as luxels of 40 x 24; the rest sees nothing.
GBuffer sphere_luxels(std::uint32_t count, Rgb reflectance) {
    GBuffer g({40, 24}, {16, 16});
    mir::Random random = mirtest::test_random(81);
    for (mir::TileIndex t = 0; t < g.tiles().size(); ++t) {
        const mir::Tile tile = g.tiles()[t];
        for (std::uint32_t y = 0; y < tile.height; ++y)
            for (std::uint32_t x = 0; x < tile.width; ++x) {
                const auto p = sphere.point(mir::square_to_sphere(random.next_2d()));
                if ((tile.y + y) * 40 + tile.x + x >= count) continue;
                const Vec3 n = p.geometric_normal;
                g.store(t, mir::BlockedLayout::of(tile)(x, y), {p.position, n},
                        {n, n, {}, {reflectance}});
            }
    }
    return g;
}

/// VPLs on the sphere, with intensities that must not matter.
std::vector<mir::Vpl> sphere_vpls() {
    std::vector<mir::Vpl> vpls;
    for (int i = 0; i < 40; ++i) {
        const mir::Vec2 u((static_cast<float>(i) + 0.5f) / 40.0f,
                          0.137f * static_cast<float>(i % 7));
        const auto p = sphere.point(mir::square_to_sphere(u));
        vpls.push_back({p.position, p.geometric_normal, {0, 7, static_cast<float>(i)}});
    }
    return vpls;
}

std::vector<ImageResponse> sphere_response(const GBuffer& g, const std::vector<mir::Vpl>& vpls) {
    mir::InlineExecutor executor;
    mir::VisibilityMatrix matrix(g.tiles(), static_cast<std::uint32_t>(vpls.size()));
    fill_visibility(matrix, g, mir::span_of(vpls), mirtest::FreeSight{}, executor);
    return response(g, mir::span_of(vpls), matrix, Matte{}, executor);
}

bool same_bits(const std::vector<ImageResponse>& a, const std::vector<ImageResponse>& b) {
    bool same = a.size() == b.size();
    for (std::size_t j = 0; same && j < a.size(); ++j)
        same = a[j].r == b[j].r && a[j].g == b[j].g && a[j].b == b[j].b &&
               a[j].lit_luxels == b[j].lit_luxels;
    return same;
}

using Box = mirtest::LitBox<mir::CookTorrance>;
const mir::VplShading<mir::CookTorrance> glossy{3.0f};

/// Responses of the box in bands of `rows` luxels and tiles of `tile`.
template <class E>
std::vector<ImageResponse> banded(const Box& box, mir::Extent image, mir::Extent tile,
                                  std::uint32_t rows, E& executor) {
    ResponseSum sum(image, box.vpls.size());
    for (std::uint32_t row = 0; row < image.height; row += rows) {
        const auto g = box.luxels(image, tile, row, std::min(rows, image.height - row));
        const auto matrix = box.visibility(g, box.engine.visibility());
        sum.add_band(g, box.vpls.span(), matrix.view(), glossy, executor);
    }
    return sum.mean();
}

}  // namespace

TEST_CASE("Inside a sphere every VPL's response is rho / (4 pi R^2) in each channel") {
    const auto vpls = sphere_vpls();
    const double all = 1.0 / (4 * mirtest::pi * 2.0 * 2.0);
    for (const ImageResponse& t : sphere_response(sphere_luxels(40 * 24, {0.6f, 0.3f, 1}), vpls)) {
        CHECK(t.r == Approx(0.6 * all).epsilon(1e-5));
        CHECK(t.g == Approx(0.3 * all).epsilon(1e-5));
        CHECK(t.b == Approx(all).epsilon(1e-5));
        CHECK(t.lit_luxels == 40 * 24);
    }
}

TEST_CASE("Luxels that see nothing count in the mean") {
    const auto vpls = sphere_vpls();
    const double all = 1.0 / (4 * mirtest::pi * 2.0 * 2.0);
    for (const ImageResponse& t : sphere_response(sphere_luxels(240, {1, 1, 1}), vpls)) {
        CHECK(t.g == Approx(0.25 * all).epsilon(1e-5));
        CHECK(t.lit_luxels == 240);
    }
}

TEST_CASE("Black luxels and empty images respond to nothing, without being lit") {
    for (std::uint32_t count : {0u, 40u * 24u})
        for (const ImageResponse& t : sphere_response(sphere_luxels(count, {}), sphere_vpls())) {
            CHECK(t.r == 0.0);
            CHECK(t.lit_luxels == 0);
        }
}

TEST_CASE("A response is the mean of the image of a VPL of unit intensity") {
    const Box box({50, 40});
    mir::InlineExecutor executor;
    const auto responses = response(box.gbuffer, box.vpls.span(), box.matrix, glossy, executor);
    for (mir::VplIndex j = 0; j < box.vpls.size(); ++j) {
        mir::Vpl unit = box.vpls.vpls()[j];
        unit.intensity = {1, 1, 1};
        const auto image = reconstruct(mir::sched::Cpu{executor}, box.gbuffer, mir::span_of({unit}),
                                       box.engine.visibility(), glossy);
        double red = 0.0;
        for (const Rgb& c : image.pixels()) red += static_cast<double>(c.r) / (50 * 40);
        CHECK(responses[j].r == Approx(red).epsilon(1e-6));
    }
}

TEST_CASE("Responses have the same bits for any bands, tiles, executors and instructions") {
    const mir::Extent image{90, 70};
    const Box box(image, {16, 16}, 40);
    mir::InlineExecutor one;
    const auto wanted = banded(box, image, {256, 256}, 70, one);
    mir::archetype::Executor backwards{mir::archetype::make};
    CHECK(same_bits(banded(box, image, {16, 16}, 70, one), wanted));
    CHECK(same_bits(banded(box, image, {48, 32}, 70, backwards), wanted));
    CHECK(same_bits(banded(box, image, {32, 16}, 16, backwards), wanted));
    CHECK(same_bits(banded(box, image, {64, 64}, 48, one), wanted));
    for (const mir::InstructionSet set : mirtest::instruction_sets()) {
        ResponseSum sum(image, box.vpls.size());
        sum.add_band(box.gbuffer, box.vpls.span(), box.matrix.view(), glossy, one, set);
        CHECK(same_bits(sum.mean(), wanted));
    }
}

TEST_CASE("A sum in another order is rejected") {
    // The same luxels, mirrored: their mean is the same number in other bits.
    const mir::Extent image{90, 70};
    const Box box(image, {16, 16}, 40);
    mir::InlineExecutor one;
    const auto wanted = banded(box, image, {256, 256}, 70, one);
    Box::GBuffer mirrored(image, {96, 80});
    const auto layout = mir::BlockedLayout::of(mirrored.tiles()[0]);
    const auto whole = box.luxels(image, {96, 80}, 0, 70);
    for (std::uint32_t y = 0; y < 70; ++y)
        for (std::uint32_t x = 0; x < 90; ++x)
            mirrored.store(0, layout(89 - x, y), whole.view(0).hit(layout(x, y)),
                           whole.view(0).surface(layout(x, y)));
    const auto matrix = box.visibility(mirrored, box.engine.visibility());
    const auto found = response(mirrored, box.vpls.span(), matrix, glossy, one);
    CHECK(found[0].g == Approx(wanted[0].g).epsilon(1e-6));
    CHECK_FALSE(same_bits(found, wanted));
}

TEST_CASE("Bands that do not make one image are refused") {
    const Box box({32, 32}, {16, 16}, 2);
    mir::InlineExecutor one;
    const auto add = [&](ResponseSum& sum) {
        sum.add_band(box.gbuffer, box.vpls.span(), box.matrix.view(), glossy, one);
    };
    ResponseSum narrow({16, 64}, 2);
    CHECK_THROWS_AS(add(narrow), mir::Error);
    ResponseSum other_vpls({32, 64}, 3);
    CHECK_THROWS_AS(add(other_vpls), mir::Error);
    ResponseSum sum({32, 40}, 2);
    add(sum);
    CHECK_THROWS_AS(sum.mean(), mir::Error);
    CHECK_THROWS_AS(add(sum), mir::Error);
    // Tiles that cut blocks.
    const auto cut = box.luxels({32, 32}, {20, 20}, 0, 32);
    const auto matrix = box.visibility(cut, box.engine.visibility());
    CHECK_THROWS_AS(response(cut, box.vpls.span(), matrix, glossy, one), mir::Error);
}
