// SPDX-License-Identifier: MIT
#pragma once

#include "io/detail/text_lines.hpp"
#include "io/detail/text_number.hpp"
#include "mir/core/limits.hpp"
#include "mir/scene/mesh.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <initializer_list>
#include <streambuf>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace mir::detail {

/// Numbers of one OBJ file, and its lines as a stream for tinyobjloader. That library takes what is
/// no number for zero and knows no lines: here every statement is checked before it gets it.
class ObjText : public std::streambuf {
 public:
    ObjText(std::string text, const Limits& limits, SceneReport& report)
        : text_(plain_lines(std::move(text))), limits_(limits), report_(report) {}

    [[nodiscard]] const std::vector<Vec3>& positions() const { return positions_; }
    [[nodiscard]] const std::vector<Vec3>& normals() const { return normals_; }
    /// Of the vertices, linear; all white when has_colors() is false.
    [[nodiscard]] const std::vector<Rgb>& colors() const { return colors_; }
    [[nodiscard]] bool has_colors() const { return has_colors_; }
    /// (0, 0) is the lower left of an image, (1, 1) the upper right.
    [[nodiscard]] const std::vector<Vec2>& texture_coordinates() const {
        return texture_coordinates_;
    }

    /// Names behind the last "mtllib".
    [[nodiscard]] const std::string& libraries() const { return libraries_; }
    /// True between "s 1" and "s off".
    [[nodiscard]] bool is_smooth() const { return is_smooth_; }
    /// "line 12", the one that was served last.
    [[nodiscard]] std::string place() const { return "line " + std::to_string(line_); }

 protected:
    int_type underflow() override;

 private:
    void ignore(const std::string& what) { ++report_.ignored[what]; }
    void check(std::size_t begin, std::size_t end);
    void vertex(std::string_view numbers);
    void normal(std::string_view numbers);
    void corners(std::size_t begin, std::string_view words);
    void check_corner(std::string_view word) const;
    void texture_coordinate(std::string_view numbers);
    std::size_t read(std::string_view line, const char* what, std::array<float, 8>& numbers,
                     std::size_t least = 3);

    std::string text_;
    const Limits& limits_;
    SceneReport& report_;
    std::vector<Vec3> positions_;
    std::vector<Rgb> colors_;
    std::vector<Vec3> normals_;
    bool has_colors_ = false;
    std::vector<Vec2> texture_coordinates_;
    std::size_t at_ = 0;
    std::size_t line_ = 0;
    std::string libraries_;
    bool is_smooth_ = false;
};

inline ObjText::int_type ObjText::underflow() {
    if (at_ == text_.size()) return traits_type::eof();
    const std::size_t begin = at_;
    std::size_t end = std::min(text_.find('\n', begin), text_.size());
    ++line_;
    // A backslash before the end carries the statement on in the next line.
    while (end < text_.size() && end > begin) {
        const std::size_t last = text_.find_last_not_of(' ', end - 1);
        if (last == std::string::npos || text_[last] != '\\') break;
        text_[last] = ' ';
        text_[end] = ' ';
        end = std::min(text_.find('\n', end), text_.size());
        ++line_;
    }
    at_ = std::min(end + 1, text_.size());
    check(begin, end);
    setg(text_.data() + begin, text_.data() + begin, text_.data() + at_);
    return traits_type::to_int_type(text_[begin]);
}

/// Checks a statement and blanks what tinyobjloader is not to read. It lies between two places of
/// the text. Blanked are a comment behind a face, and numbers that are read here, for it overflows
/// at long exponents.
inline void ObjText::check(std::size_t begin, std::size_t end) {
    const std::string_view whole(text_.data() + begin, end - begin);
    const std::string_view word = keyword_of(whole);
    if (word.empty()) return;
    const auto is = [&](std::initializer_list<std::string_view> words) {
        return std::find(words.begin(), words.end(), word) != words.end();
    };
    const std::string_view rest =
        whole.substr(static_cast<std::size_t>(word.data() - whole.data()) + word.size());
    if (is({"v", "vn", "vt", "f"})) {
        const auto blank_from = [&](std::size_t at) {
            std::fill(text_.begin() + static_cast<std::ptrdiff_t>(begin + at),
                      text_.begin() + static_cast<std::ptrdiff_t>(end), ' ');
        };
        blank_from(std::min(whole.find('#'), whole.size()));
        if (word == "f")
            return corners(begin + static_cast<std::size_t>(rest.data() - whole.data()), rest);
        if (word == "v") vertex(rest);
        if (word == "vn") normal(rest);
        if (word == "vt") texture_coordinate(rest);
        blank_from(0);
    } else if (is({"l", "p"})) {
        ignore(word == "l" ? "lines" : "points");
    } else if (word == "mtllib") {
        libraries_ = trimmed(rest);
    } else if (!is({"g", "o", "s", "usemtl"})) {
        ignore("statement " + in_quotes(word));
    } else if (word == "s") {
        is_smooth_ = false;
        for_each_word(rest, [&](std::string_view g) { is_smooth_ = g != "off" && g != "0"; });
    }
}

/// Numbers of a statement, eight at most; returns how many there are.
inline std::size_t ObjText::read(std::string_view line, const char* what,
                                 std::array<float, 8>& numbers, std::size_t least) {
    std::size_t count = 0;
    for_each_word(line, [&](std::string_view word) {
        if (count == numbers.size()) return;
        const auto number = leading_number(word);
        if (!number)
            fail_at(place(), std::string(what) + " is no number (" + in_quotes(word) +
                                 "); repair or export the file again");
        if (!number->rest.empty()) ignore("characters behind a number");
        numbers[count++] = checked_float(number->value, what, place());
    });
    if (count < least)
        fail_at(place(), std::string(what) + " has " + std::to_string(count) +
                             " numbers instead of " + std::to_string(least) +
                             "; repair or export the file again");
    return count;
}

inline void ObjText::vertex(std::string_view numbers) {
    std::array<float, 8> n{};
    const std::size_t count = read(numbers, "a vertex", n);
    check_limit(positions_.size() + 1, limits_.vertices, "vertices");
    positions_.emplace_back(n[0], n[1], n[2]);
    colors_.push_back({1.0f, 1.0f, 1.0f});
    if (count < 6) return;
    has_colors_ = true;
    colors_.back() = linear_color(n[3], n[4], n[5], "vertex colour", place(), report_);
}

inline void ObjText::normal(std::string_view numbers) {
    std::array<float, 8> n{};
    (void)read(numbers, "a normal", n);
    normals_.emplace_back(n[0], n[1], n[2]);
}

inline void ObjText::texture_coordinate(std::string_view numbers) {
    std::array<float, 8> n{};
    (void)read(numbers, "a texture coordinate", n, 1);
    check_limit(texture_coordinates_.size() + 1, limits_.vertices, "vertices");
    texture_coordinates_.emplace_back(n[0], n[1]);
}

/// Checks the corners of a face and removes slashes with nothing behind. They begin at a place of
/// the text; tinyobjloader would read on into the next corner.
inline void ObjText::corners(std::size_t begin, std::string_view words) {
    for_each_word(words, [&](std::string_view word) {
        check_corner(word);
        const std::size_t end = word.find_last_not_of('/') + 1;
        const auto at = static_cast<std::size_t>(word.data() - words.data()) + begin;
        std::fill(text_.begin() + static_cast<std::ptrdiff_t>(at + end),
                  text_.begin() + static_cast<std::ptrdiff_t>(at + word.size()), ' ');
    });
}

/// A corner: a whole number and up to two more behind slashes. Nothing stands for none.
inline void ObjText::check_corner(std::string_view word) const {
    constexpr std::size_t most_digits = 9;
    const auto is_index = [](std::string_view field) {
        if (field.starts_with('-') || field.starts_with('+')) field.remove_prefix(1);
        return !field.empty() && field.size() <= most_digits &&
               field.find_first_not_of("0123456789") == std::string_view::npos;
    };
    std::string_view rest = word;
    for (std::size_t fields = 0; fields < 3; ++fields) {
        const std::size_t slash = std::min(rest.find('/'), rest.size());
        const std::string_view field = rest.substr(0, slash);
        if (!is_index(field) && (fields == 0 || !field.empty())) break;
        if (slash == rest.size()) return;
        rest.remove_prefix(slash + 1);
    }
    fail_at(place(), "a corner of a face is none (" + in_quotes(word) +
                         ", where vertex/texture/normal is meant); repair the face");
}

}  // namespace mir::detail
