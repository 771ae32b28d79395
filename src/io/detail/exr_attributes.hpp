// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/error.hpp"
#include "mir/io/detail/shown_path.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <istream>
#include <string>
#include <string_view>

namespace mir::detail {

[[noreturn]] inline void cannot_read(const std::filesystem::path& path, const std::string& reason,
                                     const std::string& remedy) {
    throw Error(ErrorCode::invalid_input,
                shown_path(path) + ": the image cannot be read (" + reason + "); " + remedy);
}

/// Walks the attributes of an OpenEXR header before OpenEXR does. Each has a name, type, size and
/// value. OpenEXR takes memory for whatever size they announce and, for types that it knows, reads
/// as much as the type has, whatever the size. Source: OpenEXR file layout, "Header" and "Attribute
/// types".
class ExrAttributeWalk {
 public:
    ExrAttributeWalk(std::istream& stream, const std::filesystem::path& path,
                     std::uint64_t file_bytes)
        : stream_(stream), path_(path), file_bytes_(file_bytes) {}

    /// From the stream's place on, which is behind the version; goes back there.
    /// @throws Error(invalid_input) when a value is longer than the file, or not as long as its
    ///         type.
    void check() {
        const std::istream::pos_type begin = stream_.tellg();
        while (read_text()) check_attribute(text_);
        stream_.clear();
        stream_.seekg(begin);
    }

 private:
    void check_attribute(const std::string& name) {
        const std::string attribute = "attribute " + in_quotes(name) + " ";
        static_cast<void>(read_text());
        const std::string type = text_;
        const std::uint64_t size = read_number();
        if (!stream_) cannot_read(path_, "it ends in " + attribute, remedy);
        const auto value = static_cast<std::uint64_t>(stream_.tellg());
        if (size > file_bytes_ - value)
            cannot_read(path_,
                        attribute + "announces " + std::to_string(size) +
                            " bytes, but the file has " + std::to_string(file_bytes_ - value) +
                            " left",
                        remedy);
        const std::uint64_t wanted = length_of(type, size);
        if (wanted != size)
            cannot_read(path_,
                        attribute + "has " + std::to_string(size) + " bytes, but one of type " +
                            in_quotes(type) + " has " + std::to_string(wanted),
                        remedy);
        stream_.clear();
        stream_.seekg(static_cast<std::streamoff>(value + size));
    }

    /// Bytes that a value of this type has; `size` where that is free. Reads on.
    std::uint64_t length_of(std::string_view type, std::uint64_t size) {
        struct Length {
            std::string_view type;
            std::uint64_t bytes;
        };
        constexpr std::array<Length, 24> lengths{{{"box2i", 16},    {"box2f", 16},
                                                  {"float", 4},     {"double", 8},
                                                  {"int", 4},       {"compression", 1},
                                                  {"lineOrder", 1}, {"envmap", 1},
                                                  {"v2i", 8},       {"v2f", 8},
                                                  {"v2d", 16},      {"v3i", 12},
                                                  {"v3f", 12},      {"v3d", 24},
                                                  {"m33f", 36},     {"m33d", 72},
                                                  {"m44f", 64},     {"m44d", 128},
                                                  {"keycode", 28},  {"rational", 8},
                                                  {"timecode", 8},  {"chromaticities", 32},
                                                  {"tiledesc", 9},  {"deepImageState", 1}}};
        for (const Length& known : lengths)
            if (known.type == type) return known.bytes;
        if (type == "chlist") return length_of_channels();
        if (type == "floatvector") return size / 4 * 4;
        if (type != "preview") return size;
        const std::uint64_t width = read_number();
        return 8 + 4 * width * read_number();
    }

    std::uint64_t length_of_channels() {
        constexpr std::uint64_t numbers = 16;  // type, linearity, sampling
        std::uint64_t bytes = 1;
        while (read_text()) {
            bytes += text_.size() + 1 + numbers;
            stream_.ignore(numbers);
        }
        return bytes;
    }

    /// Text up to a zero; false when there is none.
    bool read_text() {
        constexpr std::size_t longest = 255;
        text_.clear();
        for (int c = stream_.get(); c > 0; c = stream_.get()) {
            text_ += static_cast<char>(c);
            if (text_.size() > longest)
                cannot_read(path_, "its header has a name of more than 255 letters", remedy);
        }
        return !text_.empty();
    }

    std::uint64_t read_number() {
        std::array<unsigned char, 4> b{};
        stream_.read(reinterpret_cast<char*>(b.data()), b.size());
        return std::uint64_t{b[0]} | std::uint64_t{b[1]} << 8 | std::uint64_t{b[2]} << 16 |
               std::uint64_t{b[3]} << 24;
    }

    static constexpr const char* remedy = "write it again";
    std::istream& stream_;
    const std::filesystem::path& path_;
    std::uint64_t file_bytes_;
    std::string text_;
};

}  // namespace mir::detail
