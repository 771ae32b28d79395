// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/error.hpp"
#include "mir/io/atomic_file.hpp"
#include "mir/io/detail/shown_path.hpp"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <ios>
#include <string>
#include <string_view>

namespace mir::detail {

/// Writes all bytes of a file. It appears under its name complete or not at all. `what` calls its
/// content in the error, such as "the report".
/// @throws Error(io)
inline void write_file(const std::filesystem::path& path, std::string_view bytes,
                       const char* what) {
    AtomicFile target(path);
    errno = 0;
    std::ofstream stream(target.temporary(), std::ios::binary | std::ios::trunc);
    stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    stream.close();
    if (!stream)
        throw Error(ErrorCode::io, shown_path(path) + ": " + what + " cannot be written (" +
                                       std::strerror(errno != 0 ? errno : EIO) +
                                       "); free space there or choose another folder");
    target.commit();
}

}  // namespace mir::detail
