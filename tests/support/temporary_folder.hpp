// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <stdexcept>
#include <string>

namespace mirtest {

/// An empty folder of its own, also among tests that run at the same time. It goes away with the
/// object.
class TemporaryFolder {
 public:
    explicit TemporaryFolder(const std::string& name) {
        const auto parent = std::filesystem::temp_directory_path();
        // Another process may take a name, or give it back, while it is asked for.
        for (int i = 0; path_.empty() && i < 10000; ++i) {
            const auto candidate = parent / ("mir_test_" + name + "_" + std::to_string(i));
            std::error_code taken;
            if (std::filesystem::create_directory(candidate, taken)) path_ = candidate;
        }
        if (path_.empty()) throw std::runtime_error("no folder can be made in " + parent.string());
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;
    ~TemporaryFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }

    [[nodiscard]] std::filesystem::path operator/(const std::string& name) const {
        return path_ / name;
    }

    /// Number of files and folders in it.
    [[nodiscard]] std::size_t files() const {
        std::size_t n = 0;
        for ([[maybe_unused]] const auto& file : std::filesystem::directory_iterator(path_)) ++n;
        return n;
    }

 private:
    std::filesystem::path path_;
};

}  // namespace mirtest
