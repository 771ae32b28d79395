// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/error.hpp"
#include "mir/core/limits.hpp"
#include "mir/data/blocked_layout.hpp"
#include "mir/film/luxel_grid.hpp"
#include "mir/metropolis/metropolis_options.hpp"
#include "mir/micro/check_gather.hpp"
#include "mir/paths/path.hpp"
#include "mir/runtime/film_layer.hpp"
#include "mir/runtime/picture_bytes.hpp"
#include "mir/runtime/settings.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

namespace mir {

namespace detail {

/// There must be light that can be shown, or traced back.
inline void check_removed(const RenderSettings& s) {
    expects(!s.removed_layer || s.integrator == Integrator::vpl,
            "only the light of VPLs has a bound that removes some of it (there is none to show); "
            "leave the layer out or use --integrator vpl");
    expects(s.caustics <= 65536, "light paths per pixel for caustics must be 0 to 65536");
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

/// True of light paths: they know where a VPL is lit from. They weigh it without a look at the
/// image.
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

/// True of points under a bound whose light is known before luxels are met. Cuts stand for these
/// alone.
inline void check_cuts(const RenderSettings& s) {
    expects(s.picks >= 1 && s.picks <= 65536,
            "VPLs that a luxel picks must be 1 to 65536; 256 are usual");
    expects(!s.pick_error_layer || (s.integrator == Integrator::vpl && s.wants_cuts()),
            "luxels gather all VPLs and pick none (there is no error of picks to show); leave the "
            "layer pick_error out or use --sum cuts");
    if (s.sum != LightSum::cuts) return;
    expects(s.integrator == Integrator::vpl,
            "only VPLs are cut (there are none); leave --sum out or use --integrator vpl");
    expects(!s.vsl.enabled && !s.glossy.enabled,
            "spheres and lobes are gathered from all VPLs (their visibility is stored); use --sum "
            "all, or leave --vsl and --glossy out");
    expects(!s.removed_layer,
            "a layer of what the bound removed needs all VPLs at each luxel; use --sum all or "
            "leave the layer out");
    expects(s.sampler != SamplerKind::metropolis ||
                s.normalisation_policy() != NormalisationPolicy::prepass,
            "a prepass meets all luxels where few are lit (cuts are to leave that out); use "
            "--normalise proposal or --sum all");
}

/// A tile may fill the last blocks of the image, but no more.
inline void check_tile(const std::optional<Extent>& tile, Extent luxels) {
    expects(!tile || (tile->width > 0 && tile->height > 0),
            "a tile of zero luxels was asked for (a tile must hold at least one); use 256x256");
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

/// An image that memory has room for, cut into luxels and tiles.
inline void check_image(const RenderSettings& s) {
    expects(s.image.width > 0 && s.image.height > 0,
            "an image of zero pixels was asked for (there is nothing to compute); give --width and "
            "--height of at least 1");
    check_limit(s.image.area(), s.limits.pixels, "pixels");
    expects(s.rows.count == 0
                ? s.rows.first == 0
                : s.rows.first < s.image.height && s.rows.count <= s.image.height - s.rows.first,
            "rows of pixels were asked for that the image does not have (there is nothing to see); "
            "ask for rows between its top and its bottom, or for all");
    expects(s.luxels_per_pixel >= 1 && s.luxels_per_pixel <= max_luxels_per_pixel,
            "luxels per pixel must be 1 to 64");
    check_picture(s, first_bounce_layer + extra_layers(s));
}

/// Numbers of VPLs, of paths and of samples.
inline void check_samples(const RenderSettings& s) {
    expects(s.vpls > 0,
            "0 VPLs were asked for (there would be no indirect light); ask for at least 1, 256 is "
            "usual");
    check_limit(s.vpls, s.limits.vpls, "vpls");
    expects(s.direct_samples > 0 && s.direct_samples <= 65536,
            "next-event samples per pixel must be 1 to 65536");
    expects(s.prepass_luxels > 0 && s.prepass_luxels <= (1u << 24),
            "luxels of the prepass must be 1 to 16777216");
    s.metropolis.validate();
    expects(s.path.samples > 0 && s.path.samples <= 1u << 24,
            "camera paths per luxel must be 1 to 16777216");
    expects(s.path.directions >= 1 && s.path.directions <= 65536,
            "paths that go on from a first hit must be 1 to 65536");
}

/// Samplers with the paths and the normalisation that they can do with.
inline void check_sampler(const RenderSettings& s) {
    expects(s.sampler == SamplerKind::instant_radiosity || s.bounce_limit() < max_path_edges,
            "samplers of whole paths hold at most 63 reflections; lower the largest bounce or use "
            "instant radiosity");
    expects(s.sampler != SamplerKind::metropolis || s.normalisation != NormalisationPolicy::none,
            "Metropolis sampling yields VPLs without intensities (they follow from what the image "
            "gets); normalise them: full, prepass or proposal");
    expects(s.bounce_limit() >= 1 && s.bounce_limit() < 255, "the largest bounce must be 1 to 254");
}

/// GPUs that differ.
inline void check_devices(const DeviceChoice& devices) {
    std::vector<std::uint32_t> numbers = devices.numbers;
    std::sort(numbers.begin(), numbers.end());
    expects(
        numbers.size() <= 64 && std::adjacent_find(numbers.begin(), numbers.end()) == numbers.end(),
        "a GPU was chosen twice, or more than 64 were (each would get its share of the picture "
        "once); give each number once");
    expects(!devices.all || numbers.empty(),
            "all GPUs were chosen and some of them by number (one of the two has no meaning); "
            "give either");
}

/// A bound only where there are VPLs.
inline void check_bound(const RenderSettings& s) {
    expects(s.bound.kind != BoundPolicy::Kind::fixed ||
                (s.bound.value > 0.0f && std::isfinite(s.bound.value)),
            "the bound of the geometry term must be positive and finite (per square metre); use "
            "auto or none");
    expects(s.integrator == Integrator::vpl || s.bound.kind != BoundPolicy::Kind::fixed,
            "only the light of VPLs has a bounded geometry term (the picture would not be the one "
            "asked for); leave --bound out or use --integrator vpl");
}

/// Discs and how light is gathered from them.
inline void check_micro(const RenderSettings& s) {
    expects(s.micro.surfels > 0,
            "0 discs were asked for (there would be no indirect light); 16384 are usual");
    check_limit(s.micro.surfels, s.limits.surfels, "surfels");
    expects(s.micro.surfel_rays >= 1 && s.micro.surfel_rays <= 65536,
            "the rays of a disc must be 1 to 65536; 32 are usual");
    check(s.micro.gather);
    check(s.micro.buffer());
}

}  // namespace detail

/// Checks every value of the settings, in the order in which errors are reported.
/// @throws Error(invalid_argument or limit_exceeded) that names the first bad value.
inline void check(const RenderSettings& settings) {
    detail::check_image(settings);
    detail::check_samples(settings);
    detail::check_sampler(settings);
    detail::check_tile(settings.tile,
                       luxel_grid(settings.image, settings.luxels_per_pixel, settings.limits,
                                  {settings.only_luxel.x, settings.only_luxel.y})
                           .luxels());
    detail::check_devices(settings.devices);
    detail::check_bound(settings);
    detail::check_removed(settings);
    detail::check_vsl(settings);
    detail::check_glossy(settings);
    detail::check_cuts(settings);
    detail::check_micro(settings);
}

}  // namespace mir
