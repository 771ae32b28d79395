// SPDX-License-Identifier: MIT
#pragma once

#include "mir/runtime/add_up_layers.hpp"
#include "mir/runtime/check_scene.hpp"
#include "mir/runtime/error_sum.hpp"
#include "mir/runtime/layer_sum.hpp"
#include "mir/runtime/luminance_spread.hpp"
#include "mir/runtime/pass_statistics.hpp"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace mir {

/// What independent renders of one scene, which differ in their seeds alone, amount to together.
/// Added in a fixed order they give the same bits whatever happens between. Takes 24 bytes for each
/// pixel and layer (direct, emission, indirect, removed, albedo, normal, bounces) and 40 more for
/// each pixel. One thread at a time.
class PassSums {
 public:
    /// Adds one more render. All have one size.
    /// @throws Error(invalid_argument) when this one has another; std::bad_alloc. Then nothing was
    ///         added.
    void add(RenderResult pass) {
        check_size(pass);
        if (passes() > 0) return add_next(pass);
        PassSums first;
        first.begin(pass);
        *this = std::move(first);
    }

    /// Renders added so far.
    [[nodiscard]] std::uint32_t passes() const { return statistics_.passes; }

    /// Those of the passes together; they do not say how far the passes differ.
    [[nodiscard]] const RenderStatistics& statistics() const { return statistics_; }

    /// LuminanceSpread::relative_error() of the mean picture. It sees what differs between passes,
    /// and no bias that they share. It is too large where pixels have one luxel, which moves evenly
    /// through them (moved_luxel()).
    [[nodiscard]] std::optional<double> relative_error() const {
        return spread_.relative_error(passes());
    }

    /// The mean picture of at least one pass. Of one pass that pass in every bit. Position and
    /// depth are those of the first pass, because a mean of two surfaces lies on neither; the VPLs
    /// are those of the last. `complete` says whether further passes were wanted.
    [[nodiscard]] RenderResult result(bool complete = true) const;

    /// Replaces the numbers by those of the same passes, at least one. For sums that were put
    /// together of parts of pictures.
    void restate(const std::vector<RenderStatistics>& passes) {
        statistics_ = passes.front();
        for (std::uint32_t i = 1; i < passes.size(); ++i) add_pass(statistics_, passes[i], i);
    }

    /// Hands all of `self` except the VPLs to `archive`. The archive reads or, unless const,
    /// replaces it.
    template <class Self, class Archive>
    static void transfer(Self& self, Archive& archive) {
        archive(self.statistics_, self.remarks_, self.position_, self.depth_, self.spread_,
                self.direct_, self.emission_, self.indirect_, self.removed_, self.coverage_,
                self.pick_error_, self.albedo_, self.normal_, self.bounces_);
    }

 private:
    void check_size(const RenderResult& pass) const {
        const Extent size = pass.beauty.extent();
        bool fits = passes() == 0 || size == position_.extent();
        for (const Image<Rgb>* layer :
             {&pass.direct, &pass.emission, &pass.indirect, &pass.guides.albedo})
            fits = fits && layer->extent() == size;
        for (const Image<Rgb>& bounce : pass.bounces) fits = fits && bounce.extent() == size;
        const auto fits_or_none = [&](const auto& layer) {
            return layer.pixels().empty() || layer.extent() == size;
        };
        expects(fits && pass.guides.normal.extent() == size && fits_or_none(pass.removed) &&
                    fits_or_none(pass.coverage) && fits_or_none(pass.pick_error),
                "a pass has another size than those before, or layers of different sizes (their "
                "mean would be none); render all passes with one size");
    }

    void begin(RenderResult& first) {
        statistics_ = first.statistics;
        position_ = std::move(first.guides.position);
        depth_ = std::move(first.guides.depth);
        std::vector<std::string> of_numbers;
        add_result_warnings(first, of_numbers);
        for (const std::string& warning : first.warnings)
            if (std::find(of_numbers.begin(), of_numbers.end(), warning) == of_numbers.end())
                remarks_.push_back(warning);
        bounces_.resize(first.bounces.size());
        removed_.add(first.removed);
        pick_error_.add(first.pick_error);
        add_layers(first, 0);
    }

    /// Takes the memory that it needs first, so that it adds all or nothing.
    void add_next(RenderResult& pass) {
        // A pass without light of a bounce adds black.
        std::vector<LayerSum<Rgb>> more;
        for (std::size_t b = bounces_.size(); b < pass.bounces.size(); ++b)
            more.emplace_back().add(Image<Rgb>(pass.beauty.extent()));
        bounces_.reserve(bounces_.size() + more.size());
        removed_.add(pass.removed);
        pick_error_.add(pass.pick_error);
        std::move(more.begin(), more.end(), std::back_inserter(bounces_));
        const std::uint32_t earlier = passes();
        add_pass(statistics_, pass.statistics, earlier);
        add_layers(pass, earlier);
    }

    void add_layers(RenderResult& pass, std::uint32_t earlier) {
        vpls_ = std::move(pass.vpls);
        direct_.add(pass.direct);
        emission_.add(pass.emission);
        indirect_.add(pass.indirect);
        coverage_.add(pass.coverage);
        albedo_.add(pass.guides.albedo);
        normal_.add(pass.guides.normal);
        for (std::size_t b = 0; b < pass.bounces.size(); ++b) bounces_[b].add(pass.bounces[b]);
        spread_.add(pass.beauty, earlier);
    }

    RenderStatistics statistics_ = no_passes();
    std::vector<std::string> remarks_;  ///< warnings that do not follow from statistics
    VplList vpls_;
    Image<Vec3> position_;
    Image<float> depth_;
    LuminanceSpread spread_;
    LayerSum<Rgb> direct_;
    LayerSum<Rgb> emission_;
    LayerSum<Rgb> indirect_;
    LayerSum<Rgb> removed_;     ///< empty where no pass has that layer
    LayerSum<float> coverage_;  ///< empty where renders leave it out
    ErrorSum pick_error_;       ///< empty where no pass has that layer
    LayerSum<Rgb> albedo_;
    LayerSum<Vec3> normal_;
    std::vector<LayerSum<Rgb>> bounces_;

    static RenderStatistics no_passes() {
        RenderStatistics none;
        none.passes = 0;
        return none;
    }
};

inline RenderResult PassSums::result(bool complete) const {
    expects(passes() > 0, "the picture of no pass was asked for (there is none); add one first");
    const std::uint32_t n = passes();
    RenderResult mean{{}, {}, {}, {}, {}, Guides({0, 0}), vpls_, statistics_, remarks_};
    mean.emission = emission_.mean(n);
    mean.direct = direct_.mean(n);
    mean.indirect = indirect_.mean(n);
    mean.removed = removed_.mean(n);
    mean.coverage = coverage_.mean(n);
    mean.pick_error = pick_error_.of_mean(n);
    for (const LayerSum<Rgb>& bounce : bounces_) mean.bounces.push_back(bounce.mean(n));
    InlineExecutor executor;
    add_up_layers(mean, executor);
    mean.guides.albedo = albedo_.mean(n);
    mean.guides.normal = normal_.mean(n);
    mean.guides.position = position_;
    mean.guides.depth = depth_;
    mean.statistics.relative_error = relative_error();
    mean.statistics.complete = complete;
    add_result_warnings(mean, mean.warnings);
    return mean;
}

}  // namespace mir
