// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/error.hpp"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <string>
#include <system_error>

namespace mir {

/// A file that appears under its name complete or not at all: it is written under a temporary name
/// in the same folder and renamed by `commit`. Until then an older file of that name stays as it
/// was. Not thread-safe; several objects, processes included, may aim at one path, the last commit
/// wins.
class AtomicFile {
 public:
    /// Creates the empty temporary file, so that an unwritable folder is known before any work. A
    /// symbolic link is followed: the file it names is replaced, not the link.
    /// @throws Error(io) when the folder is missing or cannot be written, or when `path` exists and
    ///         is not a regular file (renaming would destroy a folder or a device).
    explicit AtomicFile(const std::filesystem::path& path) : target_(resolved(path)) {
        check_target();
        create_temporary();
    }
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;

    /// Removes the temporary file unless it was committed.
    ~AtomicFile() {
        std::error_code ignored;
        if (!committed_) std::filesystem::remove(temporary_, ignored);
    }

    /// Where to write. Open it, write, close it, then `commit`.
    [[nodiscard]] const std::filesystem::path& temporary() const noexcept { return temporary_; }

    /// Gives the finished file its name, replacing an older one. A second call does nothing.
    /// @throws Error(io) when renaming fails; the temporary file is then removed with the object.
    void commit() {
        if (committed_) return;
        std::error_code failure;
        std::filesystem::rename(temporary_, target_, failure);
        if (failure) fail("the finished file cannot be renamed to it", failure.message());
        committed_ = true;
    }

 private:
    static std::filesystem::path resolved(const std::filesystem::path& path) {
        std::error_code failure;
        if (!std::filesystem::is_symlink(path, failure)) return path;
        auto followed = std::filesystem::weakly_canonical(path, failure);
        return failure ? path : followed;
    }

    void check_target() const {
        if (!target_.has_filename())
            throw Error(ErrorCode::io, "'" + target_.string() +
                                           "': it names no file (the path ends in a folder); add "
                                           "a file name");
        std::error_code failure;
        const auto status = std::filesystem::status(target_, failure);
        if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
            fail("it exists and is no regular file", "a finished file is renamed over it");
    }

    void create_temporary() {
        // Exclusive creation makes the name ours; numbers left over from a killed process and
        // those of other writers are passed by.
        constexpr int tries = 1000;
        for (int i = 0; i < tries; ++i) {
            temporary_ = target_.parent_path() /
                         ("." + target_.filename().string() + "." + std::to_string(i) + ".tmp");
            errno = 0;
            if (std::FILE* file = std::fopen(temporary_.string().c_str(), "wbx")) {
                std::fclose(file);
                return;
            }
            if (errno != EEXIST) break;
        }
        fail("it cannot be written", std::strerror(errno));
    }

    [[noreturn]] void fail(const std::string& what, const std::string& reason) const {
        throw Error(ErrorCode::io, target_.string() + ": " + what + " (" + reason +
                                       "); choose a folder that exists, may be written and has "
                                       "room, or another name");
    }

    std::filesystem::path target_;
    std::filesystem::path temporary_;
    bool committed_ = false;
};

}  // namespace mir
