// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/rgb.hpp"
#include "mir/data/chain_health.hpp"
#include "mir/data/image.hpp"
#include "mir/data/vpl_list.hpp"
#include "mir/film/guide_images.hpp"
#include "mir/runtime/light_difference.hpp"
#include "mir/runtime/share_estimate.hpp"
#include "mir/runtime/stage_seconds.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace mir {

/// Numbers about a render that a user may want to judge it by.
struct RenderStatistics {
    std::uint64_t triangles = 0;             ///< of all instances; those left out do not count
    std::uint64_t dropped_triangles = 0;     ///< without area, left out
    std::uint64_t coinciding_triangles = 0;  ///< in one place with a lamp's, and those lamps' own
    std::uint64_t luxels = 0;                ///< of the whole image
    std::uint32_t luxel_rows_per_pixel = 1;  ///< rows of luxels that make a row of pixels
    std::uint64_t light_paths = 0;    ///< of the sampler; of the bootstrap for Metropolis sampling
    std::uint64_t camera_paths = 0;   ///< of the reference integrator
    std::uint32_t vpls = 0;           ///< geometric VPLs placed
    std::uint64_t surfels = 0;        ///< discs of the micro-rendering integrator
    std::uint64_t patches = 0;        ///< of those, each lit as a whole (SurfelPatches)
    std::uint64_t contributions = 0;  ///< luxels x VPLs
    float emitted_power = 0.0f;       ///< luminance, W
    float non_lambertian_share = 0.0f;  ///< of VPL intensity: lobes spread as Lambertian
    float widened_share = 0.0f;         ///< of VPL intensity, through lobes that were widened
    double states = 0.0;                ///< n: recorded states; 0 for samplers without
    double path_luminance = 0.0;        ///< P_c: mean image luminance of all paths, W m^-2 sr^-1
    double dropped_share = 0.0;         ///< of the states, 0..1: light of VPLs that no luxel sees
    std::optional<ChainHealth> health;  ///< of samplers that run Markov chains
    /// P_c by light paths that are not chosen by the image, from a few luxels, where measured.
    std::optional<PathLuminance> light_path_luminance;
    std::string normalisation;         ///< how intensities were made; "none": by the sampler
    float bound = 0.0f;                ///< largest geometry term, m^-2; 0: none
    double indirect_luminance = 0.0;   ///< mean over luxels of the VPLs' or discs' light alone
    double removed_luminance = 0.0;    ///< mean over luxels of what the bound removed, by the VPLs
    double vsl_radius = 0.0;           ///< mean radius of spherical lights, m; 0: points
    std::uint64_t residual_paths = 0;  ///< that traced back what the bound removed
    double residual_luminance = 0.0;   ///< mean over luxels of what they found
    std::uint64_t caustic_paths = 0;   ///< light paths that brought caustics
    double caustic_luminance = 0.0;    ///< mean over luxels of what they brought, W m^-2 sr^-1
    double caustic_direct_luminance = 0.0;  ///< of it what is part of direct light
    std::optional<double> direct_error;     ///< of the mean over luxels of direct light that is no
                                            ///< caustic, W m^-2 sr^-1; see error_of_rows()
    std::optional<double> residual_error;   ///< of residual_luminance, the same
    std::optional<double> caustic_error;    ///< of caustic_luminance, the same
    /// Largest share of indirect light that caustics of light paths may have, 97.5 % sure, where
    /// they were left out for it (RenderSettings::skip_faint_caustics).
    std::optional<double> faint_caustics;
    std::optional<ShareEstimate> removed;  ///< by the bound, by paths, where measured
    std::optional<ShareEstimate> cut;      ///< by the largest bounce, where measured
    std::optional<double> direct_noise;    ///< of a pixel, relative, where measured
    /// Light of discs against that of paths, before any correction, where it was measured.
    std::optional<LightDifference> gather_difference;
    bool gather_corrected = false;  ///< by what of it is no noise (LightCorrection)
    std::string backend;            ///< "cpu" or "cuda"
    std::string device;             ///< name of the GPU; empty on the processor
    std::string acceleration;       ///< "bvh", "embree", "kdtree" or "kdtree+shafts"
    std::string scheduler;          ///< its name in the Registry
    std::string scene_hash;         ///< SceneHash::hex()
    DVec3 origin{0.0};     ///< Scene::origin of what was rendered, metres: positions of guides and
                           ///< VPLs are counted from it
    StageSeconds seconds;  ///< of wall time, by stage
    std::uint32_t passes = 1;  ///< renders whose mean the picture is (ProgressiveRender)
    std::optional<double> relative_error;  ///< of the picture, from their spread; needs two
    bool complete = true;                  ///< false: passes that were asked for are missing

    /// Share of the VPLs' light that the bound removed, 0..1. Measured, or else estimated from the
    /// VPLs: too little where few of them lie next to what they would light.
    [[nodiscard]] double removed_share() const {
        if (removed) return removed->share;
        const double all = indirect_luminance + removed_luminance;
        return all > 0.0 ? removed_luminance / all : 0.0;
    }
};

/// Luminances of a row of luxels, each added up from left to right, W m^-2 sr^-1.
struct RowLuminances {
    double indirect = 0.0;        ///< of the VPLs' or discs' light
    double removed = 0.0;         ///< of what the bound removed, by the VPLs
    double residual = 0.0;        ///< of what paths traced back of that
    double caustic = 0.0;         ///< of what mirrors and bodies of glass threw there
    double caustic_direct = 0.0;  ///< of it what is part of direct light
    double direct = 0.0;          ///< of direct light without that
};

/// A finished picture. Radiance in W m^-2 sr^-1; beauty = emission + direct + indirect.
struct RenderResult {
    Image<Rgb> beauty;                ///< the sum of the next three
    Image<Rgb> emission;              ///< of what the camera sees, environment included
    Image<Rgb> direct;                ///< of one scattering event, without what VPLs on lamps bring
    Image<Rgb> indirect;              ///< the rest: of VPLs, of discs or of longer paths
    std::vector<Image<Rgb>> bounces;  ///< element i: light of i + 1 scattering events; on request
    Guides guides;                    ///< what a denoiser wants to know
    VplList vpls;                     ///< that lit the picture; none of other integrators
    RenderStatistics statistics;      ///< how it came about
    std::vector<std::string> warnings;  ///< sentences
    /// Light that the bound removed, as estimated from the VPLs. No other layer holds it; empty
    /// unless asked for.
    Image<Rgb> removed{};
    /// Standard error of the luminance of `indirect` that comes from gathering few of these VPLs
    /// instead of all, estimated (PickSpread); nothing else that differs from the truth is in it.
    /// Empty unless asked for.
    Image<float> pick_error{};
    /// Share of a pixel where the camera sees a surface, 0..1: its alpha. Through the filter of the
    /// beauty, which counts as multiplied by it; the environment counts as 0.
    Image<float> coverage{};
    Image<Rgb> denoised{};   ///< the beauty by a Denoiser; empty unless asked for
    std::string denoiser{};  ///< name and version of what made it
    /// Of the luxels of RenderSettings::rows, from top to bottom. Their sums over a whole image
    /// make the mean luminances of its statistics; empty where an integrator counts none.
    std::vector<RowLuminances> luminances{};
};

}  // namespace mir
