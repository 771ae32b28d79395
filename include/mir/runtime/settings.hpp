// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/limits.hpp"
#include "mir/data/blocked_layout.hpp"
#include "mir/film/filter.hpp"
#include "mir/film/luxel_grid.hpp"
#include "mir/metropolis/metropolis_options.hpp"
#include "mir/micro/gather_options.hpp"
#include "mir/normalise/policy.hpp"
#include "mir/paths/path.hpp"
#include "mir/reference/path_tracer.hpp"
#include "mir/sampling/instant_radiosity_sampler.hpp"
#include "mir/shading/direct_samples.hpp"

#include <cmath>
#include <optional>
#include <string>

namespace mir {

/// Which machine renders.
enum class BackendKind {
    automatic,  ///< a GPU where the build and the machine have one, else the processor
    cpu,
    cuda
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

/// How direct light reaches the image.
enum class DirectLight {
    separate,  ///< next-event samples per luxel (default); delta lights exactly
    vpl        ///< VPLs on the lamps, as the paper does, and at infinity for an environment; delta
               ///< lights stay separate
};

/// How 1/d^2 next to a VPL is tamed.
struct BoundPolicy {
    /// How the largest geometry term is found: from the area that the camera sees and the number of
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

/// What to render and how. Plain values with working defaults; validate() tells what is wrong.
struct RenderSettings {
    Extent image{640, 480};                         ///< pixels
    std::uint32_t luxels_per_pixel = 4;             ///< 1..64
    std::uint32_t camera = 0;                       ///< index into Scene::cameras
    Integrator integrator = Integrator::vpl;        ///< says which of the settings below count
    PathSettings path;                              ///< of Integrator::path
    MicroSettings micro;                            ///< of Integrator::micro
    std::uint32_t vpls = 1024;                      ///< wanted geometric VPLs
    SamplerKind sampler = SamplerKind::metropolis;  ///< of Integrator::vpl
    NormalisationPolicy normalisation = NormalisationPolicy::full;  ///< of samplers that need one
    std::uint32_t prepass_luxels = 4096;                            ///< of policy `prepass`
    MetropolisTuning metropolis;                                    ///< of SamplerKind::metropolis
    bool vpl_roulette = false;  ///< instant radiosity keeps VPLs by what they give to the image
    Termination termination = Termination::roulette;  ///< of light paths
    Sequence sequence = Sequence::random;             ///< of SamplerKind::instant_radiosity
    DirectLight direct = DirectLight::separate;       ///< how it reaches the image
    std::uint32_t direct_samples = 32;                ///< next-event samples per pixel
    /// Largest number of scattering events, 1..254; none: bounce_limit() of VPLs and discs, no
    /// limit of Integrator::path.
    std::optional<std::uint8_t> max_bounce = std::nullopt;
    BoundPolicy bound;  ///< of the VPLs' geometry term
    /// Paths per pixel that trace back what the bound removed, shared out among its luxels, at
    /// least one each; 0: none, so that this light is missing.
    std::uint32_t compensate = 0;
    VslSettings vsl;                                       ///< a choice instead of `bound`
    GlossySettings glossy;                                 ///< else all VPLs are Lambertian
    Filter filter = default_filter(FilterKind::gaussian);  ///< from luxels to pixels
    std::uint64_t seed = 0;                                ///< of all random numbers
    unsigned threads = 0;                                  ///< 0: every core
    BackendKind backend = BackendKind::automatic;          ///< which machine renders
    Acceleration acceleration = Acceleration::automatic;   ///< what finds out where rays end
    std::string scheduler;  ///< name in the Registry; empty: the backend's default
    /// Luxels scheduled together, rounded up to whole blocks of 16 x 16, not larger than the image
    /// of luxels rounded likewise; none: the backend's choice.
    std::optional<Extent> tile;
    bool bounce_layers = false;  ///< one image per bounce besides the sum
    bool removed_layer = false;  ///< an image of the light that the bound removed
    /// Paths measure what the bound removes and the largest bounce cuts (MissingShares), and two
    /// estimates how noisy direct light is (DirectNoise), for 2048 places however small the
    /// image; else the VPLs tell what the bound removes.
    bool measure_missing = true;
    bool allow_no_light = false;  ///< a scene without light gives black, not an error
    Limits limits;                ///< checked before memory is taken

    /// @throws Error(invalid_argument or limit_exceeded) that names the first bad value.
    void validate() const;

    /// Width / height of the image.
    [[nodiscard]] float aspect() const {
        return static_cast<float>(image.width) / static_cast<float>(image.height);
    }

    /// Largest number of scattering events of the light that VPLs or discs bring.
    [[nodiscard]] std::uint8_t bounce_limit() const { return max_bounce.value_or(32); }

    /// Next-event samples of one luxel: those of the pixel shared out, at least one.
    [[nodiscard]] std::uint32_t direct_samples_per_luxel() const {
        return (direct_samples + luxels_per_pixel - 1) / luxels_per_pixel;
    }

    /// What brings direct light to one luxel: its samples, or as many VPLs at infinity as there
    /// are to be others.
    [[nodiscard]] DirectSamples direct_samples_of_luxel() const {
        return direct == DirectLight::separate ? DirectSamples(direct_samples_per_luxel())
                                               : DirectSamples::vpls(vpls);
    }

    /// Paths of one luxel that trace back what the bound removed, likewise; 0 for none.
    [[nodiscard]] std::uint32_t compensate_per_luxel() const {
        return (compensate + luxels_per_pixel - 1) / luxels_per_pixel;
    }
};

/// Luxels of the image times VPLs: the contributions of a pass, in a number that does not overflow.
[[nodiscard]] inline double pairs(const RenderSettings& settings) {
    return static_cast<double>(settings.image.area()) * settings.luxels_per_pixel * settings.vpls;
}

namespace detail {

/// There must be light that can be shown, or traced back.
inline void check_removed(const RenderSettings& s) {
    expects(!s.removed_layer || s.integrator == Integrator::vpl,
            "only the light of VPLs has a bound that removes some of it (there is none to show); "
            "leave the layer out or use --integrator vpl");
    if (s.compensate == 0) return;
    expects(s.compensate <= 65536, "paths per pixel that trace back light must be 0 to 65536");
    expects(s.integrator == Integrator::vpl,
            "only the light of VPLs has a bound that removes some of it (there is nothing to trace "
            "back); leave --compensate out or use --integrator vpl");
    expects(s.bound.kind != BoundPolicy::Kind::none,
            "without a bound no light is removed (there is nothing to trace back); leave "
            "--compensate or --bound none out");
}

/// Spheres light what points would, with nothing removed.
inline void check_vsl(const RenderSettings& s) {
    if (!s.vsl.enabled) return;
    expects(s.vsl.samples >= 1 && s.vsl.samples <= 1024,
            "directions in which a luxel sees a sphere must be 1 to 1024; 8 are usual");
    expects(s.vsl.scale > 0.0f && std::isfinite(s.vsl.scale),
            "the scale of the spheres' radii must be positive and finite; 1 is usual");
    expects(s.integrator == Integrator::vpl,
            "only VPLs can become spheres (there are none); leave --vsl out or use --integrator "
            "vpl");
    expects(s.direct == DirectLight::separate,
            "VPLs on lamps do not become spheres (those spread indirect light alone); leave --vsl "
            "out or use --direct separate");
    expects(s.compensate == 0 && !s.removed_layer,
            "spheres have no bound that removes light (there is nothing to show or to trace back); "
            "leave --vsl out, or --compensate and the layer of what was removed");
}

/// Light paths alone tell from where a VPL is lit, and weigh it without a look at the image.
inline void check_glossy(const RenderSettings& s) {
    if (!s.glossy.enabled) return;
    expects(s.glossy.least_roughness >= 0.0f && s.glossy.least_roughness <= 1.0f,
            "the least roughness of the lobes of VPLs must be 0 to 1; 0.5 is usual");
    expects(
        s.integrator == Integrator::vpl,
        "only VPLs keep the lobes of their surfaces (there are none); leave --glossy out or use "
        "--integrator vpl");
    expects(
        s.sampler == SamplerKind::instant_radiosity && !s.vpl_roulette,
        "VPLs keep the lobes of their surfaces with light paths only (other samplers weigh VPLs "
        "by what the image gets of them without lobes); use --sampler ir or keller, or leave "
        "--glossy out");
    expects(!s.vsl.enabled,
            "VPLs are spheres or have lobes (not both are made); leave --vsl or --glossy out");
}

/// A tile may fill the last blocks of the image, but no more.
inline void check_tile(const std::optional<Extent>& tile, Extent luxels) {
    const Extent most = whole_blocks(luxels);
    if (!tile || (tile->width <= most.width && tile->height <= most.height)) return;
    const auto text = [](Extent e) {
        return std::to_string(e.width) + "x" + std::to_string(e.height);
    };
    throw Error(ErrorCode::invalid_argument,
                "a tile of " + text(*tile) + " luxels is larger than the image, which has " +
                    text(luxels) + "; use " + text(most) +
                    " for one tile, or leave the choice to the backend");
}

}  // namespace detail

inline void RenderSettings::validate() const {
    expects(image.width > 0 && image.height > 0,
            "an image of zero pixels was asked for (there is nothing to compute); give --width and "
            "--height of at least 1");
    check_limit(image.area(), limits.pixels, "pixels");
    expects(luxels_per_pixel >= 1 && luxels_per_pixel <= max_luxels_per_pixel,
            "luxels per pixel must be 1 to 64");
    expects(vpls > 0,
            "0 VPLs were asked for (there would be no indirect light); ask for at least 1, 256 is "
            "usual");
    check_limit(vpls, limits.vpls, "vpls");
    expects(direct_samples > 0 && direct_samples <= 65536,
            "next-event samples per pixel must be 1 to 65536");
    expects(prepass_luxels > 0 && prepass_luxels <= (1u << 24),
            "luxels of the prepass must be 1 to 16777216");
    metropolis.validate();
    expects(path.samples > 0 && path.samples <= 1u << 24,
            "camera paths per luxel must be 1 to 16777216");
    expects(path.directions >= 1 && path.directions <= 65536,
            "paths that go on from a first hit must be 1 to 65536");
    expects(sampler == SamplerKind::instant_radiosity || bounce_limit() < max_path_edges,
            "samplers of whole paths hold at most 63 reflections; lower the largest bounce or use "
            "instant radiosity");
    expects(sampler != SamplerKind::metropolis || normalisation != NormalisationPolicy::none,
            "Metropolis sampling yields VPLs without intensities (they follow from what the image "
            "gets); normalise them: full, prepass or proposal");
    expects(bounce_limit() >= 1 && bounce_limit() < 255, "the largest bounce must be 1 to 254");
    expects(!tile || (tile->width > 0 && tile->height > 0),
            "a tile of zero luxels was asked for (a tile must hold at least one); use 256x256");
    detail::check_tile(tile, luxel_grid(image, luxels_per_pixel, limits).luxels());
    expects(bound.kind != BoundPolicy::Kind::fixed ||
                (bound.value > 0.0f && std::isfinite(bound.value)),
            "the bound of the geometry term must be positive and finite (per square metre); use "
            "auto or none");
    expects(integrator == Integrator::vpl || bound.kind != BoundPolicy::Kind::fixed,
            "only the light of VPLs has a bounded geometry term (the picture would not be the one "
            "asked for); leave --bound out or use --integrator vpl");
    detail::check_removed(*this);
    detail::check_vsl(*this);
    detail::check_glossy(*this);
    expects(micro.surfels > 0,
            "0 discs were asked for (there would be no indirect light); 16384 are usual");
    check_limit(micro.surfels, limits.surfels, "surfels");
    expects(micro.surfel_rays >= 1 && micro.surfel_rays <= 65536,
            "the rays of a disc must be 1 to 65536; 32 are usual");
    check(micro.gather);
    check(micro.buffer());
}

}  // namespace mir
