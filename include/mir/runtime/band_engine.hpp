// SPDX-License-Identifier: MIT
#pragma once

namespace mir {

/// An engine that keeps the luxels of a band in memory of its own and works on them there, as GPUs
/// do; other engines leave that to the executor. All of it is const and for one thread at a time:
///   Luxels trace(gbuffer, first_row, camera_rays)  camera rays; fills the G-buffer on the host too
///   Luxels upload(gbuffer)                          luxels that the host has filled
///   void find_visible(luxels, vpls, limits)         keeps with the luxels who sees which VPL
///   Response response(extent, n)                    an empty sum; add(luxels, vpls, shading),
///                                                   mean(), as ResponseSum
///   Image<Rgb> light(luxels, gbuffer, vpls, shading, monitor)
///                                                   reconstruct(), or reshade() where kept
/// Luxels::knows_visibility() says whether find_visible() was called.
template <class N>
concept BandEngine = requires {
    typename N::Luxels;
    typename N::Response;
};

/// What an ImageBand holds for engines that keep nothing.
struct NothingKept {
    [[nodiscard]] static constexpr bool knows_visibility() { return false; }
};

namespace detail {
template <class N>
struct KeptBy {
    using Type = NothingKept;
};
template <BandEngine N>
struct KeptBy<N> {
    using Type = typename N::Luxels;
};
}  // namespace detail

/// What an ImageBand holds for an engine.
template <class N>
using KeptBy = typename detail::KeptBy<N>::Type;

}  // namespace mir
