// SPDX-License-Identifier: MIT
//
// The sum over VPLs does not depend on their order, nor the light of a luxel on where it stands in
// memory and how often.
#include "conformance/brute_force.hpp"
#include "conformance/stage.hpp"
#include "mir/fill_visibility.hpp"
#include "mir/normalise/response.hpp"
#include "mir/reconstruct.hpp"
#include "mir/sched/cpu.hpp"
#include "mir/sched/cpu_blocks.hpp"
#include "mir/shading/vpl_shading.hpp"
#include "support/catch.hpp"

namespace {

using Matte = mirtest::Stage<mir::Lambert, mirtest::BruteForceScene>;
using GBuffer = mir::BlockedGBuffer<mir::Lambert::Params>;
using Vpls = std::vector<mir::Vpl>;

const mir::VplShading<mir::Lambert> shading{2.0f};
constexpr std::uint32_t side = 40;

const Matte& stage() {
    static const Matte one({side, side}, {side, side}, 23);
    return one;
}

Vpls vpls() {
    Vpls list;
    for (mir::VplIndex j = 0; j < stage().vpls().size(); ++j) list.push_back(stage().vpls()[j]);
    return list;
}

mir::Image<mir::Rgb> image(const GBuffer& luxels, const Vpls& list, bool tuned = true) {
    mir::InlineExecutor executor;
    const auto sight = stage().visibility();
    if (tuned)
        return reconstruct(mir::sched::CpuBlocks{executor}, luxels, mir::span_of(list), sight,
                           shading);
    return reconstruct(mir::sched::Cpu{executor}, luxels, mir::span_of(list), sight, shading);
}

/// Largest difference of a channel, over the largest channel.
double difference(const mir::Image<mir::Rgb>& a, const mir::Image<mir::Rgb>& b) {
    double most = 0.0;
    double largest = 0.0;
    for (std::size_t i = 0; i < a.pixels().size(); ++i) {
        const mir::Rgb d = a.pixels()[i] - b.pixels()[i];
        most =
            std::max({most, std::abs(double{d.r}), std::abs(double{d.g}), std::abs(double{d.b})});
        largest = std::max(largest, double{max_channel(a.pixels()[i])});
    }
    return most / largest;
}

/// Image of which luxel (x, y) is luxel from(x, y) of the stage, in tiles of `tile`.
template <class From>
GBuffer copied(mir::Extent extent, mir::Extent tile, const From& from) {
    GBuffer copy(extent, tile);
    const auto source = stage().gbuffer().view(0);
    const auto at = mir::BlockedLayout::of(stage().gbuffer().tiles()[0]);
    for (mir::TileIndex t = 0; t < copy.tiles().size(); ++t) {
        const mir::Tile part = copy.tiles()[t];
        const auto layout = mir::BlockedLayout::of(part);
        for (std::uint32_t y = 0; y < part.height; ++y)
            for (std::uint32_t x = 0; x < part.width; ++x) {
                const auto [u, v] = from(part.x + x, part.y + y);
                copy.store(t, layout(x, y), source.hit(at(u, v)), source.surface(at(u, v)));
            }
    }
    return copy;
}
using Place = std::pair<std::uint32_t, std::uint32_t>;

/// The image with every luxel twice, side by side.
GBuffer doubled() {
    return copied({2 * side, side}, {32, 16}, [](auto x, auto y) { return Place{x / 2, y}; });
}

std::vector<mir::ImageResponse> responses(const GBuffer& luxels) {
    const Vpls list = vpls();
    mir::InlineExecutor executor;
    mir::VisibilityMatrix bits(luxels.tiles(), static_cast<std::uint32_t>(list.size()));
    fill_visibility(bits, luxels, mir::span_of(list), stage().visibility(), executor);
    return response(luxels, mir::span_of(list), bits, shading, executor);
}

}  // namespace

TEST_CASE("the order of VPLs changes an image by rounding alone, lost VPLs by more") {
    const bool tuned = GENERATE(true, false);
    Vpls list = vpls();
    const auto wanted = image(stage().gbuffer(), list, tuned);
    std::reverse(list.begin(), list.end());
    CHECK(difference(wanted, image(stage().gbuffer(), list, tuned)) < 1e-6);
    list.resize(list.size() / 2);
    CHECK(difference(wanted, image(stage().gbuffer(), list, tuned)) > 1e-3);
}

TEST_CASE("luxels that change places and come twice get the same light, in every bit") {
    const bool tuned = GENERATE(true, false);
    const auto wanted = image(stage().gbuffer(), vpls(), tuned);
    const auto twice = image(doubled(), vpls(), tuned);
    const auto turned = image(copied({side, side}, {16, 32},
                                     [](auto x, auto y) {
                                         return Place{y, side - 1 - x};
                                     }),
                              vpls(), tuned);
    std::size_t wrong = 0;
    for (std::uint32_t y = 0; y < side; ++y)
        for (std::uint32_t x = 0; x < side; ++x) {
            const auto bits = mirtest::bits_of(wanted(x, y));
            wrong += mirtest::bits_of(twice(2 * x, y)) == bits ? 0u : 1u;
            wrong += mirtest::bits_of(twice(2 * x + 1, y)) == bits ? 0u : 1u;
            wrong += mirtest::bits_of(turned(side - 1 - y, x)) == bits ? 0u : 1u;
        }
    CHECK(wrong == 0);
}

TEST_CASE("luxels that come twice do not change the mean response of the image") {
    const auto once = responses(stage().gbuffer());
    const auto twice = responses(doubled());
    double sum = 0.0;
    for (std::size_t j = 0; j < once.size(); ++j) {
        CHECK(twice[j].g == mirtest::Approx(once[j].g).epsilon(1e-6));
        CHECK(twice[j].lit_luxels == 2 * once[j].lit_luxels);
        sum += once[j].g;
    }
    CHECK(sum > 0.0);
}
