// SPDX-License-Identifier: MIT
#pragma once

#include "io/detail/data_uri.hpp"
#include "io/detail/gltf_value.hpp"
#include "io/detail/outside.hpp"
#include "io/detail/read_file.hpp"
#include "io/detail/text_number.hpp"
#include "mir/core/limits.hpp"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <utility>

namespace mir::detail {

/// Brings the bytes of a file's buffers, each when it is asked for.
class GltfBuffers {
 public:
    /// `binary`: the binary chunk of a .glb, none of a .gltf.
    GltfBuffers(std::filesystem::path folder, std::optional<Bytes> binary, const Limits& limits,
                FileBudget& budget)
        : folder_(std::move(folder)),
          binary_(std::move(binary)),
          limits_(limits),
          budget_(budget) {}

    /// As many bytes as the buffer `index` announces. There may be more of them than that.
    /// @throws Error(invalid_input), Error(limit_exceeded)
    [[nodiscard]] Bytes load(const GltfValue& buffer, std::size_t index) {
        const std::string place = gltf_place("buffer", index, buffer.name());
        const auto length = buffer.need("byteLength", "a whole number")
                                .whole(std::numeric_limits<std::uint64_t>::max());
        const auto uri = buffer.find("uri");
        Bytes bytes = uri ? from_uri(uri->text(), place) : from_chunk(index, place);
        if (length > bytes.size())
            gltf_fail(place, "it announces " + std::to_string(length) + " bytes, of which " +
                                 std::to_string(bytes.size()) +
                                 " are there (File size mismatch); copy or export it again");
        bytes.resize(static_cast<std::size_t>(length));
        return bytes;
    }

 private:
    [[nodiscard]] Bytes from_chunk(std::size_t index, const std::string& place) {
        if (index != 0 || !binary_)
            gltf_fail(place,
                      "it has no bytes (no uri, and the file has no binary chunk for it); "
                      "export it again");
        return std::exchange(*binary_, {});
    }

    [[nodiscard]] Bytes from_uri(const std::string& uri, const std::string& place) {
        if (is_data_uri(uri)) return data_uri_bytes(uri, place);
        if (const auto scheme = uri_scheme(uri); !scheme.empty())
            gltf_fail(place, "its data are at " + in_quotes(uri) +
                                 " (this reader opens files beside the scene, nothing of '" +
                                 std::string(scheme) + ":'); put the file there and name it so");
        const std::string name = unescaped(uri);
        if (!limits_.allow_outside && leads_outside(folder_, name))
            gltf_fail(place, "its file " + in_quotes(name) +
                                 " lies outside of the scene's folder (a scene from elsewhere has "
                                 "no business there); move it into the folder, or allow it with "
                                 "--allow-outside");
        std::error_code failure;
        if (!std::filesystem::exists(folder_ / name, failure))
            gltf_fail(place, "the scene is no valid glTF 2.0 file without it (File not found : " +
                                 name + "); put it beside the scene");
        return read_whole_file(folder_ / name, budget_);
    }

    std::filesystem::path folder_;
    std::optional<Bytes> binary_;
    const Limits& limits_;
    FileBudget& budget_;
};

}  // namespace mir::detail
