// SPDX-License-Identifier: MIT
#include "mir/kernels/response.hpp"

#include "mir/host/backend.hpp"
#include "mir/host/tbb_executor.hpp"
#include "mir/normalise/response.hpp"
#include "mir/resident/backend_response.hpp"
#include "mir/shading/vpl_shading.hpp"
#include "normalise/lit_box.hpp"
#include "support/catch.hpp"
#include "support/lazy_backend.hpp"
#include "support/same_responses.hpp"

namespace {

using mir::Extent;
using mir::ImageResponse;
using Responses = std::vector<ImageResponse>;

/// Responses on a backend, the image in bands of `rows` luxels; sums of `partial_sums` at a time.
template <mir::Bsdf F, mir::Backend B, mir::Shading S>
Responses on_backend(const B& backend, const mirtest::LitBox<F>& box, Extent image, Extent tile,
                     const S& shading, std::uint32_t rows = 1u << 20,
                     std::uint32_t partial_sums = 1u << 21) {
    const mir::VplSpan<mir::Space::host> vpls = box.vpls.span();
    auto queue = backend.queue();
    mir::BackendResponse<B> there_sums(backend, image, vpls.size(), partial_sums);
    mir::ResponseSum sum(image, vpls.size());
    for (std::uint32_t row = 0; row < image.height; row += rows) {
        const Extent band{image.width, std::min(rows, image.height - row)};
        const auto luxels = box.luxels(image, tile, row, band.height);
        mir::BackendGBuffer<B, typename F::Params> there(backend, band, tile);
        there.upload(queue, luxels);
        mir::BackendVisibility<B> seen(backend, there.grid(), vpls.size());
        seen.find(queue, there, vpls, box.engine.visibility());
        there_sums.sum_rows(queue, there, vpls, seen, shading);
        sum.add_by(band, [&](auto totals) { there_sums.add_rows(queue, totals); });
    }
    return sum.mean();
}

template <mir::Bsdf F, mir::Shading S>
Responses on_host(const mirtest::LitBox<F>& box, const S& shading) {
    mir::InlineExecutor executor;
    return response(box.gbuffer, box.vpls.span(), box.matrix, shading, executor);
}

const mir::VplShading<mir::CookTorrance> glossy{3.0f};

}  // namespace

TEMPLATE_TEST_CASE("Responses on a backend are those of the host", "", mir::Lambert,
                   mir::CookTorrance) {
    const Extent image{90, 70};
    const mirtest::LitBox<TestType> box(image);
    mir::TbbExecutor executor(2);
    const mir::VplShading<TestType> shading{3.0f};
    const Responses wanted = on_host(box, shading);
    const Responses found = on_backend(mir::host::Backend(executor), box, image, {48, 32}, shading);
    REQUIRE(found.size() == wanted.size());
    double largest = 0.0;
    std::uint64_t lit = 0;
    for (std::size_t j = 0; j < wanted.size(); ++j) {
        CHECK(found[j].r == mirtest::Approx(wanted[j].r).epsilon(1e-12));
        CHECK(found[j].g == mirtest::Approx(wanted[j].g).epsilon(1e-12));
        CHECK(found[j].b == mirtest::Approx(wanted[j].b).epsilon(1e-12));
        CHECK(found[j].lit_luxels == wanted[j].lit_luxels);
        largest = std::max(largest, wanted[j].g);
        lit += wanted[j].lit_luxels;
    }
    CHECK(largest > 0.0);
    CHECK(lit > 1000);
    // No luxel is counted that reflects nothing or sees nothing.
    CHECK(lit < 90 * 70 * wanted.size());
    // On the host shading has the same bits, and so have sums in the same order.
    CHECK(mirtest::same_bits(found, wanted));
}

TEST_CASE("Responses on a backend have the same bits for any tiles, bands, memory and lateness") {
    const Extent image{90, 70};
    const mirtest::LitBox<mir::CookTorrance> box(image, {16, 16}, 80);
    REQUIRE(box.vpls.size() > 64);
    mir::InlineExecutor executor;
    const mir::host::Backend backend(executor);
    const Responses wanted = on_host(box, glossy);
    const auto check = [&](const Responses& found) { CHECK(mirtest::same_bits(found, wanted)); };
    check(on_backend(backend, box, image, {16, 16}, glossy));
    check(on_backend(backend, box, image, {256, 256}, glossy));
    check(on_backend(backend, box, image, {48, 32}, glossy, 32));
    check(on_backend(backend, box, image, {32, 64}, glossy, 48));
    // Six blocks side by side: 1 row of 32 VPLs, 1 row of 50, 3 rows of all.
    for (const std::uint32_t partial_sums : {0u, 300u, 1700u})
        check(on_backend(backend, box, image, {48, 80}, glossy, 1000, partial_sums));
    mirtest::PutOff work(GENERATE(0u, 1u));
    check(on_backend(mirtest::LazyBackend(work), box, image, {48, 32}, glossy, 64, 400));
}

TEST_CASE("Sums go from left to right along rows of blocks, then from top to bottom") {
    // Two VPLs, three columns, two rows. Big numbers swallow small ones that come after them.
    const double big = 0x1p53;
    const double values[2][3] = {{big, 1.0, 1.0}, {1.0, 1.0, big}};
    std::vector<ImageResponse> blocks;
    for (const auto& row : values)
        for (double x : row)
            for (std::uint64_t vpl = 0; vpl < 2; ++vpl) blocks.push_back({x, 1.0, 2.0, vpl});
    std::vector<ImageResponse> rows(4);
    const mir::SumBlockRow along{blocks.data(), 3, 2, rows.data(), 2};
    for (std::uint32_t i = 0; i < 4; ++i) along(i);
    CHECK(rows[1].r == big);
    CHECK(rows[3].r == big + 2.0);
    const auto check_means = [&](const mir::ResponseSum& sum) {
        const std::vector<ImageResponse> means = sum.mean();
        CHECK(means[1].r == (big + (big + 2.0)) / 32);
        CHECK(means[1].g == 6.0 / 32);
        CHECK(means[1].b == 12.0 / 32);
        CHECK(means[0].lit_luxels == 0);
        CHECK(means[1].lit_luxels == 6);
    };
    mir::ResponseSum sum({1, 32}, 2);
    sum.add_rows({1, 32}, rows);
    check_means(sum);
    mir::ResponseSum by_kernel({1, 32}, 2);
    by_kernel.add_by({1, 32}, [&](std::span<ImageResponse> totals) {
        const mir::AddBlockRows down{rows.data(), 2, 2, totals.data()};
        for (std::uint32_t j = 0; j < 2; ++j) down(j);
    });
    check_means(by_kernel);
}

TEST_CASE("Rows are added to totals one by one, not to each other") {
    // The big total swallows each of the small rows, though not their sum.
    std::vector<ImageResponse> totals{{0x1p53, 0.0, 0.0, 1}};
    const std::vector<ImageResponse> rows(4, {1.0, 1.0, 1.0, 1});
    mir::AddBlockRows{rows.data(), 4, 1, totals.data()}(0);
    CHECK(totals[0].r == 0x1p53);
    CHECK(totals[0].g == 4.0);
    CHECK(totals[0].lit_luxels == 5);
}

TEST_CASE("Sums of other rows of blocks than a band's are refused") {
    mir::ResponseSum sum({20, 40}, 3);
    CHECK_THROWS_AS(sum.add_rows({20, 32}, Responses(3)), mir::Error);
    CHECK_THROWS_AS(sum.add_rows({16, 32}, Responses(6)), mir::Error);
    CHECK_NOTHROW(sum.add_rows({20, 32}, Responses(6)));
    CHECK_THROWS_AS(sum.mean(), mir::Error);
    CHECK_NOTHROW(sum.add_rows({20, 8}, Responses(3)));
    CHECK(sum.mean().size() == 3);
}

TEST_CASE("Black luxels do not count as lit on a backend, those beside them do") {
    const std::uint32_t every = GENERATE(1u, 3u);  // luxel that is black
    CAPTURE(every);
    const Extent image{40, 24};
    const mirtest::LitBox<mir::Lambert> box(image);
    auto black = box.luxels(image, {16, 16}, 0, 24);
    for (mir::TileIndex t = 0; t < black.tiles().size(); ++t)
        for (mir::LuxelIndex i = 0; i < black.view(t).size(); i += every) {
            auto surface = black.view(t).surface(i);
            surface.bsdf.reflectance = {};
            black.store(t, i, black.view(t).hit(i), surface);
        }
    mir::InlineExecutor executor;
    const mir::host::Backend backend(executor);
    auto queue = backend.queue();
    using B = mir::host::Backend<mir::InlineExecutor>;
    mir::BackendVisibility<B> seen(backend, mir::TileGrid::of(image, black.tiles()),
                                   box.vpls.size());
    seen.find(queue, black, box.vpls.span(), box.engine.visibility());
    mir::BackendResponse<B> there(backend, image, box.vpls.size());
    const mir::VplShading<mir::Lambert> shading;
    mir::ResponseSum sum(image, box.vpls.size());
    there.sum_rows(queue, black, box.vpls.span(), seen, shading);
    sum.add_by(image, [&](auto totals) { there.add_rows(queue, totals); });
    const auto matrix = box.visibility(black, box.engine.visibility());
    const Responses wanted = response(black, box.vpls.span(), matrix, shading, executor);
    std::uint64_t lit = 0;
    for (const ImageResponse& t : wanted) lit += t.lit_luxels;
    CHECK((every == 1 ? lit == 0 : lit > 1000));
    CHECK(mirtest::same_bits(sum.mean(), wanted));
}

TEST_CASE("A response of no VPLs is empty") {
    const mirtest::LitBox<mir::Lambert> box({16, 16}, {16, 16}, 2);
    mir::InlineExecutor executor;
    const mir::host::Backend backend(executor);
    using B = mir::host::Backend<mir::InlineExecutor>;
    auto queue = backend.queue();
    const mir::VplSpan<mir::Space::host> none;
    mir::BackendVisibility<B> seen(backend, mir::TileGrid::of({16, 16}, box.gbuffer.tiles()), 0);
    seen.find(queue, box.gbuffer, none, box.engine.visibility());
    mir::BackendResponse<B> there(backend, {16, 16}, 0);
    there.sum_rows(queue, box.gbuffer, none, seen, mir::VplShading<mir::Lambert>{});
    mir::ResponseSum sum({16, 16}, 0);
    sum.add_by({16, 16}, [&](auto totals) { there.add_rows(queue, totals); });
    CHECK(sum.mean().empty());
    mir::ResponseSum by_rows({16, 16}, 0);
    CHECK_NOTHROW(by_rows.add_rows({16, 16}, {}));
    CHECK(by_rows.mean().empty());
}

TEST_CASE("Luxels, VPLs and visibility that do not belong together are refused on a backend") {
    const Extent image{32, 32};
    const mirtest::LitBox<mir::Lambert> box(image, {16, 16}, 2);
    mir::InlineExecutor executor;
    const mir::host::Backend backend(executor);
    using B = mir::host::Backend<mir::InlineExecutor>;
    auto queue = backend.queue();
    const std::uint32_t n = box.vpls.size();
    const auto grid = mir::TileGrid::of(image, box.gbuffer.tiles());
    const auto add = [&](const auto& g, Extent luxels, std::uint32_t vpls,
                         const mir::TileGrid& seen_grid, std::uint32_t seen_vpls) {
        const mir::BackendVisibility<B> seen(backend, seen_grid, seen_vpls);
        mir::BackendResponse<B> there(backend, luxels, vpls);
        there.sum_rows(queue, g, box.vpls.span(), seen, mir::VplShading<mir::Lambert>{});
        std::vector<ImageResponse> totals(box.vpls.size() + 1);
        CHECK_THROWS_AS(there.add_rows(queue, totals), mir::Error);
        totals.pop_back();
        there.add_rows(queue, totals);
    };
    CHECK_NOTHROW(add(box.gbuffer, image, n, grid, n));
    CHECK_THROWS_AS(add(box.gbuffer, {16, 64}, n, grid, n), mir::Error);
    CHECK_THROWS_AS(add(box.gbuffer, {32, 16}, n, grid, n), mir::Error);
    CHECK_THROWS_AS(add(box.gbuffer, image, n + 1, grid, n), mir::Error);
    CHECK_THROWS_AS(add(box.gbuffer, image, n, grid, n + 1), mir::Error);
    CHECK_THROWS_AS(add(box.gbuffer, image, n, {image, {32, 16}}, n), mir::Error);
    // Tiles that cut blocks.
    const auto cut = box.luxels(image, {20, 20}, 0, 32);
    CHECK_THROWS_AS(add(cut, image, n, mir::TileGrid::of(image, cut.tiles()), n), mir::Error);
    mir::BackendVisibility<B> other(backend, grid, n + 1);
    CHECK_THROWS_AS(other.find(queue, box.gbuffer, box.vpls.span(), box.engine.visibility()),
                    mir::Error);
}

TEST_CASE("Visibility on a backend keeps the limit of stored visibility") {
    mir::InlineExecutor executor;
    const mir::host::Backend backend(executor);
    using Seen = mir::BackendVisibility<mir::host::Backend<mir::InlineExecutor>>;
    const mir::TileGrid grid{{32, 32}, {32, 32}};
    CHECK(Seen::bytes_for(grid, 3) == 32 * 32 / 8 * 3);
    mir::Limits limits;
    limits.visibility_bytes = 32 * 32 / 8 * 3;
    CHECK_NOTHROW(Seen(backend, grid, 3, limits));
    CHECK_THROWS_AS(Seen(backend, grid, 4, limits), mir::Error);
}
