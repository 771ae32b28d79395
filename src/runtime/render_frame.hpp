// SPDX-License-Identifier: MIT
#pragma once

#include "mir/data/image.hpp"
#include "mir/data/vpl_record.hpp"
#include "mir/metropolis/metropolis_options.hpp"
#include "mir/runtime/any_engine.hpp"
#include "mir/sampling/caustic_paths.hpp"
#include "mir/sampling/light_path_options.hpp"
#include "mir/sampling/probe_rays.hpp"
#include "mir/shading/direct_samples.hpp"
#include "runtime/band_turn.hpp"
#include "runtime/cut_vpls.hpp"
#include "runtime/frame_features.hpp"
#include "runtime/render_job.hpp"
#include "runtime/vpl_kernel.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace mir {

class ResponseSum;

/// Rows of luxels, where their frame keeps them.
class FrameBand {
 public:
    FrameBand() = default;
    FrameBand(const FrameBand&) = delete;
    FrameBand& operator=(const FrameBand&) = delete;
    virtual ~FrameBand() = default;

    /// Luxels of the band, without padding.
    [[nodiscard]] virtual Extent extent() const = 0;
    /// True after RenderFrame::find_visible().
    [[nodiscard]] virtual bool knows_visibility() const = 0;

    std::uint32_t first_row = 0;  ///< of luxels, in the whole image
};

/// Radiance towards the viewer of the luxels of a band, W m^-2 sr^-1.
class FrameLayer {
 public:
    FrameLayer() = default;
    FrameLayer(const FrameLayer&) = delete;
    FrameLayer& operator=(const FrameLayer&) = delete;
    virtual ~FrameLayer() = default;
};

using BandPtr = std::unique_ptr<FrameBand>;    ///< never null
using LayerPtr = std::unique_ptr<FrameLayer>;  ///< never null

/// Caustics of the luxels of a band.
struct CausticLayers {
    LayerPtr direct;    ///< light of one bounce
    LayerPtr indirect;  ///< that of more
};

/// What a render needs to know of a kind of frame.
struct FrameTraits {
    std::size_t luxel_bytes;  ///< of a luxel with its surface
    bool on_host;             ///< rays() and luxels cost the host nothing beyond their use
    std::uint32_t parts = 1;  ///< frames that work at the same time in for_each_band()
};

/// The machine that makes a picture, asked band by band. A virtual call costs nothing where it is
/// for a million luxels. HostFrame works in the host's memory, BackendFrame in that of a Backend.
/// Bands and layers go back to the frame that made them. Sums and their order are those of the free
/// functions of the same names, so that frames give the same bits. One thread at a time; the job
/// must outlive it.
class RenderFrame {
 public:
    RenderFrame(RenderJob& job, FrameTraits traits) : job_(job), traits_(traits) {}
    RenderFrame(const RenderFrame&) = delete;
    RenderFrame& operator=(const RenderFrame&) = delete;
    virtual ~RenderFrame() = default;

    /// What is rendered, and the result as it grows.
    [[nodiscard]] RenderJob& job() const { return job_; }
    /// Of its kind.
    [[nodiscard]] const FrameTraits& traits() const { return traits_; }

    /// Rays of the host; valid as long as the frame. May build what they go through.
    [[nodiscard]] virtual const AnyEngine& rays() = 0;
    /// Area of the surfaces that the camera sees, m^2.
    [[nodiscard]] virtual double visible_area() = 0;
    /// The records of MetropolisSampler under `bound` (PathWorld::bound).
    /// @throws Error(invalid_argument) for options out of range; Error(cancelled).
    [[nodiscard]] virtual VplRecords sample_chains(const MetropolisOptions& options,
                                                   float bound) = 0;

    /// The records of InstantRadiositySampler.
    /// @throws Error(invalid_argument) for options out of range; Error(cancelled);
    /// Error(unsupported) for arrivals, of frames without FrameFeature::lobes.
    [[nodiscard]] virtual VplRecords sample_light_paths(const InstantRadiosityOptions& options) = 0;
    /// What such records say of P_c under `bound`: light_path_luminance() by path_probe().
    [[nodiscard]] virtual PathLuminance light_path_luminance(const VplRecords& sampled,
                                                             float bound) = 0;

    /// What light paths from `begin` to before `end` throw on luxels off mirrors and through
    /// glass: trace_caustics(). Something must shine.
    [[nodiscard]] virtual std::vector<CausticSplat> trace_caustics(const CausticPaths& paths,
                                                                   std::uint64_t begin,
                                                                   std::uint64_t end) = 0;

    /// Calls work(by, i, turn) for all i < bands. `by` is a frame that this one is made of: here
    /// itself, from top to bottom. A band goes to the same frame in every loop over so many.
    /// @throws What the work throws, of one band if it fails for several.
    virtual void for_each_band(std::uint32_t bands, const BandWork& work) {
        BandTurn turn;
        for (std::uint32_t i = 0; i < bands; ++i) work(*this, i, turn);
    }

    /// Traces the camera rays of a band of `extent` luxels in tiles of `tile`.
    [[nodiscard]] virtual BandPtr trace(Extent extent, Extent tile, std::uint32_t first_row) = 0;
    /// The luxels of some probes, as a band.
    [[nodiscard]] virtual BandPtr trace(const ProbeRays& probes) = 0;
    /// Keeps with a band which luxels and VPLs see each other.
    /// @throws Error(limit_exceeded) when the bits do not fit into Limits::visibility_bytes.
    virtual void find_visible(FrameBand& band, VplSpan<Space::host> vpls) = 0;
    /// Adds responses of points under `bound`. Those of a band that knows their visibility, to a
    /// sum of the bands above. Waits for its turn when its rows are summed.
    virtual void add_responses(const FrameBand& band, VplSpan<Space::host> vpls, float bound,
                               BandTurn& turn, ResponseSum& sum) = 0;

    /// Makes a sum of responses that of all bands, also where others have added theirs elsewhere.
    /// To be called behind the loop that added to it.
    virtual void take_over(ResponseSum& /*sum*/) {}

    /// No light.
    [[nodiscard]] virtual LayerPtr black(const FrameBand& band) = 0;
    /// Next-event light from lamps and environment, and light without extent.
    [[nodiscard]] virtual LayerPtr direct(const FrameBand& band, DirectSamples samples) = 0;
    /// What the luxels themselves emit, and the environment where they see nothing else.
    [[nodiscard]] virtual LayerPtr emission(const FrameBand& band) = 0;
    /// White where luxels see a surface.
    [[nodiscard]] virtual LayerPtr coverage(const FrameBand& band) = 0;
    /// Light of VPLs: from the band's visibility where it is known, by tracing otherwise.
    /// `monitor`, which may be null, counts pairs of luxel and VPL.
    [[nodiscard]] virtual LayerPtr light(const FrameBand& band, VplSpan<Space::host> vpls,
                                         VplKernel kernel, Monitor* monitor) = 0;
    /// Light of VPLs by cuts of RenderSettings::picks, under `bound`.
    [[nodiscard]] virtual LayerPtr light_by_cuts(const FrameBand& band, const CutVpls& vpls,
                                                 float bound, Monitor* monitor) = 0;
    /// The same, and adds standard errors of its picks. Those of `variance`, a gray layer of their
    /// squares, grow by those of the light: so much they grow at most, and do where picks of
    /// several trees err together.
    /// @throws Error(unsupported) of frames without FrameFeature::pick_error.
    [[nodiscard]] virtual LayerPtr light_and_error_by_cuts(const FrameBand& /*band*/,
                                                           const CutVpls& /*vpls*/, float /*bound*/,
                                                           FrameLayer& /*variance*/,
                                                           Monitor* /*monitor*/) {
        throw without(FrameFeature::pick_error);
    }
    /// Light that `bound` kept from a band's luxels, traced back: ResidualLight. That of bounce b
    /// is added to element b - 1 of `bounces` too, where there is one.
    [[nodiscard]] virtual LayerPtr residual(const FrameBand& band, float bound,
                                            std::span<const LayerPtr> bounces) = 0;
    /// Caustics that a band's luxels see in mirrors or through bodies of glass: SeenCaustics. That
    /// of bounce b > 1 is added to element b - 1 of `bounces` too, or to the last one.
    [[nodiscard]] virtual CausticLayers seen_caustics(const FrameBand& band,
                                                      std::span<const LayerPtr> bounces) = 0;
    /// A layer of these radiances of a band's luxels, W m^-2 sr^-1.
    [[nodiscard]] virtual LayerPtr layer_of(const FrameBand& band, Image<Rgb> light) = 0;
    /// sum += layer.
    virtual void add(FrameLayer& sum, const FrameLayer& layer) = 0;
    /// Sum of the luminance of each row's luxels, from left to right, W m^-2 sr^-1.
    [[nodiscard]] virtual std::vector<double> row_luminances(const FrameLayer& layer) = 0;

    /// Keeps the radii of the spheres around the VPLs to come, metres, by their index.
    /// @throws Error(unsupported) of frames without FrameFeature::spheres.
    virtual void keep_radii(std::vector<float>&& /*radii*/) {
        throw without(FrameFeature::spheres);
    }
    /// Keeps the lobes of the VPLs that aggregate() makes of records; returns
    /// VplLobes::widened_share.
    /// @throws Error(unsupported) of frames without FrameFeature::lobes.
    virtual float keep_lobes(const VplRecords& /*records*/) { throw without(FrameFeature::lobes); }
    /// Puts a band's layers on the film and its guides into the result. Layers come in the order of
    /// FilmLayer. Bands come from top to bottom, none higher than the first, in their `turn`. Its
    /// seam, if it has one, is where the film of the rows above ended, which may be another
    /// frame's, and becomes where this one ends. The turn is passed on then.
    virtual void put(const FrameBand& band, std::vector<LayerPtr> layers, BandTurn& turn) = 0;
    /// The images of the layers, once every band was put there; leaves the frame without. Pixels
    /// that films of other frames develop mean nothing.
    [[nodiscard]] virtual std::vector<Image<Rgb>> develop() = 0;
    /// Makes rows of pixels of such images, from `first` up to `end`, as far as bands were put.
    /// Makes the images where there are none. The frame goes on.
    virtual void develop_rows(std::uint32_t first, std::uint32_t end,
                              std::vector<Image<Rgb>>& images) = 0;

 private:
    RenderJob& job_;
    FrameTraits traits_;
};

}  // namespace mir
