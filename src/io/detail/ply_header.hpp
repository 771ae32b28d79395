// SPDX-License-Identifier: MIT
#pragma once

#include "io/detail/text_lines.hpp"
#include "io/detail/text_number.hpp"
#include "mir/core/limits.hpp"

#include <array>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace mir::detail {

/// How numbers are written.
enum class PlyFormat { ascii, little_endian, big_endian };

/// Types of numbers.
enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

/// Bytes of one number.
constexpr std::size_t ply_size(PlyType type) {
    constexpr std::array<std::size_t, 8> sizes = {1, 1, 2, 2, 4, 4, 4, 8};
    return sizes[static_cast<std::size_t>(type)];
}

struct PlyProperty {
    std::string name;
    PlyType type = PlyType::float32;
    std::optional<PlyType> count_type;  ///< set: a list, with numbers of this type in front
};

struct PlyElement {
    std::string name;
    std::uint64_t count = 0;
    std::vector<PlyProperty> properties;
    std::size_t line = 0;  ///< of the header
};

/// What the lines before the data announce.
struct PlyHeader {
    PlyFormat format = PlyFormat::ascii;
    std::vector<PlyElement> elements;
    std::size_t size = 0;  ///< bytes up to the data
};

inline PlyType ply_type(std::string_view name, const std::string& place) {
    constexpr std::array<std::array<std::string_view, 2>, 8> names = {{{"char", "int8"},
                                                                       {"uchar", "uint8"},
                                                                       {"short", "int16"},
                                                                       {"ushort", "uint16"},
                                                                       {"int", "int32"},
                                                                       {"uint", "uint32"},
                                                                       {"float", "float32"},
                                                                       {"double", "float64"}}};
    for (std::size_t i = 0; i < names.size(); ++i)
        if (name == names[i][0] || name == names[i][1]) return static_cast<PlyType>(i);
    fail_at(place, "there is no type " + in_quotes(name) + " in PLY; repair the header");
}

/// Reads a header line by line. Numbers are not compared with the file yet.
/// Source: Turk, "The PLY polygon file format", 1994.
class PlyHeaderReader {
 public:
    explicit PlyHeaderReader(std::string_view file) : file_(file) {}

    /// @throws Error(invalid_input)
    [[nodiscard]] PlyHeader read() {
        if (next_line() != "ply")
            fail_at(place(), "it is not 'ply' (so the file is no PLY file); name another file");
        while (true) {
            const std::string_view line = next_line();
            if (line == "end_header") break;
            statement(line);
        }
        if (!has_format_)
            fail_at("header", "it has no format (binary or ascii is not known); add the line");
        header_.size = at_;
        return header_;
    }

 private:
    [[nodiscard]] std::string place() const { return "header, line " + std::to_string(line_); }

    /// Without blanks at its end.
    std::string_view next_line() {
        const std::size_t end = file_.find('\n', at_);
        // Headers are a few lines; what follows in a damaged one may be gigabytes of numbers.
        if (end == std::string_view::npos || end - at_ > 4096)
            fail_at("header", "it has no end (the line end_header is missing after line " +
                                  std::to_string(line_) + "); repair or export the file again");
        std::string_view line = file_.substr(at_, end - at_);
        at_ = end + 1;
        ++line_;
        return line.substr(0, line.find_last_not_of(" \t\r") + 1);
    }

    void statement(std::string_view line) {
        std::vector<std::string_view> words;
        for_each_word(line, [&](std::string_view word) { words.push_back(word); });
        if (words.empty() || words[0] == "comment" || words[0] == "obj_info") return;
        const std::size_t n = words.size();
        if (words[0] == "format" && n == 3) return format(words[1], words[2]);
        if (words[0] == "element" && n == 3) return element(words[1], words[2]);
        const bool list = n > 1 && words[1] == "list";
        if (words[0] == "property" && n == (list ? 5u : 3u)) return property(words, list);
        fail_at(place(), "it is no statement of PLY (" + in_quotes(line) + "); repair the header");
    }

    void format(std::string_view name, std::string_view version) {
        if (version != "1.0" ||
            (name != "ascii" && name != "binary_little_endian" && name != "binary_big_endian"))
            fail_at(place(), "it is of format " + in_quotes(name) + ", version " +
                                 in_quotes(version) +
                                 " (PLY has ascii, binary_little_endian and binary_big_endian, "
                                 "version 1.0); export it anew");
        header_.format = name == "ascii"                  ? PlyFormat::ascii
                         : name == "binary_little_endian" ? PlyFormat::little_endian
                                                          : PlyFormat::big_endian;
        has_format_ = true;
    }

    void element(std::string_view name, std::string_view count) {
        PlyElement& to = header_.elements.emplace_back();
        to.name = name;
        to.line = line_;
        const char* end = count.data() + count.size();
        const auto read = std::from_chars(count.data(), end, to.count);
        if (read.ec != std::errc() || read.ptr != end)
            fail_at(place(),
                    "the number of elements is none (" + in_quotes(count) + "); repair the header");
    }

    void property(const std::vector<std::string_view>& words, bool list) {
        if (header_.elements.empty())
            fail_at(place(), "a property comes before the first element; repair the header");
        PlyProperty p;
        p.name = words.back();
        p.type = ply_type(words[list ? 3 : 1], place());
        if (list) {
            p.count_type = ply_type(words[2], place());
            if (*p.count_type == PlyType::float32 || *p.count_type == PlyType::float64)
                fail_at(place(), "lists are counted in " + in_quotes(words[2]) +
                                     " (no whole number); repair the header");
        }
        header_.elements.back().properties.push_back(std::move(p));
    }

    std::string_view file_;
    PlyHeader header_;
    bool has_format_ = false;
    std::size_t at_ = 0;
    std::size_t line_ = 0;
};

/// Bytes that the elements of a header take at least.
inline std::uint64_t ply_least_bytes(const PlyElement& element, PlyFormat format) {
    std::uint64_t one = 0;
    for (const PlyProperty& p : element.properties)
        // A digit and a blank or line end; an empty list is a zero.
        one += format == PlyFormat::ascii ? 2 : ply_size(p.count_type.value_or(p.type));
    return saturating_mul(one, element.count);
}

/// Compares the numbers of a header with the file, before memory is taken for them.
/// @throws Error(invalid_input)
inline void check_ply_counts(const PlyHeader& header, std::size_t file_size) {
    // The last number of a text needs no blank behind it.
    std::uint64_t left = file_size - header.size + (header.format == PlyFormat::ascii ? 1 : 0);
    for (const PlyElement& element : header.elements) {
        const std::uint64_t least = ply_least_bytes(element, header.format);
        const std::string place = "header, line " + std::to_string(element.line);
        if (element.properties.empty() && element.count > 0)
            fail_at(place, "element " + in_quotes(element.name) +
                               " has no properties (so nothing can follow); repair the header");
        if (least > left)
            fail_at(place, "it announces " + std::to_string(element.count) + " of '" +
                               element.name + "', at least " + std::to_string(least) +
                               " bytes, but " + std::to_string(left) +
                               " are left (the file is cut short or the header wrong); export it "
                               "again");
        left -= least;
    }
}

}  // namespace mir::detail
