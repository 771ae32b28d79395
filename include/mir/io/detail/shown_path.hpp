// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/printable.hpp"

#include <cstddef>
#include <filesystem>
#include <string>

namespace mir::detail {

/// A file's name at the front of a message. The folders before it may be many, so it is cut later
/// than other names.
inline std::string shown_path(const std::filesystem::path& path) {
    constexpr std::size_t longest = 1000;
    return printable(path.string(), longest);
}

}  // namespace mir::detail
