// SPDX-License-Identifier: MIT
#pragma once

#include "mir/data/image_response.hpp"
#include "runtime/picture_share.hpp"
#include "runtime/render_frame.hpp"

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace mir {

/// What ends a render in a process that is not the lead, once its pixels are with that.
struct PixelsSent {};

/// A frame whose bands are shared out among the processes of a team. What is no band (chains, the
/// area that the camera sees, probes) is made in each of them. Sums over bands, and film rows
/// (FilmSeam), go from process to process in the order of the bands: pictures have the bytes of one
/// frame. The lead's frame has all pixels in the end.
class SharedFrame final : public RenderFrame {
 public:
    /// `local` makes the bits of `job` everywhere. The share must outlive it.
    SharedFrame(RenderJob& job, std::unique_ptr<RenderFrame> local, PictureShare& share);

    [[nodiscard]] const AnyEngine& rays() override { return local_->rays(); }
    [[nodiscard]] double visible_area() override { return local_->visible_area(); }
    /// Paths of the bootstrap are shared out where processors draw them; chains are not.
    [[nodiscard]] VplRecords sample_chains(const MetropolisOptions& options, float bound) override;

    [[nodiscard]] VplRecords sample_light_paths(const InstantRadiosityOptions& options) override {
        return local_->sample_light_paths(options);
    }
    [[nodiscard]] PathLuminance light_path_luminance(const VplRecords& sampled,
                                                     float bound) override {
        return local_->light_path_luminance(sampled, bound);
    }

    [[nodiscard]] std::vector<CausticSplat> trace_caustics(const CausticPaths& paths,
                                                           std::uint64_t begin,
                                                           std::uint64_t end) override {
        return local_->trace_caustics(paths, begin, end);
    }

    /// Works on bands that the lead deals, and waits for all processes.
    /// @throws PictureShare::run().
    void for_each_band(std::uint32_t bands, const BandWork& work) override;
    void take_over(ResponseSum& sum) override;

    [[nodiscard]] BandPtr trace(Extent extent, Extent tile, std::uint32_t first_row) override {
        return local_->trace(extent, tile, first_row);
    }
    [[nodiscard]] BandPtr trace(const ProbeRays& probes) override { return local_->trace(probes); }
    void find_visible(FrameBand& band, VplSpan<Space::host> vpls) override {
        local_->find_visible(band, vpls);
    }
    void add_responses(const FrameBand& band, VplSpan<Space::host> vpls, float bound,
                       BandTurn& turn, ResponseSum& sum) override;

    [[nodiscard]] LayerPtr black(const FrameBand& band) override { return local_->black(band); }
    [[nodiscard]] LayerPtr direct(const FrameBand& band, DirectSamples samples) override {
        return local_->direct(band, samples);
    }
    [[nodiscard]] LayerPtr emission(const FrameBand& band) override {
        return local_->emission(band);
    }
    [[nodiscard]] LayerPtr coverage(const FrameBand& band) override {
        return local_->coverage(band);
    }
    [[nodiscard]] LayerPtr light(const FrameBand& band, VplSpan<Space::host> vpls, VplKernel kernel,
                                 Monitor* monitor) override {
        return local_->light(band, vpls, kernel, monitor);
    }
    [[nodiscard]] LayerPtr light_by_cuts(const FrameBand& band, const CutVpls& vpls, float bound,
                                         Monitor* monitor) override {
        return local_->light_by_cuts(band, vpls, bound, monitor);
    }
    [[nodiscard]] LayerPtr light_and_error_by_cuts(const FrameBand& band, const CutVpls& vpls,
                                                   float bound, FrameLayer& variance,
                                                   Monitor* monitor) override {
        return local_->light_and_error_by_cuts(band, vpls, bound, variance, monitor);
    }
    [[nodiscard]] LayerPtr residual(const FrameBand& band, float bound,
                                    std::span<const LayerPtr> bounces) override {
        return local_->residual(band, bound, bounces);
    }
    [[nodiscard]] CausticLayers seen_caustics(const FrameBand& band,
                                              std::span<const LayerPtr> bounces) override {
        return local_->seen_caustics(band, bounces);
    }
    [[nodiscard]] LayerPtr layer_of(const FrameBand& band, Image<Rgb> light) override {
        return local_->layer_of(band, std::move(light));
    }
    void add(FrameLayer& sum, const FrameLayer& layer) override { local_->add(sum, layer); }
    [[nodiscard]] std::vector<double> row_luminances(const FrameLayer& layer) override {
        return local_->row_luminances(layer);
    }

    void keep_radii(std::vector<float>&& radii) override { local_->keep_radii(std::move(radii)); }
    float keep_lobes(const VplRecords& records) override { return local_->keep_lobes(records); }

    void put(const FrameBand& band, std::vector<LayerPtr> layers, BandTurn& turn) override;
    /// At the lead, the images of the whole picture.
    /// @throws PixelsSent in all other processes.
    [[nodiscard]] std::vector<Image<Rgb>> develop() override;
    void develop_rows(std::uint32_t first, std::uint32_t end,
                      std::vector<Image<Rgb>>& images) override {
        local_->develop_rows(first, end, images);
    }

 private:
    class Loop;
    friend class Loop;
    using Rows = std::array<std::uint32_t, 2>;  ///< of pixels: the first, and that behind the last

    void load(std::span<const std::byte> sums);
    void restate(const std::vector<RowLuminances>& luminances);
    void develop_own();
    void add_pixels(PackedBytes& message);
    void take_pixels(BytesReader& in);

    std::unique_ptr<RenderFrame> local_;
    PictureShare& share_;
    FilmSeam seam_;                    ///< below the bands that are done
    std::vector<ImageResponse> sums_;  ///< of those bands
    std::uint32_t summed_rows_ = 0;    ///< of luxels
    bool in_loop_ = false;             ///< of for_each_band()
    std::vector<Image<Rgb>> layers_;   ///< of this process; of all processes, at the lead
    std::vector<Rows> developed_;      ///< by the film of this process
    std::vector<Rows> guided_;         ///< whose guides it made
};

/// The frame itself, or shared out where the job is.
[[nodiscard]] std::unique_ptr<RenderFrame> shared_out(RenderJob& job,
                                                      std::unique_ptr<RenderFrame> frame);

}  // namespace mir
