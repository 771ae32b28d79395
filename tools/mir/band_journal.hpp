// SPDX-License-Identifier: MIT
#pragma once

#include "alarm.hpp"
#include "mir/core/byte_hash.hpp"
#include "mir/io/atomic_file.hpp"
#include "mir/runtime/picture_keeper.hpp"

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace mirtool {

/// The file in which the lead of a team keeps the bands of the pass under way.
class BandJournal final : public mir::PictureKeeper {
 public:
    /// Keeps bands every so many seconds.
    /// @throws mir::Error(io) when `path` cannot be written.
    BandJournal(std::filesystem::path path, double seconds)
        : path_(std::move(path)), save_(seconds) {
        const mir::AtomicFile probe(path_);
    }

    [[nodiscard]] std::vector<std::byte> read() override {
        std::ifstream stream(path_, std::ios::binary);
        const std::string all{std::istreambuf_iterator<char>(stream), {}};
        std::uint64_t hash = 0;
        if (all.empty()) return {};
        if (all.size() > sizeof hash) std::memcpy(&hash, all.data(), sizeof hash);
        const auto* const first = reinterpret_cast<const std::byte*>(all.data());
        std::vector<std::byte> picture(first + std::min(all.size(), sizeof hash),
                                       first + all.size());
        if (picture.empty() || hash != hash_of(picture))
            throw mir::Error(mir::ErrorCode::invalid_argument,
                             mir::detail::shown_path(path_) +
                                 ": the bands in it cannot be continued (it is damaged); delete "
                                 "the file");
        return picture;
    }
    [[nodiscard]] bool is_time() override { return save_.rings(); }
    void write(const std::vector<std::byte>& picture) override {
        mir::AtomicFile file(path_);
        errno = 0;
        std::ofstream stream(file.temporary(), std::ios::binary | std::ios::trunc);
        const std::uint64_t hash = hash_of(picture);
        stream.write(reinterpret_cast<const char*>(&hash), sizeof hash);
        stream.write(reinterpret_cast<const char*>(picture.data()),
                     static_cast<std::streamsize>(picture.size()));
        stream.close();
        if (!stream)
            throw mir::Error(mir::ErrorCode::io,
                             mir::detail::shown_path(path_) + ": the bands cannot be kept (" +
                                 std::strerror(errno != 0 ? errno : EIO) +
                                 "); free space there or render without --resume");
        file.commit();
    }

    /// Removes the file: the pictures in it are done.
    void remove() const {
        std::error_code ignored;
        std::filesystem::remove(path_, ignored);
    }

 private:
    static std::uint64_t hash_of(const std::vector<std::byte>& bytes) {
        mir::ByteHash hash;
        hash.add(bytes.data(), bytes.size());
        return hash.value();
    }

    std::filesystem::path path_;
    Alarm save_;
};

}  // namespace mirtool
