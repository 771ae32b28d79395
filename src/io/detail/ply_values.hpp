// SPDX-License-Identifier: MIT
#pragma once

#include "io/detail/ply_header.hpp"
#include "io/detail/text_number.hpp"
#include "mir/core/number_text.hpp"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

namespace mir::detail {

/// A complaint about the element that is being read. Its place is put in front where it is known,
/// for naming every element takes longer than reading it.
[[noreturn]] inline void fail_here(const std::string& problem) { fail_at("", problem); }

/// The numbers behind a PLY header, one after the other.
class PlyValues {
 public:
    PlyValues(std::string_view file, const PlyHeader& header)
        : file_(file), at_(header.size), format_(header.format) {}

    /// The next number of a type.
    /// @throws Error(invalid_input) at the end of the file, or where a text has none.
    [[nodiscard]] double next(PlyType type) {
        return format_ == PlyFormat::ascii ? from_text(type) : from_bytes(type);
    }

    /// The next list, whose length is checked against the rest of the file.
    void next_list(const PlyProperty& property, std::vector<double>& values) {
        const double count = next(*property.count_type);
        const std::size_t left = file_.size() - at_;
        // The last number of a text needs no blank behind it.
        const std::size_t most =
            format_ == PlyFormat::ascii ? (left + 1) / 2 : left / ply_size(property.type);
        if (count < 0.0 || count > static_cast<double>(most))
            fail_here("its list is of " + shortest_text(count) + " numbers, but the file has " +
                      std::to_string(left) + " bytes left; export the file again");
        values.clear();
        for (auto i = static_cast<std::size_t>(count); i > 0; --i)
            values.push_back(next(property.type));
    }

 private:
    [[noreturn]] static void fail_short() {
        fail_here("the file ends there (it is cut short); export it again");
    }

    [[nodiscard]] double from_text(PlyType type) {
        constexpr std::string_view blanks = " \t\r\n";
        const std::size_t begin = file_.find_first_not_of(blanks, at_);
        if (begin == std::string_view::npos) fail_short();
        at_ = std::min(file_.find_first_of(blanks, begin), file_.size());
        const std::string_view word = file_.substr(begin, at_ - begin);
        const auto number = leading_number(word);
        const bool whole = type != PlyType::float32 && type != PlyType::float64;
        if (!number || !number->rest.empty() ||
            (whole && number->value != std::floor(number->value)))
            fail_here(std::string("a ") + (whole ? "whole " : "") + "number was expected (" +
                      in_quotes(word) + " is none); repair or export the file again");
        return number->value;
    }

    [[nodiscard]] double from_bytes(PlyType type) {
        const std::size_t size = ply_size(type);
        if (size > file_.size() - at_) fail_short();
        std::uint64_t bits = 0;
        for (std::size_t i = 0; i < size; ++i) {
            const std::size_t shift = 8 * (format_ == PlyFormat::little_endian ? i : size - 1 - i);
            bits |= std::uint64_t{static_cast<unsigned char>(file_[at_ + i])} << shift;
        }
        at_ += size;
        switch (type) {
            case PlyType::int8:
                return static_cast<std::int8_t>(bits);
            case PlyType::int16:
                return static_cast<std::int16_t>(bits);
            case PlyType::int32:
                return static_cast<std::int32_t>(bits);
            case PlyType::float32:
                return std::bit_cast<float>(static_cast<std::uint32_t>(bits));
            case PlyType::float64:
                return std::bit_cast<double>(bits);
            default:
                return static_cast<double>(bits);
        }
    }

    std::string_view file_;
    std::size_t at_;
    PlyFormat format_;
};

}  // namespace mir::detail
