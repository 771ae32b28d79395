// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/error.hpp"
#include "mir/io/detail/shown_path.hpp"
#include "mir/io/detail/temporary_file.hpp"

#include <cstring>
#include <filesystem>
#include <string>
#include <system_error>

namespace mir {

/// A file that appears under its name complete or not at all. It is written under a temporary name
/// in the same folder and renamed by `commit`. Until then an older file of that name stays as it
/// was. A process that is killed leaves its temporary file, `.NAME.N.tmp`, to the next object for
/// that name, which removes it. A file that replaces an older one has its permissions, and nobody
/// else may read it before. Not thread-safe; several objects, processes included, may aim at one
/// path, the last commit wins.
class AtomicFile {
 public:
    /// Creates the empty temporary file, so that an unwritable folder is known before any work. A
    /// symbolic link is followed: the file it names is replaced, not the link.
    /// @throws Error(io) when the folder is missing or cannot be written, or when `path` exists and
    ///         is not a regular file (renaming would destroy a folder or a device).
    explicit AtomicFile(const std::filesystem::path& path)
        : target_(checked(resolved(path))), temporary_(target_) {
        if (temporary_.error() != 0)
            fail(target_, "it cannot be written", std::strerror(temporary_.error()));
    }

    /// Where to write. Open it, write, close it, then `commit`.
    [[nodiscard]] const std::filesystem::path& temporary() const noexcept {
        return temporary_.path();
    }

    /// Gives the finished file its name, replacing an older one. A second call does nothing.
    /// @throws Error(io) when renaming fails; the temporary file is then removed with the object.
    void commit() {
        if (const std::error_code failure = temporary_.rename(target_))
            fail(target_, "the finished file cannot be renamed to it", failure.message());
    }

 private:
    static std::filesystem::path resolved(const std::filesystem::path& path) {
        std::error_code failure;
        if (!std::filesystem::is_symlink(path, failure)) return path;
        auto followed = std::filesystem::weakly_canonical(path, failure);
        return failure ? path : followed;
    }

    static std::filesystem::path checked(std::filesystem::path target) {
        if (!target.has_filename())
            throw Error(ErrorCode::io, "'" + detail::shown_path(target) +
                                           "': it names no file (the path ends in a folder); add "
                                           "a file name");
        std::error_code failure;
        const auto status = std::filesystem::status(target, failure);
        // A loop of links, a name that is too long, a folder that may not be entered.
        if (status.type() == std::filesystem::file_type::none)
            fail(target, "it cannot be written", failure.message());
        if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
            fail(target, "it exists and is no regular file", "a finished file is renamed over it");
        return target;
    }

    [[noreturn]] static void fail(const std::filesystem::path& target, const std::string& what,
                                  const std::string& reason) {
        throw Error(ErrorCode::io, detail::shown_path(target) + ": " + what + " (" + reason +
                                       "); choose a folder that exists, may be written and has "
                                       "room, or another name");
    }

    std::filesystem::path target_;
    detail::TemporaryFile temporary_;
};

}  // namespace mir
