// SPDX-License-Identifier: MIT
#include "mir/resident/backend_film.hpp"

#include "mir/film/film.hpp"
#include "mir/host/backend.hpp"
#include "support/backwards_executor.hpp"
#include "support/catch.hpp"
#include "support/lazy_backend.hpp"

#include <cstring>
#include <memory>

namespace {

using mir::Extent;
using mir::Image;
using mir::Rgb;

/// Luxels of all sizes and signs, a function of their places.
Image<Rgb> random_luxels(Extent extent, std::uint64_t seed) {
    Image<Rgb> image(extent);
    mir::Random random(seed, mir::Stream::test, 0);
    for (Rgb& c : image.pixels())
        c = {random.next() - 0.25f, 1e3f * random.next(), 1.0f / (random.next() + 1e-3f)};
    return image;
}

/// Some rows of an image.
Image<Rgb> rows_of(const Image<Rgb>& image, std::uint32_t first, std::uint32_t count) {
    Image<Rgb> rows({image.width(), count});
    for (std::uint32_t y = 0; y < count; ++y)
        for (std::uint32_t x = 0; x < image.width(); ++x) rows(x, y) = image(x, first + y);
    return rows;
}

template <mir::Backend B>
mir::BackendLayer<B> layer_of(const B& backend, typename B::Queue& queue, const Image<Rgb>& image,
                              Extent tile) {
    const auto tiles = mir::cut_into_tiles(image.extent(), tile);
    mir::BackendLayer<B> layer(backend, mir::TileGrid::of(image.extent(), tiles));
    std::vector<std::uint32_t> words(layer.words().size());
    for (mir::TileIndex t = 0; t < tiles.size(); ++t) {
        const auto layout = mir::BlockedLayout::of(tiles[t]);
        const mir::SoaView<Rgb> to{words.data() + mir::LayerView::first_word(layer.grid(), t),
                                   layout.size()};
        for (std::uint32_t y = 0; y < tiles[t].height; ++y)
            for (std::uint32_t x = 0; x < tiles[t].width; ++x)
                to.store(layout(x, y), image(tiles[t].x + x, tiles[t].y + y));
    }
    queue.upload(std::span<const std::uint32_t>(words), layer.words());
    queue.record().sync();
    return layer;
}

/// Images of luxels that come in bands of these heights.
template <mir::Backend B>
std::vector<Image<Rgb>> developed_on(const B& backend, const mir::LuxelGrid& grid,
                                     const mir::Filter& filter,
                                     const std::vector<Image<Rgb>>& layers,
                                     const std::vector<std::uint32_t>& heights) {
    auto queue = backend.queue();
    const std::uint32_t most = *std::max_element(heights.begin(), heights.end());
    mir::BackendFilm<B> film(backend, queue, grid, filter, 7,
                             static_cast<std::uint32_t>(layers.size()), most);
    mirtest::BackwardsExecutor executor{2};
    std::vector<Image<Rgb>> images(layers.size(), Image<Rgb>(grid.pixels));
    std::uint32_t first = 0;
    for (const std::uint32_t height : heights) {
        std::vector<mir::BackendLayer<B>> band;
        for (const Image<Rgb>& layer : layers)
            band.push_back(layer_of(backend, queue, rows_of(layer, first, height), {32, 16}));
        film.add_rows(queue, first, band);
        film.bring_home(queue, executor, images);
        first += height;
    }
    return images;
}

bool same_bits(const Image<Rgb>& a, const Image<Rgb>& b) {
    return a.extent() == b.extent() &&
           std::memcmp(a.pixels().data(), b.pixels().data(), a.pixels().size_bytes()) == 0;
}

}  // namespace

TEST_CASE("A film on a backend has the bits of the host's for all filters, bands and layers") {
    const mir::FilterKind kind =
        GENERATE(mir::FilterKind::box, mir::FilterKind::tent, mir::FilterKind::gaussian,
                 mir::FilterKind::mitchell, mir::FilterKind::lanczos);
    const std::uint32_t luxels = GENERATE(1u, 2u, 9u);
    const mir::LuxelGrid grid = mir::luxel_grid({37, 21}, luxels);
    mir::Filter filter = mir::default_filter(kind);
    if (luxels == 9) filter.half_width *= 1.5f;
    const std::uint32_t ny = grid.per_pixel_y;
    std::vector<Image<Rgb>> layers;
    for (std::uint64_t l = 0; l < 4; ++l) layers.push_back(random_luxels(grid.luxels(), l));
    mir::Film host(grid, filter, 7, layers.size());
    mir::InlineExecutor executor;
    host.add_rows(executor, 0, layers);

    const mir::host::Backend backend(executor);
    mirtest::PutOff work(0);
    for (const std::vector<std::uint32_t>& heights :
         {std::vector<std::uint32_t>{21 * ny}, {16 * ny, 5 * ny}, {ny, ny, 2 * ny, 16 * ny, ny}}) {
        const auto images = developed_on(backend, grid, filter, layers, heights);
        const auto late = developed_on(mirtest::LazyBackend(work), grid, filter, layers, heights);
        REQUIRE(images.size() == layers.size());
        for (std::size_t l = 0; l < layers.size(); ++l) {
            CHECK(same_bits(host.develop(l), images[l]));
            CHECK(same_bits(images[l], late[l]));
        }
    }
}

TEST_CASE("Films of a backend and of the host hand rows on to each other, with the bits of one") {
    const std::uint32_t luxels = GENERATE(1u, 4u);
    const mir::LuxelGrid grid = mir::luxel_grid({37, 21}, luxels);
    const std::uint32_t ny = grid.per_pixel_y;
    const mir::Filter filter = mir::default_filter(mir::FilterKind::lanczos);
    const std::vector<Image<Rgb>> layers{random_luxels(grid.luxels(), 0),
                                         random_luxels(grid.luxels(), 1)};
    mir::InlineExecutor executor;
    mir::Film whole(grid, filter, 7, 2);
    whole.add_rows(executor, 0, layers);

    using Lazy = mirtest::LazyBackend;
    mirtest::PutOff work(0);
    const Lazy backend(work);
    auto queue = backend.queue();
    std::vector<std::unique_ptr<mir::BackendFilm<Lazy>>> films;
    for (int k = 0; k < 2; ++k)
        films.push_back(
            std::make_unique<mir::BackendFilm<Lazy>>(backend, queue, grid, filter, 7, 2, 9 * ny));
    mir::Film host(grid, filter, 7, 2);
    // Both bring their rows to the same images.
    std::vector<Image<Rgb>> images(2, Image<Rgb>(grid.pixels));
    mir::FilmSeam seam;
    std::vector<std::uint32_t> ends;  // of pixel rows, by band
    const std::vector<std::uint32_t> heights{2, 1, 9, 1, 1, 7};
    for (std::size_t i = 0; i < heights.size(); ++i) {
        const std::uint32_t first = seam.luxel_rows;
        std::vector<Image<Rgb>> band;
        for (const Image<Rgb>& layer : layers)
            band.push_back(rows_of(layer, first, heights[i] * ny));
        if (i % 3 == 2) {
            host.go_on(seam);
            host.add_rows(executor, first, band);
            seam = host.seam();
        } else {
            auto& film = *films[i % 3];
            if (film.rows() != first) film.go_on(queue, seam);
            std::vector<mir::BackendLayer<Lazy>> there;
            for (const Image<Rgb>& image : band)
                there.push_back(layer_of(backend, queue, image, {32, 16}));
            film.add_rows(queue, first, there);
            film.bring_home(queue, executor, images);
            seam = film.seam(queue);
        }
        ends.push_back(seam.first_row);
    }
    CHECK(ends.back() == grid.pixels.height);
    for (std::size_t l = 0; l < 2; ++l) {
        const Image<Rgb> of_host = host.develop(l);
        const Image<Rgb>* const makers[] = {&images[l], &images[l], &of_host};
        Image<Rgb> pixels(grid.pixels);
        std::uint32_t y = 0;
        for (std::size_t i = 0; i < ends.size(); ++i)
            for (; y < ends[i]; ++y)
                for (std::uint32_t x = 0; x < pixels.width(); ++x)
                    pixels(x, y) = (*makers[i % 3])(x, y);
        CHECK(same_bits(whole.develop(l), pixels));
    }
}

TEST_CASE("A film on a backend refuses bands that do not continue it") {
    mir::InlineExecutor executor;
    const mir::host::Backend backend(executor);
    auto queue = backend.queue();
    const mir::LuxelGrid grid = mir::luxel_grid({20, 12}, 1);
    using Host = mir::host::Backend<mir::InlineExecutor>;
    mir::BackendFilm<Host> film(backend, queue, grid, {}, 0, 1, 8);
    const auto band = [&](Extent extent, std::size_t count) {
        std::vector<mir::BackendLayer<Host>> layers;
        for (std::size_t l = 0; l < count; ++l)
            layers.push_back(layer_of(backend, queue, Image<Rgb>(extent), {16, 16}));
        return layers;
    };
    auto two = band({20, 8}, 2), narrow = band({19, 8}, 1), good = band({20, 8}, 1);
    CHECK_THROWS_AS(film.add_rows(queue, 0, two), mir::Error);
    CHECK_THROWS_AS(film.add_rows(queue, 0, narrow), mir::Error);
    CHECK_THROWS_AS(film.add_rows(queue, 4, good), mir::Error);
    film.add_rows(queue, 0, good);
    CHECK_THROWS_AS(film.add_rows(queue, 8, good), mir::Error);  // not at home, and too high
    std::vector<Image<Rgb>> images(1, Image<Rgb>(grid.pixels)), smaller(1, Image<Rgb>({20, 8}));
    CHECK_THROWS_AS(film.bring_home(queue, executor, smaller), mir::Error);
    CHECK_THROWS_AS(film.bring_home(queue, executor, {}), mir::Error);
    film.bring_home(queue, executor, images);
    CHECK_THROWS_AS(film.add_rows(queue, 8, good), mir::Error);
    auto rest = band({20, 4}, 1);
    film.add_rows(queue, 8, rest);
    film.bring_home(queue, executor, images);
}
