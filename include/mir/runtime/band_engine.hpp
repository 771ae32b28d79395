// SPDX-License-Identifier: MIT
#pragma once

namespace mir {

/// An engine that keeps the luxels of a band in memory of its own and works on them there, as GPUs
/// do; other engines leave that to the executor. All of it is const and for one thread at a time.
///
/// Luxels come from trace(extent, tile, first_row, camera_rays), or from upload(gbuffer) where the
/// host has filled them; find_visible(luxels, vpls, limits) keeps with them who sees which VPL.
/// response(extent, n) is an empty sum, with add(luxels, vpls, shading) and mean() as ResponseSum.
///
/// Layers are what a HostCanvas makes of a band: black(luxels), coverage(luxels), emission(luxels,
/// environment, camera_rays, first_row), direct(luxels, lights, band, samples) and light(luxels,
/// vpls, shading, monitor), with add(sum, layer) and row_luminances(layer).
///
/// picture(extent, rays, filter, layers) is an empty film with guides. film(picture, first_row,
/// layers) and guides(picture, luxels) take a band there, bring_home(picture, guides) brings what
/// is finished, develop(picture) are the images. visible_area(camera, aspect) is the function of
/// that name.
///
/// Luxels::knows_visibility() says whether find_visible() was called, Luxels::extent() how many
/// there are.
template <class N>
concept BandEngine = requires {
    typename N::Luxels;
    typename N::Response;
    typename N::Layer;
    typename N::Picture;
};

}  // namespace mir
