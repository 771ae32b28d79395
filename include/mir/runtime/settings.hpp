// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/limit_values.hpp"
#include "mir/data/extent.hpp"
#include "mir/film/filter_options.hpp"
#include "mir/metropolis/metropolis_tuning.hpp"
#include "mir/micro/gather_options.hpp"
#include "mir/normalise/policy.hpp"
#include "mir/reference/light_search.hpp"
#include "mir/sampling/light_path_options.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace mir {

/// Rows of pixels of an image.
struct PixelRows {
    std::uint32_t first = 0;  ///< from the top, which is 0
    std::uint32_t count = 0;  ///< 0: all rows of the image

    /// Whether pixels of row `y` belong to them.
    [[nodiscard]] bool hold(std::uint32_t y) const {
        return count == 0 || (y >= first && y - first < count);
    }
};

/// Which machine renders.
enum class BackendKind {
    automatic,  ///< a GPU where the build and the machine have one, else the processor
    cpu,
    cuda
};

/// Which GPUs make a picture together, the same for any number of them.
struct DeviceChoice {
    bool all = false;                         ///< every one that is usable, else by number
    std::vector<std::uint32_t> numbers = {};  ///< as list_devices() counts them; none: the first
};

/// What finds out where rays end.
enum class Acceleration {
    automatic,  ///< the backend's own choice, by the number of pairs of luxel and VPL
    kd_tree,    ///< the kd-tree of this library, the same bits on every backend
    bvh,        ///< its wide bounding volume hierarchy, with shafts; the kd-tree's bits
    embree      ///< Embree, on the processor only: rays that graze an edge may end otherwise
};

/// What makes the picture.
enum class Integrator {
    vpl,   ///< virtual point lights
    path,  ///< the reference path tracer: noisy, unbiased, slow
    micro  ///< indirect light gathered from a hierarchy of discs
};

/// Of Integrator::path.
struct PathSettings {
    std::uint32_t samples = 64;            ///< camera paths per luxel
    LightSearch light = LightSearch::mis;  ///< how paths find lamps
    std::uint32_t directions = 1;          ///< paths that go on from each first hit
};

/// How luxels gather light from discs.
enum class MicroGather {
    exact,   ///< TriangleGather; on a GPU RayGather with a threshold of 0
    rays,    ///< RayGather
    buffers  ///< BufferGather
};

/// What becomes of the difference between the light of discs and that of paths.
enum class GatherCheck {
    none,     ///< it is not measured
    measure,  ///< at 2048 places of the image, however small that is
    correct   ///< and the light of discs is brought nearer (LightCorrection), where the difference
              ///< is known to 2 %
};

/// Of Integrator::micro.
struct MicroSettings {
    /// Discs wanted: their largest area is that of the scene divided by it. There are one to four
    /// times as many, and at least one for each triangle.
    std::uint32_t surfels = 16384;
    std::uint32_t surfel_rays = 32;           ///< of each side of a disc, for later bounces
    MicroGather luxels = MicroGather::exact;  ///< by what luxels gather, and discs if it is `exact`
    /// Of rays at each luxel. All but their number holds at discs too. `exact` has no threshold.
    GatherOptions gather;
    std::uint32_t buffer_side = BufferGatherOptions{}.side;  ///< texels of MicroGather::buffers
    BufferWarp buffer_warp = BufferWarp::hemisphere;         ///< of MicroGather::buffers
    GatherCheck check = GatherCheck::correct;                ///< against paths

    /// Of MicroGather::buffers, whose threshold is that of rays.
    [[nodiscard]] BufferGatherOptions buffer() const {
        return {buffer_side, gather.threshold, buffer_warp};
    }

    /// Directions in which a luxel looks.
    [[nodiscard]] std::uint32_t directions() const {
        return luxels == MicroGather::buffers ? buffer_side * buffer_side : gather.rays;
    }
};

/// Where VPLs come from.
enum class SamplerKind {
    instant_radiosity,  ///< light paths from the lamps
    bidirectional,      ///< light paths and camera paths, resampled by what the image gets
    metropolis          ///< a Markov chain over whole paths
};

/// Which VPLs a luxel gathers.
enum class LightSum {
    all,       ///< every one
    cuts,      ///< one of each node of a cut of their tree (reconstruct_cuts()); mean of all
    automatic  ///< `cuts` of more than most_vpls_summed where nothing speaks against it, else `all`
};

/// VPLs up to which LightSum::automatic sums all. A kernel for all pairs is the faster one.
inline constexpr std::uint32_t most_vpls_summed = 8192;

/// How direct light reaches the image.
enum class DirectLight {
    separate,  ///< next-event samples per luxel (default); delta lights exactly
    vpl        ///< VPLs on the lamps, as the paper does, and at infinity for an environment; delta
               ///< lights stay separate
};

/// How 1/d^2 next to a VPL is tamed.
struct BoundPolicy {
    /// How the largest geometry term is found. From the area that the camera sees and the number of
    /// VPLs (default_bound()), not at all, or by `value`.
    enum class Kind { automatic, none, fixed };
    Kind kind = Kind::automatic;  ///< how the bound is found
    float value = 0.0f;           ///< largest geometry term, m^-2, for `fixed`
};

/// Of virtual spherical lights, which are an alternative to points under a bound.
struct VslSettings {
    bool enabled = false;  ///< VPLs light the image as spheres
    std::uint32_t samples =
        8;               ///< directions from the cone of a sphere, and from the BSDF, 1..1024
    float scale = 1.0f;  ///< of the radii (vsl_radii()), more than 0
};

/// Of VPLs that keep the lobes of their surfaces.
struct GlossySettings {
    bool enabled = false;          ///< else VPLs spread what they reflect as Lambertian surfaces do
    float least_roughness = 0.5f;  ///< 0..1; smoother surfaces shine through lobes of this one

    /// The narrowest lobe, a GGX width.
    [[nodiscard]] float least_alpha() const { return least_roughness * least_roughness; }
};

/// A place in a pixel, (0, 1)^2.
struct PixelPlace {
    float x = 0.5f;  ///< from its left side
    float y = 0.5f;  ///< from its upper side
};

/// What to render and how. Plain values with working defaults; designated initialisers may change
/// some. validate() tells what is wrong.
struct RenderSettings {
    Extent image{640, 480};              ///< pixels
    std::uint32_t luxels_per_pixel = 4;  ///< 1..64
    PixelPlace only_luxel{};             ///< of the luxel of pixels that have one
    PixelRows rows{};          ///< rendered, as of the whole image; pixels of others are black
    std::uint32_t camera = 0;  ///< index into Scene::cameras
    Integrator integrator = Integrator::vpl;        ///< says which of the settings below count
    PathSettings path{};                            ///< of Integrator::path
    MicroSettings micro{};                          ///< of Integrator::micro
    std::uint32_t vpls = 1024;                      ///< wanted geometric VPLs
    LightSum sum = LightSum::automatic;             ///< of them, at each luxel
    std::uint32_t picks = 128;                      ///< most VPLs of a luxel, of cuts
    SamplerKind sampler = SamplerKind::metropolis;  ///< of Integrator::vpl
    /// Of samplers that need one. With LightSum::cuts `full` is `proposal`: the response of all
    /// luxels would meet the pairs that cuts leave out.
    NormalisationPolicy normalisation = NormalisationPolicy::full;
    std::uint32_t prepass_luxels = 4096;  ///< of policy `prepass`
    MetropolisTuning metropolis{};        ///< of SamplerKind::metropolis
    bool vpl_roulette = false;  ///< instant radiosity keeps VPLs by what they give to the image
    Termination termination = Termination::roulette;  ///< of light paths
    Sequence sequence = Sequence::random;             ///< of SamplerKind::instant_radiosity
    DirectLight direct = DirectLight::separate;       ///< how it reaches the image
    std::uint32_t direct_samples = 32;                ///< next-event samples per pixel
    /// Most scattering events, 1..254. Without a value: bounce_limit() of VPLs and discs, no limit
    /// of Integrator::path.
    std::optional<std::uint8_t> max_bounce = std::nullopt;
    BoundPolicy bound{};  ///< of the VPLs' geometry term
    /// Paths per pixel that trace back what the bound removed. They are shared out among its
    /// luxels, at least one each; 0: none, so that this light is missing.
    std::uint32_t compensate = 0;
    /// Light paths per pixel that bring what mirrors and glass throw on surfaces; 0: that is left
    /// out. Integrator::vpl alone, and only where a scene has mirrors or glass.
    std::uint32_t caustics = 4;
    /// Leaves them out where the first light paths say that these bring less than a thousandth of
    /// the picture's light. What luxels see in mirrors or through glass stays.
    bool skip_faint_caustics = false;
    VslSettings vsl{};                                     ///< a choice instead of `bound`
    GlossySettings glossy{};                               ///< else all VPLs are Lambertian
    Filter filter = default_filter(FilterKind::gaussian);  ///< from luxels to pixels
    std::uint64_t seed = 0;                                ///< of all random numbers
    unsigned threads = 0;                                  ///< 0: every core
    BackendKind backend = BackendKind::automatic;          ///< which machine renders
    DeviceChoice devices{};                                ///< of a backend with several
    Acceleration acceleration = Acceleration::automatic;   ///< what finds out where rays end
    std::string scheduler{};  ///< name in the Registry; empty: the backend's default
    /// Luxels scheduled together, rounded up to whole blocks of 16 x 16. Not larger than the image
    /// of luxels, rounded up the same way; none: the backend's choice.
    std::optional<Extent> tile{};
    bool bounce_layers = false;     ///< one image per bounce besides the sum
    bool removed_layer = false;     ///< an image of the light that the bound removed
    bool pick_error_layer = false;  ///< an image of the error of gathering few VPLs of many
    /// Paths measure what the bound removes and the largest bounce cuts. Two more per place
    /// estimate the noise of direct light, at 2048 places whatever the image. Without it the VPLs
    /// estimate what the bound removes.
    bool measure_missing = true;
    bool allow_no_light = false;  ///< a scene without light gives black, not an error
    Limits limits{};              ///< checked before memory is taken

    /// Checks every value. Of mir::runtime; check() of mir/runtime/check_settings.hpp is the same
    /// without that library.
    /// @throws Error(invalid_argument or limit_exceeded) that names the first bad value.
    void validate() const;

    /// Width / height of the image.
    [[nodiscard]] float aspect() const {
        return static_cast<float>(image.width) / static_cast<float>(image.height);
    }

    /// Largest number of scattering events of the light that VPLs or discs bring.
    [[nodiscard]] std::uint8_t bounce_limit() const { return max_bounce.value_or(32); }

    /// The policy that counts.
    [[nodiscard]] NormalisationPolicy normalisation_policy() const {
        return sum == LightSum::cuts && normalisation == NormalisationPolicy::full
                   ? NormalisationPolicy::proposal
                   : normalisation;
    }

    /// Whether luxels gather by cuts. LightSum::automatic does not where
    /// something needs all VPLs: spheres, lobes, a layer of what the bound removed, a prepass,
    /// bidirectional mutations.
    [[nodiscard]] bool wants_cuts() const {
        if (sum != LightSum::automatic) return sum == LightSum::cuts;
        const bool needs_image =
            sampler == SamplerKind::metropolis && (normalisation == NormalisationPolicy::prepass ||
                                                   metropolis.chain.mutation != Mutation::primary);
        return integrator == Integrator::vpl && vpls > most_vpls_summed && !vsl.enabled &&
               !glossy.enabled && !removed_layer && !needs_image;
    }

    /// VPLs that each luxel gathers at most.
    [[nodiscard]] std::uint32_t gathered_vpls() const {
        return wants_cuts() && picks < vpls ? picks : vpls;
    }

    /// Next-event samples of one luxel: those of the pixel shared out, at least one.
    [[nodiscard]] std::uint32_t direct_samples_per_luxel() const {
        return (direct_samples + luxels_per_pixel - 1) / luxels_per_pixel;
    }

    /// Paths of one luxel that trace back what the bound removed; 0 for none.
    [[nodiscard]] std::uint32_t compensate_per_luxel() const {
        return (compensate + luxels_per_pixel - 1) / luxels_per_pixel;
    }
};

/// Contributions of a pass: luxels of the image times VPLs that each gathers. The type does not
/// overflow.
[[nodiscard]] inline double pairs(const RenderSettings& settings) {
    return static_cast<double>(settings.image.area()) * settings.luxels_per_pixel *
           settings.gathered_vpls();
}

}  // namespace mir
