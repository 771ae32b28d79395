// SPDX-License-Identifier: MIT
//
// Intensities divide by responses that are means over M luxels. A quotient of means is biased, and
// the bias must vanish as 1/M, whichever luxels there are.
#include "mir/normalise/normalise.hpp"
#include "mir/shading/vpl_shading.hpp"
#include "normalise/lit_box.hpp"
#include "support/catch.hpp"
#include "support/free_sight.hpp"
#include "support/statistics.hpp"

#include <cmath>

namespace {

using mir::Lambert;
using mir::LuxelIndex;
using mir::VplIndex;
using mirtest::Approx;
using Responses = std::vector<mir::ImageResponse>;
using GBuffer = mir::BlockedGBuffer<Lambert::Params>;

const mir::VplShading<Lambert> shading{0.5f};

/// The box whose luxels are all there could be; one tile, so that blocked indices name them.
using Box = mirtest::LitBox<Lambert>;
constexpr mir::Extent all{64, 48};

/// Luxels drawn from all of the box, one by one, as an image.
class Drawn {
 public:
    /// `luxels` must be a multiple of 64: blocked indices of an image 16 wide have no gaps then.
    Drawn(const Box& box, std::uint32_t luxels, mir::Random& random)
        : box_(box), from_(luxels), gbuffer_({16, luxels / 16}, {16, luxels / 16}) {
        const auto view = box.gbuffer.view(0);
        for (std::uint32_t i = 0; i < luxels; ++i) {
            from_[i] = static_cast<LuxelIndex>(random.next() * static_cast<float>(view.size()));
            gbuffer_.store(0, i, view.hit(from_[i]), view.surface(from_[i]));
        }
    }

    /// Responses to the light that luxels of the box get for which `sees(luxel, VPL)`.
    template <class Sees>
    [[nodiscard]] Responses responses(const Sees& sees) const {
        mir::VisibilityMatrix matrix(gbuffer_.tiles(), box_.vpls.size());
        for (VplIndex j = 0; j < box_.vpls.size(); ++j)
            for (std::uint32_t group = 0; group < from_.size() / 16; ++group) {
                std::uint32_t mask = 0;
                for (std::uint32_t k = 0; k < 16; ++k)
                    mask |= sees(from_[16 * group + k], j) ? 1u << k : 0u;
                matrix.store(0, group, j, mask);
            }
        mir::InlineExecutor executor;
        return response(gbuffer_, box_.vpls.span(), matrix, shading, executor);
    }

 private:
    const Box& box_;
    std::vector<LuxelIndex> from_;
    GBuffer gbuffer_;
};

/// Where the light of an experiment is looked at.
enum class Light {
    of_drawn_luxels,  ///< policy full: the luxels that the responses are means over
    of_all_luxels     ///< policy prepass: all luxels, the drawn ones are probes
};

/// Light that each VPL of the box sends to luxels within a metre of it, which are the bright ones,
/// after normalisation by drawn luxels. VPLs that few luxels see obey other laws and do not count.
class Experiment {
 public:
    explicit Experiment(Light where) : where_(where) {
        mir::InlineExecutor executor;
        mir::VisibilityMatrix close(box_.gbuffer.tiles(), box_.vpls.size());
        for (VplIndex j = 0; j < box_.vpls.size(); ++j)
            for (LuxelIndex i = 0; i < all.area(); ++i)
                if (near(i, j))
                    close.store(0, i / 16, j, close.view().mask(0, i / 16, j) | 1u << i % 16);
        whole_ = response(box_.gbuffer, box_.vpls.span(), box_.matrix, shading, executor);
        part_ = response(box_.gbuffer, box_.vpls.span(), close, shading, executor);
    }

    [[nodiscard]] const Box& box() const { return box_; }

    /// Error of the light with the responses `rule(drawn, right responses)`, over its true value:
    /// `count` draws of `luxels`, seeds from 0 on. What is linear in the means has no expectation
    /// and is taken off: it would drown the bias.
    template <class Rule>
    [[nodiscard]] mirtest::Moments bias(std::uint32_t luxels, std::uint64_t count,
                                        const Rule& rule) const {
        const double truth = light(part_, whole_);
        mirtest::Moments m;
        for (std::uint64_t seed = 0; seed < count; ++seed) {
            mir::Random random(seed, mir::Stream::test, luxels);
            const Drawn drawn(box_, luxels, random);
            const Responses total =
                drawn.responses([&](LuxelIndex i, VplIndex j) { return seen(i, j); });
            const Responses part =
                where_ == Light::of_all_luxels
                    ? part_
                    : drawn.responses([&](LuxelIndex i, VplIndex j) { return near(i, j); });
            m.add((light(part, rule(drawn, total)) - truth - linear(part, total)) / truth);
        }
        return m;
    }

 private:
    [[nodiscard]] bool seen(LuxelIndex i, VplIndex j) const {
        return box_.matrix.view().sees(0, i, j);
    }
    [[nodiscard]] bool near(LuxelIndex i, VplIndex j) const {
        const mir::Vec3 d = box_.gbuffer.view(0).hit(i).position - box_.vpls.vpls()[j].position;
        return seen(i, j) && mir::length_squared(d) < 1.0f;
    }
    [[nodiscard]] bool counts(VplIndex j) const { return whole_[j].lit_luxels > all.area() / 4; }

    [[nodiscard]] double light(const Responses& part, const Responses& divisors) const {
        mir::VplList list = box_.vpls;
        normalise(list, divisors, mirtest::RandomRecords::path_luminance, box_.records.states);
        double sum = 0.0;
        for (VplIndex j = 0; j < list.size(); ++j)
            if (counts(j)) sum += image_luminance(part[j], list.vpls()[j].intensity);
        return sum;
    }

    /// First derivative of light() at the true means, times what the means are off.
    [[nodiscard]] double linear(const Responses& part, const Responses& total) const {
        double sum = 0.0;
        for (const mir::PathVpl& p : box_.vpls.path_vpls()) {
            if (!counts(p.vpl)) continue;
            const double s = image_luminance(whole_[p.vpl], p.intensity);
            const double a = image_luminance(part_[p.vpl], p.intensity);
            const double s_off = image_luminance(total[p.vpl], p.intensity) - s;
            const double a_off = image_luminance(part[p.vpl], p.intensity) - a;
            sum += static_cast<double>(p.weight) * (a_off / s - a * s_off / (s * s));
        }
        return sum * mirtest::RandomRecords::path_luminance / box_.records.states;
    }

    Light where_;
    Box box_{all, all, 12};
    Responses whole_;  ///< to all light
    Responses part_;   ///< to the light within a metre
};

/// Slope of log |bias| against log M by least squares, over `count` draws of each M.
template <class Rule>
double slope(const Experiment& e, std::uint64_t count, const Rule& rule) {
    mirtest::Moments x;
    mirtest::Moments y;
    double products = 0.0;
    for (const std::uint32_t luxels : {64u, 128u, 256u, 512u}) {
        const double log_m = std::log(static_cast<double>(luxels));
        const double log_bias = std::log(std::abs(e.bias(luxels, count, rule).mean()));
        x.add(log_m);
        y.add(log_bias);
        products += log_m * log_bias;
    }
    return (products - 4.0 * x.mean() * y.mean()) / (3.0 * x.variance());
}

Responses right(const Drawn& /*drawn*/, const Responses& total) { return total; }

}  // namespace

// H0: the bias is c / M + O(1 / M^2), for the light of the luxels that were drawn and for that of
// others. Criterion: slope -1 +- 0.15, whose standard error over 4000 draws of each M, seeds from 0
// on, is 0.05.
TEST_CASE("the bias of normalised light falls as one over the number of luxels", "[statistical]") {
    const Light where = GENERATE(Light::of_drawn_luxels, Light::of_all_luxels);
    CHECK(slope(Experiment(where), 4000, right) == Approx(-1.0).margin(0.15));
}

TEST_CASE("a bias that more luxels do not lessen is noticed", "[statistical]") {
    const Experiment e(GENERATE(Light::of_drawn_luxels, Light::of_all_luxels));
    SECTION("responses without shadows") {
        const auto open = e.box().visibility(e.box().gbuffer, mirtest::FreeSight{});
        const auto unshadowed = [&](const Drawn& drawn, const Responses& /*total*/) {
            return drawn.responses(
                [&](LuxelIndex i, VplIndex j) { return open.view().sees(0, i, j); });
        };
        CHECK(slope(e, 500, unshadowed) > -0.5);
    }
    SECTION("always the same 64 luxels") {
        mir::Random random(1, mir::Stream::test, 1);
        Responses same = Drawn(e.box(), 64, random).responses([&](LuxelIndex i, VplIndex j) {
            return e.box().matrix.view().sees(0, i, j);
        });
        CHECK(slope(e, 500, [&](const Drawn&, const Responses&) { return same; }) > -0.5);
    }
}
