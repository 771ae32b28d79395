// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/error.hpp"
#include "mir/core/limits.hpp"
#include "mir/io/detail/shown_path.hpp"

#include <cerrno>
#include <cstdint>
#include <cstring>
#include <exception>
#include <filesystem>
#include <fstream>
#include <new>
#include <string>
#include <system_error>
#include <vector>

namespace mir::detail {

using Bytes = std::vector<unsigned char>;

/// ".obj" for "Box.OBJ".
inline std::string lower_case_extension(const std::filesystem::path& path) {
    std::string ending = path.extension().string();
    for (char& c : ending)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return ending;
}

/// Files may be read until `left` bytes are used up, whatever their number.
struct FileBudget {
    explicit FileBudget(const Limits& limits) : left(limits.file_bytes), all(limits.file_bytes) {}

    std::uint64_t left;
    std::uint64_t all;
};

/// @throws Error(invalid_input) naming `path`; Error(limit_exceeded) before memory is taken.
inline Bytes read_whole_file(const std::filesystem::path& path, FileBudget& budget) {
    const auto fail = [&](const std::string& reason) {
        throw Error(ErrorCode::invalid_input, shown_path(path) + ": it cannot be read (" + reason +
                                                  "); name an existing, readable file");
    };
    std::error_code failure;
    const auto status = std::filesystem::status(path, failure);
    if (!std::filesystem::exists(status)) {
        const bool is_missing = failure == std::errc::no_such_file_or_directory;
        fail(failure && !is_missing ? failure.message() : "no such file");
    }
    // A pipe or a device could block or never end.
    if (!std::filesystem::is_regular_file(status)) fail("not a regular file");
    const std::uint64_t size = std::filesystem::file_size(path, failure);
    if (failure) fail(failure.message());
    if (size > budget.left) check_limit(size + budget.all - budget.left, budget.all, "file_bytes");
    budget.left -= size;
    Bytes bytes(size);
    errno = 0;
    std::ifstream stream(path, std::ios::binary);
    if (!stream ||
        !stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size)))
        fail(errno != 0 ? std::strerror(errno) : "it became shorter while it was read");
    return bytes;
}

/// What `read` returns; its failures become mir::Error with the file's name in front. `format`
/// completes "it is no valid ...".
template <class Read>
auto naming_file(const std::filesystem::path& path, const char* format, const Read& read) {
    const auto repeat = [&](ErrorCode code, const std::string& what, Where at) {
        const std::string file = shown_path(path);
        return Error(code, what.rfind(file, 0) == 0 ? what : file + ": " + what, at);
    };
    try {
        return read();
    } catch (const Error& error) {
        throw repeat(error.code(), error.what(), error.where());
    } catch (const std::bad_alloc&) {
        throw repeat(ErrorCode::limit_exceeded,
                     "there is not enough memory to read it (or it declares absurd sizes); use a "
                     "smaller scene",
                     Where::here());
    } catch (const std::exception& error) {
        throw repeat(ErrorCode::invalid_input,
                     std::string("it is no valid ") + format + " file (" + error.what() +
                         "); repair or export it again",
                     Where::here());
    }
}

}  // namespace mir::detail
