// SPDX-License-Identifier: MIT
#include "mir/film/film.hpp"

#include "mir/core/random.hpp"
#include "support/catch.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <thread>
#include <vector>

namespace {

using mir::Extent;
using mir::Film;
using mir::Filter;
using mir::FilterKind;
using mir::Image;
using mir::LuxelGrid;
using mir::Rgb;
using mirtest::Approx;

std::vector<Filter> all_filters() {
    std::vector<Filter> filters;
    for (const mir::FilterName& entry : mir::filter_names)
        filters.push_back(mir::default_filter(entry.kind));
    filters.push_back({FilterKind::lanczos, 4.0f, 3.0f});
    filters.push_back({FilterKind::box, 1.0f});
    return filters;
}

/// Radiances over eight orders of magnitude, some black.
Image<Rgb> noise(Extent extent) {
    Image<Rgb> image(extent);
    std::uint64_t index = 0;
    for (Rgb& pixel : image.pixels()) {
        mir::Random random(4, mir::Stream::test, index++);
        const float scale = std::pow(10.0f, 8.0f * random.next() - 3.0f);
        pixel = {scale * random.next(), scale * random.next(), random.next() < 0.1f ? 0.0f : scale};
    }
    return image;
}

Image<Rgb> rows_of(const Image<Rgb>& image, std::uint32_t first, std::uint32_t count) {
    Image<Rgb> band({image.width(), count});
    const auto part = image.pixels().subspan(std::size_t{first} * image.width(),
                                             std::size_t{count} * image.width());
    std::copy(part.begin(), part.end(), band.pixels().begin());
    return band;
}

Image<Rgb> filtered(const LuxelGrid& grid, const Filter& filter, const Image<Rgb>& luxels) {
    Film film(grid, filter, 7);
    film.add_rows(0, luxels);
    return film.develop();
}

/// Where the luxels lie in their pixels.
Image<mir::Vec2> offsets_in(const LuxelGrid& grid, std::uint64_t seed) {
    Image<mir::Vec2> offsets(grid.luxels());
    for (std::uint32_t y = 0; y < offsets.height(); ++y)
        for (std::uint32_t x = 0; x < offsets.width(); ++x)
            offsets(x, y) = grid.pattern(x / grid.per_pixel_x, y / grid.per_pixel_y, seed)(
                x % grid.per_pixel_x, y % grid.per_pixel_y);
    return offsets;
}

bool same_bits(const Image<Rgb>& a, const Image<Rgb>& b) {
    return a.extent() == b.extent() &&
           std::memcmp(a.pixels().data(), b.pixels().data(), a.pixels().size_bytes()) == 0;
}

/// Two threads that take turns, from the last index to the first.
struct TwoThreads {
    template <class Body>
    void for_each(std::size_t n, Body&& body) {
        const auto run = [&](std::size_t start) {
            for (std::size_t i = start; i < n; i += 2) body(n - 1 - i);
        };
        std::thread other(run, std::size_t{1});
        run(0);
        other.join();
    }
    [[nodiscard]] std::size_t concurrency() const { return 2; }
};

}  // namespace

TEST_CASE("the sinc filter leaves one luxel per pixel as it is") {
    const LuxelGrid grid = mir::luxel_grid({37, 23}, 1);
    const Image<Rgb> luxels = noise(grid.luxels());
    CHECK(same_bits(filtered(grid, Filter{}, luxels), luxels));
    CHECK_FALSE(same_bits(filtered(grid, {FilterKind::lanczos, 4.0f, 3.0f}, luxels), luxels));
}

TEST_CASE("a constant image stays constant under every filter and number of luxels") {
    const Rgb constant{0.75f, 3.0f, 1e5f};
    for (const Filter& filter : all_filters())
        for (const std::uint32_t n : {1u, 2u, 3u, 4u, 7u, 16u, 64u}) {
            const LuxelGrid grid = mir::luxel_grid({9, 8}, n);
            const Image<Rgb> pixels = filtered(grid, filter, Image<Rgb>(grid.luxels(), constant));
            INFO(mir::to_string(filter.kind) << " " << filter.half_width << ", " << n);
            CHECK(same_bits(pixels, Image<Rgb>(grid.pixels, constant)));
        }
}

TEST_CASE("the film is the ratio of sums over positions") {
    // Evaluated without the film: every luxel against every pixel. Tabulated weights are off by an
    // amount that does not shrink with the weight, so that all of the radiance in reach counts.
    const auto compare = [](const LuxelGrid& grid, const Filter& filter) {
        const Image<Rgb> luxels = noise(grid.luxels());
        const Image<Rgb> pixels = filtered(grid, filter, luxels);
        const Image<mir::Vec2> offsets = offsets_in(grid, 7);
        INFO(mir::to_string(filter.kind) << " " << filter.half_width << ", " << grid.per_pixel());
        for (std::uint32_t py = 0; py < pixels.height(); ++py)
            for (std::uint32_t px = 0; px < pixels.width(); ++px) {
                double sum = 0.0, weights = 0.0, radiance = 0.0;
                for (std::uint32_t y = 0; y < luxels.height(); ++y)
                    for (std::uint32_t x = 0; x < luxels.width(); ++x) {
                        const auto dx = static_cast<float>(int(x / grid.per_pixel_x) - int(px));
                        const auto dy = static_cast<float>(int(y / grid.per_pixel_y) - int(py));
                        const mir::Vec2 p = offsets(x, y);
                        const double w = filter(p.x - 0.5f + dx, p.y - 0.5f + dy);
                        sum += w * luxels(x, y).g;
                        radiance += w == 0.0 ? 0.0 : luxels(x, y).g;
                        weights += w;
                    }
                CHECK(pixels(px, py).g == Approx(sum / weights).margin(2e-7 * radiance / weights));
            }
    };
    for (const Filter& filter : all_filters())
        for (const std::uint32_t n : {1u, 2u, 6u, 7u}) compare(mir::luxel_grid({11, 9}, n), filter);
    // Wider than the columns that are filtered together.
    compare(mir::luxel_grid({2 * mir::detail::film_columns + 5, 4}, 4), Filter{});
    compare(mir::luxel_grid({mir::detail::film_columns + 20, 2}, 2),
            {FilterKind::lanczos, 16.0f, 3.0f});
}

TEST_CASE("any cut into bands and any number of threads gives equal bits") {
    for (const std::uint32_t n : {1u, 6u, 16u})
        for (const Filter& filter : all_filters()) {
            const LuxelGrid grid = mir::luxel_grid({31, 17}, n);
            const Image<Rgb> luxels = noise(grid.luxels());
            const Image<Rgb> whole = filtered(grid, filter, luxels);
            INFO(mir::to_string(filter.kind) << " " << filter.half_width << ", " << n);
            for (const std::uint32_t height : {1u, 3u, 10u, 16u}) {
                Film film(grid, filter, 7);
                TwoThreads executor;
                for (std::uint32_t y = 0; y < luxels.height(); y += height)
                    film.add_rows(executor, y,
                                  rows_of(luxels, y, std::min(height, luxels.height() - y)));
                CHECK(film.rows() == luxels.height());
                CHECK(same_bits(film.develop(), whole));
            }
        }
}

TEST_CASE("films that hand rows on to each other give the bits of one") {
    const std::uint32_t luxels = GENERATE(1u, 4u, 9u);
    const LuxelGrid grid = mir::luxel_grid({70, 23}, luxels);
    const std::uint32_t ny = grid.per_pixel_y;
    const Image<Rgb> image = noise(grid.luxels());
    for (const Filter& filter : all_filters()) {
        const Image<Rgb> whole = filtered(grid, filter, image);
        std::vector<Film> films(3, Film(grid, filter, 7));
        Image<Rgb> pixels(grid.pixels);
        mir::FilmSeam seam;
        std::uint32_t band = 0;
        for (const std::uint32_t rows : {1u, 1u, 7u, 1u, 4u, 8u, 1u}) {
            Film& film = films[band++ * 2 % films.size()];
            if (film.rows() != seam.luxel_rows) film.go_on(seam);
            const std::uint32_t above = seam.first_row;
            film.add_rows(seam.luxel_rows, rows_of(image, seam.luxel_rows, rows * ny));
            seam = film.seam();
            const Image<Rgb> part = film.develop();
            for (std::uint32_t y = above; y < seam.first_row; ++y)
                for (std::uint32_t x = 0; x < pixels.width(); ++x) pixels(x, y) = part(x, y);
        }
        CHECK(seam.first_row == grid.pixels.height);
        CHECK(seam.sums.empty());
        CHECK(same_bits(pixels, whole));
    }
}

TEST_CASE("a film does not go on below the seam of another picture or above its rows") {
    const LuxelGrid grid = mir::luxel_grid({20, 12}, 4);
    Film film(grid, mir::default_filter(FilterKind::mitchell), 7);
    film.add_rows(0, Image<Rgb>({40, 8}));
    const mir::FilmSeam seam = film.seam();
    CHECK(seam.luxel_rows == 8);
    CHECK(seam.rows > 0);
    const auto refuses = [&](const LuxelGrid& of, FilterKind filter, std::size_t layers) {
        Film other(of, mir::default_filter(filter), 7, layers);
        CHECK_THROWS_AS(other.go_on(seam), mir::Error);
    };
    refuses(mir::luxel_grid({21, 12}, 4), FilterKind::mitchell, 1);
    refuses(mir::luxel_grid({20, 3}, 4), FilterKind::mitchell, 1);
    refuses(grid, FilterKind::box, 1);
    refuses(grid, FilterKind::mitchell, 2);
    Film further(grid, mir::default_filter(FilterKind::mitchell), 7);
    further.add_rows(0, Image<Rgb>({40, 10}));
    CHECK_THROWS_AS(further.go_on(seam), mir::Error);
    Film next(grid, mir::default_filter(FilterKind::mitchell), 7);
    CHECK_NOTHROW(next.go_on(seam));
    CHECK(next.rows() == 8);
}

TEST_CASE("a layer equals a film of that layer alone in every bit") {
    const LuxelGrid grid = mir::luxel_grid({70, 5}, 4);
    std::vector<Image<Rgb>> layers{noise(grid.luxels()),
                                   Image<Rgb>(grid.luxels(), Rgb{1.0f, 2.0f, 3.0f}),
                                   noise(grid.luxels())};
    for (Rgb& c : layers[2].pixels()) c = c * c;
    Film film(grid, Filter{}, 7, layers.size());
    TwoThreads executor;
    film.add_rows(executor, 0, layers);
    REQUIRE(film.layers() == 3);
    for (std::size_t i = 0; i < layers.size(); ++i)
        CHECK(same_bits(film.develop(i), filtered(grid, Filter{}, layers[i])));
}

TEST_CASE("every instruction set gives equal bits") {
    const LuxelGrid grid = mir::luxel_grid({70, 9}, 6);
    const Image<Rgb> luxels = noise(grid.luxels());
    for (const Filter& filter : all_filters()) {
        Film film(grid, filter, 7, 1, mir::InstructionSet::baseline);
        film.add_rows(0, luxels);
        INFO(mir::to_string(filter.kind) << " " << filter.half_width);
        CHECK(same_bits(film.develop(), filtered(grid, filter, luxels)));
    }
}

TEST_CASE("negative lobes survive next to a bright luxel") {
    const LuxelGrid grid = mir::luxel_grid({15, 15}, 16);
    Image<Rgb> luxels(grid.luxels(), Rgb{0.01f, 0.01f, 0.01f});
    for (std::uint32_t y = 28; y < 32; ++y)
        for (std::uint32_t x = 28; x < 32; ++x) luxels(x, y) = {1000.0f, 1000.0f, 1000.0f};
    const Image<Rgb> pixels = filtered(grid, Filter{}, luxels);
    const auto darkest = std::min_element(pixels.pixels().begin(), pixels.pixels().end(),
                                          [](Rgb a, Rgb b) { return a.g < b.g; });
    CHECK(darkest->g < -10.0f);
    CHECK(pixels(7, 7).g > 500.0f);
}

TEST_CASE("the box filter is the mean of a pixel's luxels") {
    const LuxelGrid grid = mir::luxel_grid({5, 4}, 4);
    const Image<Rgb> luxels = noise(grid.luxels());
    const Image<Rgb> pixels = filtered(grid, mir::filter_named("box"), luxels);
    const Rgb sum = luxels(6, 4) + luxels(7, 4) + luxels(6, 5) + luxels(7, 5);
    CHECK(pixels(3, 2).r == Approx(0.25f * sum.r));
}

TEST_CASE("an unfinished film shows complete rows as though the image ended there") {
    const LuxelGrid grid = mir::luxel_grid({8, 10}, 4);
    const Image<Rgb> luxels(grid.luxels(), Rgb{2.0f, 2.0f, 2.0f});
    Film film(grid, Filter{}, 7);
    CHECK(film.develop()(0, 0) == Rgb{});
    film.add_rows(0, rows_of(luxels, 0, 9));
    const Image<Rgb> part = film.develop();
    CHECK(part(3, 3).g == Approx(2.0f));
    CHECK(part(3, 4) == Rgb{});
    CHECK(part(3, 9) == Rgb{});
}

TEST_CASE("rows are developed one by one to what they are in the whole image") {
    const LuxelGrid grid = mir::luxel_grid({70, 10}, 4);
    mir::InlineExecutor executor;
    Film film(grid, Filter{}, 7);
    film.add_rows(0, rows_of(noise(grid.luxels()), 0, 12));
    Image<Rgb> image(grid.pixels, Rgb{9.0f, 9.0f, 9.0f});
    film.develop_rows(executor, 0, 2, 7, image);
    CHECK(same_bits(rows_of(image, 2, 5), rows_of(film.develop(), 2, 5)));
    CHECK(image(0, 1) == Rgb{9.0f, 9.0f, 9.0f});
    CHECK(image(69, 7) == Rgb{9.0f, 9.0f, 9.0f});
    Image<Rgb> small({70, 9});
    CHECK_THROWS_AS(film.develop_rows(executor, 0, 2, 7, small), mir::Error);
    CHECK_THROWS_AS(film.develop_rows(executor, 0, 2, 11, image), mir::Error);
}

TEST_CASE("a luxel that is not a number spoils only the pixels in its reach") {
    const LuxelGrid grid = mir::luxel_grid({9, 9}, 4);
    Image<Rgb> luxels(grid.luxels(), Rgb{1.0f, 1.0f, 1.0f});
    luxels(8, 8).r = std::numeric_limits<float>::quiet_NaN();
    const Image<Rgb> pixels = filtered(grid, mir::filter_named("box"), luxels);
    for (std::uint32_t y = 0; y < 9; ++y)
        for (std::uint32_t x = 0; x < 9; ++x)
            CHECK(mir::is_finite(pixels(x, y)) == !(x == 4 && y == 4));
}

TEST_CASE("bands out of order or of the wrong width and useless filters are refused") {
    const LuxelGrid grid = mir::luxel_grid({8, 4}, 4);
    Film film(grid, Filter{}, 7);
    CHECK_THROWS_AS(film.add_rows(1, Image<Rgb>({16, 2})), mir::Error);
    CHECK_THROWS_AS(film.add_rows(0, Image<Rgb>({8, 2})), mir::Error);
    CHECK_THROWS_AS(film.add_rows(0, Image<Rgb>({16, 9})), mir::Error);
    film.add_rows(0, Image<Rgb>({16, 2}));
    CHECK_THROWS_AS(film.add_rows(0, Image<Rgb>({16, 2})), mir::Error);
    film.add_rows(2, Image<Rgb>({16, 0}));
    CHECK(film.rows() == 2);
    CHECK_THROWS_AS(film.develop(1), mir::Error);
    CHECK_THROWS_AS(Film(grid, Filter{}, 7, 0), mir::Error);
    CHECK_THROWS_AS(Film(grid, {FilterKind::box, 0.25f}, 7), mir::Error);
    CHECK_THROWS_AS(Film(grid, {FilterKind::lanczos, 3.0f, 0.0f}, 7), mir::Error);
    CHECK_THROWS_AS(Film(grid, {FilterKind::tent, std::numeric_limits<float>::quiet_NaN()}, 7),
                    mir::Error);
}

TEST_CASE("layers of another number or height are refused and leave the film as it was") {
    const LuxelGrid grid = mir::luxel_grid({8, 4}, 4);
    Film film(grid, Filter{}, 7, 2);
    mir::InlineExecutor executor;
    std::vector<Image<Rgb>> layers(2, Image<Rgb>({16, 2}));
    CHECK_THROWS_AS(film.add_rows(0, layers[0]), mir::Error);
    layers[1] = Image<Rgb>({16, 3});
    CHECK_THROWS_AS(film.add_rows(executor, 0, layers), mir::Error);
    CHECK(film.rows() == 0);
    layers[1] = Image<Rgb>({16, 2});
    film.add_rows(executor, 0, layers);
    CHECK(film.rows() == 2);
}
