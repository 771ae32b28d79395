// SPDX-License-Identifier: MIT
#include "mir/kernels/word_shading.hpp"

#include "conformance/worlds.hpp"
#include "mir/data/visibility_words.hpp"
#include "mir/data/vpl_list.hpp"
#include "mir/shading/lambert.hpp"
#include "mir/shading/vpl_shading.hpp"
#include "support/catch.hpp"
#include "support/soa_run.hpp"

#include <bit>
#include <cmath>
#include <limits>

// Light of words of visibility, bit for bit that of a loop over the VPLs of every luxel.

namespace {

using mir::Hit;
using mir::LuxelIndex;
using mir::Rgb;
using mir::Vec3;
using mir::Vpl;
using LambertSurface = mir::Surface<mir::Lambert::Params>;

/// Luxels in plain arrays.
struct PlainLuxels {
    static constexpr mir::Space space = mir::Space::host;
    using Surface = LambertSurface;

    const Hit* hits = nullptr;
    const Surface* surfaces = nullptr;
    std::uint32_t count = 0;

    [[nodiscard]] std::uint32_t size() const { return count; }
    [[nodiscard]] Hit hit(LuxelIndex i) const { return hits[i]; }
    [[nodiscard]] Surface surface(LuxelIndex i) const { return surfaces[i]; }
};
static_assert(mir::GBuffer<PlainLuxels>);

/// No number for VPLs above a luxel, which no bit says are seen here. Asked unprepared.
struct NoNumberAbove {
    using Surface = LambertSurface;
    [[nodiscard]] Rgb operator()(const Hit& hit, const Surface&, const Vpl& vpl) const {
        const float none = std::numeric_limits<float>::quiet_NaN();
        return is_above(hit, vpl) ? Rgb{none, none, none} : vpl.intensity;
    }
    [[nodiscard]] static bool is_above(const Hit& hit, const Vpl& vpl) {
        return vpl.position.z > hit.position.z;
    }
};

/// Luxels and VPLs whose light differs so much that every order of a sum shows.
class LitLuxels {
 public:
    LitLuxels(std::uint32_t luxels, std::uint32_t vpls, std::uint64_t seed)
        : random_(mirtest::test_random(seed)) {
        for (std::uint32_t i = 0; i < luxels; ++i) {
            const Vec3 normal = mirtest::direction(random_);
            hits_.push_back({mirtest::point_in_cube(random_), normal});
            surfaces_.push_back({normal, normal, {}, {{random_.next(), random_.next(), 0.5f}}});
        }
        for (std::uint32_t j = 0; j < vpls; ++j) {
            const float light = std::pow(10.0f, 6.0f * random_.next() - 3.0f);
            vpls_.push_back({mirtest::point_in_cube(random_),
                             mirtest::direction(random_),
                             {light, 0.3f * light, 0.7f * light * random_.next()}});
        }
    }

    /// Words of which some have no bit, and the others that share of those that may be.
    template <class MaySee>
    void draw_words(float share, const MaySee& may_see) {
        words_.assign(mir::VisibilityWords<mir::Space::host>::count(size(), vpl_count()), 0u);
        for (std::size_t w = 0; w < words_.size(); ++w) {
            if (random_.next() < 0.3f) continue;
            for (std::uint32_t k = 0; k < 32; ++k) {
                const Hit& hit = hits_[w / vpl_count() * 32 + k];
                const bool is_lit = random_.next() < share && may_see(hit, vpls_[w % vpl_count()]);
                words_[w] |= is_lit ? 1u << k : 0u;
            }
        }
    }
    void draw_words(float share) {
        draw_words(share, [](const Hit&, const Vpl&) { return true; });
    }

    template <class F>
    [[nodiscard]] std::vector<Rgb> by_words(const F& shade) const {
        const mirtest::SoaRun<Rgb> before(std::vector<Rgb>(size(), Rgb{7, 7, 7}));
        std::vector<std::uint32_t> planes(before.view().planes,
                                          before.view().planes + std::size_t{3} * size());
        const mir::SoaView<Rgb> radiance{planes.data(), size()};
        const mir::WordShading kernel{PlainLuxels{hits_.data(), surfaces_.data(), size()},
                                      mir::span_of(vpls_), words_.data(), shade, radiance};
        typename decltype(kernel)::Workspace space;
        for (std::uint32_t at = 0; at < 32; ++at)
            space.vpls.keep({}, ~0u, 0, at);  // as if left by a group before
        for (std::uint32_t i = 0; i < size() / 32; ++i) kernel(mir::LaneGroup{}, i, space);
        std::vector<Rgb> found;
        for (std::uint32_t i = 0; i < size(); ++i) found.push_back(radiance.load(i));
        return found;
    }

    template <class F>
    [[nodiscard]] std::vector<Rgb> one_by_one(const F& shade) const {
        const mir::VisibilityWords<mir::Space::host> seen{words_.data(), vpl_count()};
        std::vector<Rgb> sums(size());
        for (std::uint32_t i = 0; i < size(); ++i)
            for (std::uint32_t j = 0; j < vpl_count(); ++j)
                if (seen.sees(i, j)) sums[i] += shade(hits_[i], surfaces_[i], vpls_[j]);
        return sums;
    }

    [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(hits_.size()); }
    [[nodiscard]] std::uint32_t vpl_count() const {
        return static_cast<std::uint32_t>(vpls_.size());
    }

 private:
    mir::Random random_;
    std::vector<Hit> hits_;
    std::vector<LambertSurface> surfaces_;
    std::vector<Vpl> vpls_;
    std::vector<std::uint32_t> words_;
};

std::size_t luxels_that_differ(const std::vector<Rgb>& a, const std::vector<Rgb>& b) {
    REQUIRE(a.size() == b.size());
    const auto bits = [](float x) { return std::bit_cast<std::uint32_t>(x); };
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        wrong += bits(a[i].r) == bits(b[i].r) && bits(a[i].g) == bits(b[i].g) &&
                         bits(a[i].b) == bits(b[i].b)
                     ? 0
                     : 1;
    return wrong;
}

}  // namespace

TEST_CASE("Light of words is the sum over the VPLs of set bits, in their order") {
    const std::uint32_t vpls = GENERATE(0u, 1u, 31u, 32u, 33u, 64u, 200u);
    LitLuxels lit(256, vpls, 40 + vpls);
    for (const float share : {0.0f, 0.02f, 0.5f, 1.0f}) {
        CAPTURE(vpls, share);
        lit.draw_words(share);
        const mir::VplShading<mir::Lambert> shade{2.0f};
        const std::vector<Rgb> truth = lit.one_by_one(shade);
        CHECK(luxels_that_differ(lit.by_words(shade), truth) == 0);
        const std::vector<Rgb> black(lit.size());
        if (share == 0.0f) CHECK(luxels_that_differ(truth, black) == 0);
        if (share > 0.1f && vpls > 30) CHECK(luxels_that_differ(truth, black) > 100);
    }
}

TEST_CASE("What shading says of pairs without a bit is thrown away") {
    LitLuxels lit(256, 100, 39);
    lit.draw_words(
        0.7f, [](const Hit& hit, const Vpl& vpl) { return !NoNumberAbove::is_above(hit, vpl); });
    const std::vector<Rgb> found = lit.by_words(NoNumberAbove{});
    CHECK(luxels_that_differ(found, lit.one_by_one(NoNumberAbove{})) == 0);
    for (const Rgb& c : found) REQUIRE(c == c);
}
