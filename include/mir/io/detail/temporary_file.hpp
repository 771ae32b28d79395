// SPDX-License-Identifier: MIT
#pragma once

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <optional>
#include <string>
#include <system_error>
#include <utility>

namespace mir::detail {

/// An open file that nobody else has locked. The lock goes with the process, however it ends, and
/// so tells a file that is being written from one that was left over.
class LockedFile {
 public:
    LockedFile() = default;
    LockedFile(const LockedFile&) = delete;
    LockedFile& operator=(const LockedFile&) = delete;
    LockedFile(LockedFile&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}
    LockedFile& operator=(LockedFile&& other) noexcept {
        std::swap(descriptor_, other.descriptor_);
        return *this;
    }
    ~LockedFile() {
        if (descriptor_ >= 0) close(descriptor_);
    }

    /// Makes a new file of these permissions, less those that the process gives to none. No file,
    /// with errno, where there is one already or none can be. On file systems without locks it is
    /// not locked.
    static LockedFile create(const std::filesystem::path& path, mode_t permissions) {
        LockedFile file(open(path.c_str(), O_CREAT | O_EXCL | O_RDWR | O_CLOEXEC, permissions));
        if (!file) return {};
        const bool lost = flock(file.descriptor_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
        if (!lost && file.is_at(path)) return file;
        errno = EEXIST;  // another process took it for a left-over
        return {};
    }

    /// Locks a file that is there. None when another process has it, or its name is another's now.
    static LockedFile take(const std::filesystem::path& path) {
        LockedFile file(open(path.c_str(), O_RDWR | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK));
        const bool taken =
            file && flock(file.descriptor_, LOCK_EX | LOCK_NB) == 0 && file.is_at(path);
        return taken ? std::move(file) : LockedFile();
    }

    explicit operator bool() const { return descriptor_ >= 0; }

    /// Some file systems have none.
    void set_permissions(mode_t permissions) const {
        static_cast<void>(fchmod(descriptor_, permissions));
    }

 private:
    explicit LockedFile(int descriptor) : descriptor_(descriptor) {}

    [[nodiscard]] bool is_at(const std::filesystem::path& path) const {
        struct stat mine {};
        struct stat there {};
        return fstat(descriptor_, &mine) == 0 && lstat(path.c_str(), &there) == 0 &&
               mine.st_dev == there.st_dev && mine.st_ino == there.st_ino;
    }

    int descriptor_ = -1;
};

/// An empty file `.NAME.N.tmp` beside the file NAME that it will replace. N is the first that no
/// other writer has. Removed with the object, unless it was renamed. What killed processes left
/// over of NAME is removed first: nobody has it locked.
class TemporaryFile {
 public:
    /// `error()` says why there is none.
    explicit TemporaryFile(const std::filesystem::path& target) {
        std::error_code ignored;
        for (int i = 0, gap = 0; i < most_writers && gap < widest_gap; ++i, ++gap) {
            if (!std::filesystem::exists(name(target, i), ignored)) continue;
            remove_abandoned(name(target, i));
            gap = 0;
        }
        struct stat older {};
        if (stat(target.c_str(), &older) == 0) permissions_ = older.st_mode & 0777;
        for (int i = 0; i < most_writers && !file_; ++i) {
            path_ = name(target, i);
            file_ = LockedFile::create(path_, permissions_ ? 0600 : 0666);
            error_ = file_ ? 0 : errno;
            if (error_ != EEXIST) return;
        }
    }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;
    ~TemporaryFile() {
        std::error_code ignored;
        if (file_ && !renamed_) std::filesystem::remove(path_, ignored);
    }

    [[nodiscard]] int error() const { return error_; }
    [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }

    /// Gives the file its final name, and the former file's permissions. A second call does
    /// nothing.
    std::error_code rename(const std::filesystem::path& target) {
        std::error_code failure;
        if (!renamed_ && permissions_) file_.set_permissions(*permissions_);
        if (!renamed_) std::filesystem::rename(path_, target, failure);
        renamed_ = renamed_ || !failure;
        return failure;
    }

 private:
    static constexpr int most_writers = 1000;
    /// Names without a file after which no left-over is looked for.
    static constexpr int widest_gap = 8;

    static std::filesystem::path name(const std::filesystem::path& target, int i) {
        return target.parent_path() /
               ("." + target.filename().string() + "." + std::to_string(i) + ".tmp");
    }
    /// While it is locked its name is nobody else's.
    static void remove_abandoned(const std::filesystem::path& path) {
        std::error_code ignored;
        if (const LockedFile file = LockedFile::take(path)) std::filesystem::remove(path, ignored);
    }

    std::filesystem::path path_;
    LockedFile file_;
    int error_ = 0;
    bool renamed_ = false;
    std::optional<mode_t> permissions_;  ///< of the older file
};

}  // namespace mir::detail
