// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <filesystem>
#include <new>
#include <string>
#include <system_error>

namespace mir::detail {

/// Whether the file that a scene in `folder` names as `name` lies outside of that folder: by an
/// absolute name, by `..`, or by a link that leads away. A scene from a stranger has no business
/// elsewhere on the machine. What is not there lies where its name says.
inline bool lies_outside(const std::filesystem::path& folder, const std::filesystem::path& name) {
    namespace fs = std::filesystem;
    // The system would see the name up to its zero alone; a drive is Windows' absolute name.
    const std::string text = name.string();
    const bool has_drive = text.size() > 1 && text[1] == ':' && text.find_first_of("/\\") == 2;
    if (name.is_absolute() || has_drive || text.find('\0') != std::string::npos) return true;
    const fs::path inside = name.lexically_normal();
    if (!inside.empty() && *inside.begin() == "..") return true;
    std::error_code failure;
    const fs::path home = fs::weakly_canonical(folder.empty() ? "." : folder, failure);
    if (!failure) {
        const fs::path file = fs::weakly_canonical((folder.empty() ? "." : folder) / name, failure);
        const auto [rest, end] = std::mismatch(home.begin(), home.end(), file.begin(), file.end());
        if (!failure) return rest != home.end();
    }
    // Memory that fails says nothing about the file.
    if (failure == std::errc::not_enough_memory) throw std::bad_alloc();
    return true;
}

}  // namespace mir::detail
