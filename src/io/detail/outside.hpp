// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <new>
#include <string>
#include <system_error>

namespace mir::detail {

/// `path` without links, as far as it exists. What cannot be followed (a loop of links, a name that
/// is too long) cannot be opened either: it is taken as written.
inline std::filesystem::path resolved(const std::filesystem::path& path) {
    namespace fs = std::filesystem;
    std::error_code failure;
    const fs::path whole = fs::absolute(path, failure);
    if (failure) return path.lexically_normal();
    const fs::path followed = fs::weakly_canonical(whole, failure);
    // Memory that fails says nothing about the file.
    if (failure == std::errc::not_enough_memory) throw std::bad_alloc();
    return failure ? whole.lexically_normal() : followed;
}

/// True when `file` does not lie in `folder` or below, links followed. It is relative to `folder`
/// or absolute. A scene from a stranger has no business elsewhere on the machine.
inline bool leads_outside(const std::filesystem::path& folder, const std::filesystem::path& file) {
    // The system would see the name up to its zero alone; a drive is Windows' absolute name.
    const std::string name = file.string();
    const bool has_drive = name.size() > 1 && name[1] == ':' && name.find_first_of("/\\") == 2;
    if (has_drive || name.find('\0') != std::string::npos) return true;
    const std::filesystem::path home = resolved(folder.empty() ? "." : folder);
    const std::filesystem::path place = resolved(folder / file);
    // A folder that ends in a slash ends in an empty name.
    const auto end = home.has_filename() ? home.end() : std::prev(home.end());
    return std::mismatch(home.begin(), end, place.begin(), place.end()).first != end;
}

}  // namespace mir::detail
