// SPDX-License-Identifier: MIT
#pragma once

#include "mir/data/vpl_list.hpp"

#include <filesystem>

namespace mir {
/// Writes VPLs as binary glTF 2.0 (.glb), a mesh of points. There is one point for each geometric
/// VPL, black ones included, in the order of the list. POSITION in metres; NORMAL; COLOR_0, linear,
/// the hue of its light with 1 in the largest channel; _INTENSITY, the J of Vpl in W sr^-1;
/// _BOUNCE, that of main_bounces(). The node of the mesh stands at `origin`, from which positions
/// are counted (RenderStatistics::origin), metres. Equal lists give equal bytes; the file appears
/// complete or not at all. Thread-safe for different files.
/// @throws Error(io) when the file cannot be written; Error(limit_exceeded) for more than the
///         4 GiB of the format.
void write_vpls_glb(const std::filesystem::path& path, const VplList& list,
                    DVec3 origin = DVec3(0.0));

}  // namespace mir
