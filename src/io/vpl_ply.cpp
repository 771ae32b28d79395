// SPDX-License-Identifier: MIT
#include "mir/io/vpl_ply.hpp"

#include "mir/core/error.hpp"
#include "mir/core/number_text.hpp"
#include "mir/data/main_bounces.hpp"
#include "mir/io/write_file.hpp"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace mir {

namespace detail {
namespace {

/// The line that says where positions are counted from. None where that is (0, 0, 0).
std::string vpl_ply_origin(DVec3 origin) {
    if (origin == DVec3(0.0)) return {};
    std::string line = "comment origin of positions, metres:";
    for (const double x : {origin.x, origin.y, origin.z}) line += ' ' + number_text(x, 17);
    return line + '\n';
}

/// Everything before the numbers of a PLY file of VPLs.
std::string vpl_ply_header(std::uint32_t count, DVec3 origin) {
    return "ply\n"
           "format binary_little_endian 1.0\n"
           "comment virtual point lights: points that shine into the hemisphere of their normal\n"
           "comment position in metres; radiant intensity J cos(angle to the normal), J in W/sr,\n"
           "comment linear Rec. 709; the power of a light is pi J, in W\n"
           "comment bounce: scattering events up to the camera, 1 for light of a lamp itself\n" +
           vpl_ply_origin(origin) + "element vertex " + std::to_string(count) +
           "\n"
           "property float x\n"
           "property float y\n"
           "property float z\n"
           "property float nx\n"
           "property float ny\n"
           "property float nz\n"
           "property float intensity_red\n"
           "property float intensity_green\n"
           "property float intensity_blue\n"
           "property uchar bounce\n"
           "end_header\n";
}

/// Appends the bytes of a number, lowest first.
void append_little_endian(std::string& out, float value) {
    const auto bits = std::bit_cast<std::uint32_t>(value);
    for (int shift = 0; shift < 32; shift += 8)
        out += static_cast<char>(static_cast<unsigned char>(bits >> shift));
}

}  // namespace
}  // namespace detail

void write_vpls_ply(const std::filesystem::path& path, const VplList& list, DVec3 origin) {
    std::string bytes = detail::vpl_ply_header(list.size(), origin);
    const std::vector<std::uint8_t> bounces = main_bounces(list);
    for (std::size_t j = 0; j < bounces.size(); ++j) {
        const Vpl& vpl = list.vpls()[j];
        for (const Vec3& v : {vpl.position, vpl.normal})
            for (const float x : {v.x, v.y, v.z}) detail::append_little_endian(bytes, x);
        for (const float x : {vpl.intensity.r, vpl.intensity.g, vpl.intensity.b})
            detail::append_little_endian(bytes, x);
        bytes += static_cast<char>(bounces[j]);
    }
    detail::write_file(path, bytes, "the VPLs");
}

}  // namespace mir
