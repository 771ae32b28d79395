// SPDX-License-Identifier: MIT
#pragma once

#include "runtime/render_frame.hpp"

#include <memory>
#include <vector>

namespace mir {

/// A frame made of parts that work at the same time. They are frames for bands of one image, each
/// with a thread of its own: all GPUs of a machine, say. Pictures have the bytes of one frame,
/// whatever their number and speed. Each part has the whole scene; film rows are handed from part
/// to part from top to bottom (FilmSeam), and so is all else that is added up. What is no band is
/// made by the first part, to which bands and layers go that were made outside for_each_band().
class SplitFrame final : public RenderFrame {
 public:
    /// Parts that make the same bits of `job`; at least one.
    SplitFrame(RenderJob& job, std::vector<std::unique_ptr<RenderFrame>> parts);

    [[nodiscard]] const AnyEngine& rays() override { return first().rays(); }
    [[nodiscard]] double visible_area() override { return first().visible_area(); }
    [[nodiscard]] VplRecords sample_chains(const MetropolisOptions& options, float bound) override {
        return first().sample_chains(options, bound);
    }

    [[nodiscard]] VplRecords sample_light_paths(const InstantRadiosityOptions& options) override {
        return first().sample_light_paths(options);
    }
    [[nodiscard]] PathLuminance light_path_luminance(const VplRecords& sampled,
                                                     float bound) override {
        return first().light_path_luminance(sampled, bound);
    }

    [[nodiscard]] std::vector<CausticSplat> trace_caustics(const CausticPaths& paths,
                                                           std::uint64_t begin,
                                                           std::uint64_t end) override {
        return first().trace_caustics(paths, begin, end);
    }

    /// Deals bands to the parts and waits for all. In the first loop they go to whoever is free.
    /// Those of the first part are made by the calling thread.
    void for_each_band(std::uint32_t bands, const BandWork& work) override;

    [[nodiscard]] BandPtr trace(Extent extent, Extent tile, std::uint32_t first_row) override {
        return first().trace(extent, tile, first_row);
    }
    [[nodiscard]] BandPtr trace(const ProbeRays& probes) override { return first().trace(probes); }
    void find_visible(FrameBand& band, VplSpan<Space::host> vpls) override {
        first().find_visible(band, vpls);
    }
    void add_responses(const FrameBand& band, VplSpan<Space::host> vpls, float bound,
                       BandTurn& turn, ResponseSum& sum) override {
        first().add_responses(band, vpls, bound, turn, sum);
    }

    [[nodiscard]] LayerPtr black(const FrameBand& band) override { return first().black(band); }
    [[nodiscard]] LayerPtr direct(const FrameBand& band, DirectSamples samples) override {
        return first().direct(band, samples);
    }
    [[nodiscard]] LayerPtr emission(const FrameBand& band) override {
        return first().emission(band);
    }
    [[nodiscard]] LayerPtr coverage(const FrameBand& band) override {
        return first().coverage(band);
    }
    [[nodiscard]] LayerPtr light(const FrameBand& band, VplSpan<Space::host> vpls, VplKernel kernel,
                                 Monitor* monitor) override {
        return first().light(band, vpls, kernel, monitor);
    }
    [[nodiscard]] LayerPtr light_by_cuts(const FrameBand& band, const CutVpls& vpls, float bound,
                                         Monitor* monitor) override {
        return first().light_by_cuts(band, vpls, bound, monitor);
    }
    [[nodiscard]] LayerPtr light_and_error_by_cuts(const FrameBand& band, const CutVpls& vpls,
                                                   float bound, FrameLayer& variance,
                                                   Monitor* monitor) override {
        return first().light_and_error_by_cuts(band, vpls, bound, variance, monitor);
    }
    [[nodiscard]] LayerPtr residual(const FrameBand& band, float bound,
                                    std::span<const LayerPtr> bounces) override {
        return first().residual(band, bound, bounces);
    }
    [[nodiscard]] CausticLayers seen_caustics(const FrameBand& band,
                                              std::span<const LayerPtr> bounces) override {
        return first().seen_caustics(band, bounces);
    }
    [[nodiscard]] LayerPtr layer_of(const FrameBand& band, Image<Rgb> light) override {
        return first().layer_of(band, std::move(light));
    }
    void add(FrameLayer& sum, const FrameLayer& layer) override { first().add(sum, layer); }
    [[nodiscard]] std::vector<double> row_luminances(const FrameLayer& layer) override {
        return first().row_luminances(layer);
    }

    void keep_radii(std::vector<float>&& radii) override;
    float keep_lobes(const VplRecords& records) override;

    /// Of a band of the first part, when that puts all of them.
    void put(const FrameBand& band, std::vector<LayerPtr> layers, BandTurn& turn) override {
        first().put(band, std::move(layers), turn);
    }
    [[nodiscard]] std::vector<Image<Rgb>> develop() override;
    void develop_rows(std::uint32_t first, std::uint32_t end,
                      std::vector<Image<Rgb>>& images) override;

 private:
    class Turn;
    /// Rows of pixels that the film of a part developed.
    struct Rows {
        std::size_t part;
        std::uint32_t begin;
        std::uint32_t end;
    };

    [[nodiscard]] RenderFrame& first() const { return *parts_.front(); }

    std::vector<std::unique_ptr<RenderFrame>> parts_;
    std::vector<std::size_t> owners_;  ///< parts, by the bands of the last loop
    FilmSeam seam_;                    ///< below the last band that was put
    std::vector<Rows> developed_;      ///< from top to bottom
};

}  // namespace mir
