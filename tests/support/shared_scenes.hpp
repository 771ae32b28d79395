// SPDX-License-Identifier: MIT
#pragma once

#include <cstdlib>
#include <filesystem>
#include <optional>

namespace mirtest {

/// Folder of the shared test scenes, or nothing when this machine does not have it. Environment
/// variable MIR_SHARED_SCENES wins over the folder that CMake found.
inline std::optional<std::filesystem::path> shared_scenes() {
    namespace fs = std::filesystem;
    const char* from_environment = std::getenv("MIR_SHARED_SCENES");
#if defined(MIR_SHARED_SCENES_DIR)
    const fs::path folder = from_environment != nullptr ? from_environment : MIR_SHARED_SCENES_DIR;
#else
    const fs::path folder = from_environment != nullptr ? from_environment : "";
#endif
    if (!folder.empty() && fs::is_directory(folder)) return folder;
    return std::nullopt;
}

}  // namespace mirtest
