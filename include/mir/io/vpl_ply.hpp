// SPDX-License-Identifier: MIT
#pragma once

#include "mir/data/vpl_list.hpp"

#include <filesystem>

namespace mir {

/// Writes VPLs as a PLY file of points, binary little endian. There is one vertex per geometric
/// VPL, black ones included, in the order of the list. Properties: position x y z, metres; normal
/// nx ny nz; intensity_red, intensity_green, intensity_blue, the J of Vpl in W sr^-1; bounce, that
/// of main_bounces(). A comment names `origin`, from which positions are counted
/// (RenderStatistics::origin), metres, where it is not zero. Equal lists give equal bytes; the file
/// appears complete or not at all. Thread-safe for different files.
/// @throws Error(io) when the file cannot be written.
/// Source of the format: Turk, "The PLY polygon file format", 1994.
void write_vpls_ply(const std::filesystem::path& path, const VplList& list,
                    DVec3 origin = DVec3(0.0));

}  // namespace mir
