// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <string>
#include <vector>

namespace mirtest {

/// A kind of file that the library writes.
struct Writer {
    std::string name;  ///< of the file, which says the kind
    std::function<void(const std::filesystem::path&)> write;
};

/// All of them, with small contents that differ by `variant`.
std::vector<Writer> all_writers(int variant);

/// All bytes of a file; empty when there is none.
inline std::string bytes_of_file(const std::filesystem::path& path) {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

inline void write_older_file(const std::filesystem::path& path) {
    std::ofstream(path, std::ios::binary | std::ios::trunc) << "older file";
}

}  // namespace mirtest
