// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/error.hpp"
#include "mir/core/monitor.hpp"
#include "mir/runtime/result.hpp"
#include "mir/runtime/settings.hpp"
#include "mir/scene/scene.hpp"

namespace mir {

/// Renders a scene: the front door of the library, in component `mir::runtime`.
///
/// The picture is linear radiance, W m^-2 sr^-1, Rec. 709, its emission, direct and indirect light
/// in layers of their own (RenderResult). The scene is in metres, +y up, and needs a camera.
///
/// The renderer follows from the settings. BackendKind::automatic takes a GPU where the build and
/// the machine have one that can render them, else the processor, and RenderResult::warnings says
/// why a GPU that is there was passed over. RenderSettings::scheduler may name the renderer. The
/// bytes are those of the same renderer taken from a Registry (mir/runtime/all_renderers.hpp),
/// which saves whoever renders often the choice.
///
/// `monitor` may be null. Another thread reads from it how far the render is, and cancels it.
/// Safe to call from several threads at the same time, each with a monitor of its own.
/// @throws Error for settings, a scene or a device that cannot be used, and Error(cancelled);
///         std::bad_alloc where memory is short.
[[nodiscard]] RenderResult render(const Scene& scene, const RenderSettings& settings,
                                  Monitor* monitor = nullptr);

}  // namespace mir
