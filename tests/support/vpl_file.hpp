// SPDX-License-Identifier: MIT
#pragma once

#include "io/detail/ply_header.hpp"
#include "io/detail/ply_values.hpp"
#include "mir/data/vpl.hpp"

#include <map>
#include <string>
#include <vector>

namespace mirtest {

/// A point of a PLY file of VPLs.
struct VplOfFile {
    mir::Vpl vpl;
    std::uint8_t bounce = 0;
};

/// Reads the vertices of a PLY file by the names of their properties.
inline std::vector<VplOfFile> read_vpls(const std::string& file) {
    const mir::detail::PlyHeader header = mir::detail::PlyHeaderReader(file).read();
    mir::detail::check_ply_counts(header, file.size());
    mir::detail::PlyValues values(file, header);
    std::vector<VplOfFile> vpls(header.elements.at(0).count);
    for (VplOfFile& v : vpls) {
        std::map<std::string, float> of;
        for (const mir::detail::PlyProperty& p : header.elements[0].properties)
            of[p.name] = static_cast<float>(values.next(p.type));
        v.vpl.position = {of.at("x"), of.at("y"), of.at("z")};
        v.vpl.normal = {of.at("nx"), of.at("ny"), of.at("nz")};
        v.vpl.intensity = {of.at("intensity_red"), of.at("intensity_green"),
                           of.at("intensity_blue")};
        v.bounce = static_cast<std::uint8_t>(of.at("bounce"));
    }
    return vpls;
}

}  // namespace mirtest
