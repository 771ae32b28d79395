// SPDX-License-Identifier: MIT
#pragma once

#include "mir/concepts/archetypes.hpp"
#include "mir/core/number_text.hpp"
#include "mir/place_vpls.hpp"
#include "mir/reconstruct.hpp"
#include "mir/sched/cpu.hpp"
#include "mir/shading/vpl_shading.hpp"
#include "mir/validation/detail/moments.hpp"
#include "mir/validation/detail/worse.hpp"
#include "mir/validation/known_light.hpp"
#include "mir/validation/report.hpp"

#include <array>
#include <string>

namespace mir::validation::detail {

/// Records that were sampled before, as a sampler.
template <Normalisation N>
struct Replay {
    static constexpr Normalisation normalisation = N;

    const VplRecords& records;

    template <Executor E>
    [[nodiscard]] VplRecords sample(E&) const {
        return records;
    }
};

/// Mean radiance of an image and of its quarters, by channel, over seeds.
class QuarterMeans {
 public:
    void add(const Image<Rgb>& image) {
        const std::uint32_t width = image.extent().width / 2;
        const std::uint32_t height = image.extent().height / 2;
        std::array<double, 3> whole{};
        for (std::uint32_t q = 0; q < 4; ++q) {
            const Tile quarter{q % 2 * width, q / 2 * height, width, height};
            const std::array<double, 3> mean = mean_of(image, quarter);
            for (std::size_t c = 0; c < 3; ++c) {
                moments_[q][c].add(mean[c]);
                whole[c] += 0.25 * mean[c];
            }
        }
        for (std::size_t c = 0; c < 3; ++c) moments_[4][c].add(whole[c]);
    }

    /// Notes the part that is farthest from `expected`.
    void judge(const std::string& axiom, Rgb expected, Report& report) const {
        const std::array<double, 3> wanted = channels(expected);
        double worst = 0.0;
        std::string found;
        for (std::size_t part = 0; part < moments_.size(); ++part)
            for (std::size_t c = 0; c < 3; ++c) {
                const Moments& m = moments_[part][c];
                const double off = deviation(m, wanted[c], 1e-3 * wanted[c]);
                if (off <= worst || worst != worst) continue;
                worst = off;
                found = number_text(m.mean()) + " instead of " + number_text(wanted[c]) +
                        " W m^-2 sr^-1 in channel " + std::to_string(c) + " of " +
                        (part < 4 ? "quarter " + std::to_string(part) : "the image") +
                        ", standard error " + number_text(m.standard_error());
            }
        report.expect(worst < 4.89, axiom, found);
    }

    /// Of the whole image, in each channel relative to `expected`; 0 where that is black.
    [[nodiscard]] double relative_error(Rgb expected) const {
        const std::array<double, 3> wanted = channels(expected);
        double error = 0.0;
        for (std::size_t c = 0; c < 3; ++c)
            if (wanted[c] > 0.0) error = worse(error, moments_[4][c].standard_error() / wanted[c]);
        return error;
    }

 private:
    static std::array<double, 3> channels(Rgb c) {
        return {static_cast<double>(c.r), static_cast<double>(c.g), static_cast<double>(c.b)};
    }
    static std::array<double, 3> mean_of(const Image<Rgb>& image, const Tile& tile) {
        std::array<double, 3> sum{};
        const double share = 1.0 / (static_cast<double>(tile.width) * tile.height);
        for (std::uint32_t y = tile.y; y < tile.y + tile.height; ++y)
            for (std::uint32_t x = tile.x; x < tile.x + tile.width; ++x) {
                const std::array<double, 3> luxel = channels(image(x, y));
                for (std::size_t c = 0; c < 3; ++c) sum[c] += share * luxel[c];
            }
        return sum;
    }

    std::array<std::array<Moments, 3>, 5> moments_;
};

/// What the records of many seeds bring to an image of known light.
class ImageLight {
 public:
    ImageLight(const KnownLight& room, Bounces bounces) : room_(room), bounces_(bounces) {}

    /// Adds the records of one seed.
    template <Normalisation N>
    void add(const VplRecords& from) {
        InlineExecutor executor;
        const VplList vpls =
            place_vpls(Replay<N>{from}, room_.luxels(), free_sight, shading, executor).vpls;
        all_.add(image_of({vpls.vpls().begin(), vpls.vpls().end()}));
        for (std::size_t i = 0; i < judged(); ++i) single_[i].add(image_of(vpls.bounce(bounce(i))));
        has_path_luminance_ = N == Normalisation::image_response;
        path_luminance_.add(from.path_luminance);
    }

    void judge(Report& report) const {
        const Rgb all = room_.radiance(bounces_);
        const double error = all_.relative_error(all);
        report.expect(error < 0.03, "32 seeds tell the light to 3 %",
                      "the standard error is " + number_text(error) + " of it; take more VPLs");
        for (std::size_t i = 0; i < judged(); ++i)
            single_[i].judge("bounce " + std::to_string(bounce(i)) + " brings its light",
                             room_.radiance(bounce(i)), report);
        all_.judge("all bounces bring their light", all, report);
        if (!has_path_luminance_) return;
        const double wanted = static_cast<double>(luminance(all));
        report.expect(deviation(path_luminance_, wanted, 1e-3 * wanted) < 4.89,
                      "P_c is the light of all bounces",
                      number_text(path_luminance_.mean()) + " instead of " + number_text(wanted) +
                          " W m^-2 sr^-1, standard error " +
                          number_text(path_luminance_.standard_error()));
    }

 private:
    static constexpr archetype::Visibility free_sight{archetype::make};
    static constexpr VplShading<Lambert> shading{};

    [[nodiscard]] std::size_t judged() const {
        return std::min<std::size_t>(single_.size(), bounces_.last - bounces_.first + 1u);
    }
    [[nodiscard]] std::uint8_t bounce(std::size_t i) const {
        return static_cast<std::uint8_t>(bounces_.first + i);
    }
    [[nodiscard]] Image<Rgb> image_of(std::vector<Vpl> vpls) const {
        std::erase_if(vpls, [](const Vpl& v) { return is_black(v.intensity); });
        InlineExecutor executor;
        return reconstruct(sched::Cpu{executor}, room_.luxels(), span_of(vpls), free_sight,
                           shading);
    }

    const KnownLight& room_;
    Bounces bounces_;
    QuarterMeans all_;
    std::array<QuarterMeans, 3> single_;
    Moments path_luminance_;
    bool has_path_luminance_ = false;
};

}  // namespace mir::validation::detail
