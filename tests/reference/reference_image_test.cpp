// SPDX-License-Identifier: MIT
#include "mir/reference/reference_image.hpp"

#include "mir/runtime/cancellable_executor.hpp"
#include "mir/scenes.hpp"
#include "mir/shading/lambert.hpp"
#include "studio.hpp"
#include "support/catch.hpp"

#include <array>
#include <bit>

using namespace mirtest;
using mir::Lambert;
using mir::Rgb;

namespace {

const Studio<Lambert>& box() {
    static const Studio<Lambert> studio(mir::builtin::cornell_box(mir::builtin::Lamp::down));
    return studio;
}

template <class Executor>
mir::ReferenceImage traced(Executor& executor, std::uint32_t replicates, std::uint32_t first = 0) {
    mir::ReferenceOptions options;
    options.samples = 3;
    options.replicates = replicates;
    options.first_replicate = first;
    options.last_bounce = 4;
    return trace_reference(box().tracer({}), box().rays(20, 21), options, executor);
}

auto bits_of(const mir::RgbMoments& m) { return std::bit_cast<std::array<std::uint64_t, 6>>(m); }

bool same_bits(const mir::ReferenceImage& a, const mir::ReferenceImage& b) {
    for (std::uint32_t y = 0; y < a.extent().height; ++y)
        for (std::uint32_t x = 0; x < a.extent().width; ++x) {
            if (bits_of(a.beauty_moments(x, y)) != bits_of(b.beauty_moments(x, y))) return false;
            for (std::uint8_t l = 0; l <= a.last_bounce(); ++l)
                if (bits_of(a.bounce_moments(x, y, l)) != bits_of(b.bounce_moments(x, y, l)))
                    return false;
        }
    return true;
}

double mean(const mir::Image<Rgb>& image) {
    double sum = 0.0;
    for (const Rgb& c : image.pixels()) sum += static_cast<double>(c.g);
    return sum / static_cast<double>(image.pixels().size());
}

}  // namespace

TEST_CASE("moments over replicates are mean and variance of the mean") {
    mir::RgbMoments m;
    const double values[] = {1.0, 4.0, 7.0};
    for (std::uint32_t i = 0; i < 3; ++i) m.add({{values[i], 2.0, -values[i]}}, i);
    CHECK(m.mean.channel[0] == Approx(4.0));
    CHECK(m.mean.channel[2] == Approx(-4.0));
    CHECK(m.variance_of_mean(3).channel[0] == Approx(3.0));  // sample variance 9 over 3
    CHECK(m.variance_of_mean(3).channel[1] == 0.0);
    CHECK_THROWS_AS(m.variance_of_mean(1), mir::Error);
}

TEST_CASE("layers are bounces, prefixes their sums, and the beauty has all of them") {
    mir::ReferenceImage image({2, 1}, 1, 2);
    const std::vector<mir::RgbSum> first = {{{1, 1, 1}}, {{2, 2, 2}}, {{4, 4, 4}}};
    const std::vector<mir::RgbSum> second = {{{1, 1, 1}}, {{4, 4, 4}}, {{0, 0, 0}}};
    image.add(1, 0, 0, first);
    image.add(1, 0, 1, second);
    CHECK(image.bounce(1)(1, 0) == Rgb{3, 3, 3});
    CHECK(image.bounce(2)(1, 0) == Rgb{});
    CHECK(image.up_to(0)(1, 0) == Rgb{1, 1, 1});
    CHECK(image.up_to(1)(1, 0) == Rgb{4, 4, 4});
    CHECK(image.beauty()(1, 0) == Rgb{6, 6, 6});
    CHECK(image.bounce_variance(1)(1, 0).g == Approx(1.0f));
    CHECK(image.beauty_variance()(1, 0).g == Approx(1.0f));
    CHECK(image.beauty()(0, 0) == Rgb{});
}

TEST_CASE("a reference has the same bits on any number of threads") {
    mir::InlineExecutor one;
    mir::TbbExecutor two(2);
    mir::TbbExecutor three(3);
    const auto image = traced(one, 3);
    CHECK(same_bits(image, traced(two, 3)));
    CHECK(same_bits(image, traced(three, 3)));
    CHECK_FALSE(same_bits(image, traced(one, 3, 1)));
}

TEST_CASE("single replicates are those that the whole is made of") {
    mir::TbbExecutor executor;
    const auto whole = traced(executor, 3);
    mir::ReferenceImage put_together(whole.extent(), whole.last_bounce(), 3);
    for (std::uint32_t r = 0; r < 3; ++r) {
        const auto part = traced(executor, 1, r);
        for (std::uint32_t y = 0; y < 20; ++y)
            for (std::uint32_t x = 0; x < 20; ++x)
                put_together.add(x, y, r, std::vector{part.beauty_moments(x, y).mean});
    }
    CHECK(mean(whole.beauty()) == Approx(mean(put_together.beauty())).epsilon(1e-12));
    CHECK(mean(whole.beauty_variance()) == Approx(mean(put_together.beauty_variance())));
}

// H0: the squared distance of two disjoint references over the sum of their stated variances has
// mean 1. Student's t over the luxels of an image, seed 21, level 1 %.
TEST_CASE("the stated variance is the spread between independent references", "[statistical]") {
    mir::TbbExecutor executor;
    const auto a = traced(executor, 64, 0);
    const auto b = traced(executor, 64, 64);
    Moments ratio;
    for (std::uint32_t y = 2; y < 18; ++y)
        for (std::uint32_t x = 2; x < 18; ++x) {
            const double va = a.beauty_moments(x, y).variance_of_mean(64).channel[1];
            const double vb = b.beauty_moments(x, y).variance_of_mean(64).channel[1];
            const double d =
                a.beauty_moments(x, y).mean.channel[1] - b.beauty_moments(x, y).mean.channel[1];
            if (va + vb > 0.0) ratio.add(d * d / (va + vb));
        }
    CAPTURE(ratio.mean(), ratio.standard_error());
    REQUIRE(ratio.count() > 200);
    CHECK(mean_p_value(ratio, 1.0) > 0.01);
    CHECK(mean_p_value(ratio, 2.0) < 0.01);  // a variance stated by half
}

TEST_CASE("film positions are the luxel's or spread over its pixel") {
    mir::Scene scene;
    const std::uint32_t lamp = scene.add(mir::emitter("lamp", {}, {1, 1, 1}));
    scene.place(mir::builtin::quad("half", lamp, {-1, -1, -1}, {1, 0, 0}, {0, 2, 0}));
    scene.cameras = {mir::Camera::look_at({0, 0, 0}, {0, 0, -1}, {0, 1, 0}, 0.5f)};
    const Studio<Lambert> studio(scene);
    const auto rays = studio.rays(1, 4);  // one pixel, its left half lit
    mir::InlineExecutor executor;
    mir::ReferenceOptions options;
    options.samples = 4096;
    options.replicates = 2;
    options.film = mir::FilmPosition::pixel;
    const auto spread = trace_reference(studio.tracer({}), rays, options, executor);
    CHECK(spread.bounce(0)(0, 0).g == Approx(0.5).margin(0.03));
    options.film = mir::FilmPosition::luxel;
    const auto fixed = trace_reference(studio.tracer({}), rays, options, executor);
    const float centre = fixed.bounce(0)(0, 0).g;
    CHECK((centre == 0.0f || centre == 1.0f));
}

TEST_CASE("a reference can be cancelled") {
    mir::InlineExecutor executor;
    mir::Monitor monitor;
    mir::CancellableExecutor cancellable(executor, &monitor);
    CHECK_NOTHROW(traced(cancellable, 1));
    monitor.cancelled = true;
    CHECK_THROWS_AS(traced(cancellable, 1), mir::Error);
}

TEST_CASE("a reference of no samples is refused") {
    mir::InlineExecutor executor;
    CHECK_THROWS_AS(traced(executor, 0), mir::Error);
}

TEST_CASE("rows of a reference have the bits that they have in the whole image") {
    mir::InlineExecutor executor;
    mir::ReferenceOptions options;
    options.samples = 2;
    options.replicates = 2;
    const auto tracer = box().tracer({});
    const mir::CameraRays rays = box().rays(20, 21);
    const mir::ReferenceImage whole = trace_reference(tracer, rays, options, executor);
    options.rows = {7, 5};
    const mir::ReferenceImage rows = trace_reference(tracer, rays, options, executor);
    REQUIRE(rows.extent() == mir::Extent{whole.extent().width, 5});
    for (std::uint32_t y = 0; y < 5; ++y)
        for (std::uint32_t x = 0; x < rows.extent().width; ++x)
            CHECK(bits_of(rows.beauty_moments(x, y)) == bits_of(whole.beauty_moments(x, y + 7)));
    for (const mir::LuxelRows below :
         {mir::LuxelRows{whole.extent().height, {}}, {1, whole.extent().height}}) {
        options.rows = below;
        CHECK_THROWS_AS(trace_reference(tracer, rays, options, executor), mir::Error);
    }
}
