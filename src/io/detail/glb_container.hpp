// SPDX-License-Identifier: MIT
#pragma once

#include "io/detail/gltf_check.hpp"
#include "io/detail/read_file.hpp"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mir::detail {

/// Where the two parts of a glTF file lie in its bytes.
struct GltfParts {
    struct Range {
        std::size_t first = 0;
        std::size_t size = 0;
    };
    Range json;
    std::optional<Range> binary;  ///< only in .glb
    std::size_t behind = 0;       ///< bytes behind the end that the header announces
};

inline bool is_binary_gltf(const Bytes& bytes) {
    return bytes.size() >= 4 && std::memcmp(bytes.data(), "glTF", 4) == 0;
}

/// 32 bits, the lowest first, whatever this machine is.
inline std::uint32_t glb_number(const Bytes& bytes, std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i) value |= static_cast<std::uint32_t>(bytes[at + i]) << 8 * i;
    return value;
}

/// The length that the header announces.
/// @throws Error(invalid_input) when there are fewer bytes; Error(unsupported) of another version.
inline std::size_t glb_length(const Bytes& bytes) {
    constexpr std::size_t header = 12;
    if (bytes.size() < header)
        gltf_fail("header",
                  "it is cut short (a binary glTF file begins with 12 bytes, this one has " +
                      std::to_string(bytes.size()) + "); copy or export the file again");
    const std::uint32_t version = glb_number(bytes, 4);
    if (version != 2)
        gltf_fail("header",
                  "it is binary glTF of version " + std::to_string(version) +
                      " (this reader knows 2); export it as glTF 2.0",
                  ErrorCode::unsupported);
    const std::size_t length = glb_number(bytes, 8);
    if (length > bytes.size())
        gltf_fail("header", "the file is cut short (it announces " + std::to_string(length) +
                                " bytes, of which " + std::to_string(bytes.size()) +
                                " are there); copy or export the file again");
    if (length < header)
        gltf_fail("header", "it announces " + std::to_string(length) +
                                " bytes, fewer than it has itself; repair or export it again");
    return length;
}

/// Source: Khronos glTF 2.0 specification, 4.4 (binary glTF layout).
inline GltfParts glb_parts(const Bytes& bytes) {
    constexpr std::uint32_t json_chunk = 0x4e4f534a;
    constexpr std::uint32_t binary_chunk = 0x004e4942;
    const std::size_t end = glb_length(bytes);
    GltfParts parts;
    parts.behind = bytes.size() - end;
    std::size_t at = 12;
    for (std::size_t number = 0; at < end; ++number) {
        const std::string place = gltf_place("chunk", number);
        if (end - at < 8)
            gltf_fail(place, "it is cut short (its header has 8 bytes, of which " +
                                 std::to_string(end - at) + " are there); export the file again");
        const GltfParts::Range range{at + 8, glb_number(bytes, at)};
        const std::uint32_t type = glb_number(bytes, at + 4);
        if (range.size > end - range.first)
            gltf_fail(place, "it reaches past the end of the file (it announces " +
                                 std::to_string(range.size) + " bytes, of which " +
                                 std::to_string(end - range.first) +
                                 " are there); export the file again");
        if (number == 0 && type != json_chunk)
            gltf_fail(place, "it holds no JSON (the first one has to); export the file again");
        if (number == 0) parts.json = range;
        // Others are of extensions.
        if (number != 0 && type == binary_chunk && !parts.binary) parts.binary = range;
        at = range.first + range.size;
    }
    if (parts.json.first == 0)
        gltf_fail("header", "no chunk follows it (JSON has to); export the file again");
    return parts;
}

/// The parts of either form of the file.
inline GltfParts gltf_parts(const Bytes& bytes) {
    if (is_binary_gltf(bytes)) return glb_parts(bytes);
    GltfParts parts;
    parts.json.size = bytes.size();
    return parts;
}

}  // namespace mir::detail
