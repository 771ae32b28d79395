// SPDX-License-Identifier: MIT
#pragma once

#include "io/detail/rows_stream.hpp"
#include "mir/io/detail/shown_path.hpp"
#include "mir/io/shard_file.hpp"
#include "mir/version.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

namespace mir::detail {

/// How shards begin.
inline constexpr std::string_view shard_magic = "mir shard 1\n";

/// A shard. What it holds is read once its hash has confirmed all of it.
class ShardReader {
 public:
    /// Reads the manifest.
    /// @throws Error(invalid_input) for a file that is no whole shard of this version and build.
    ShardReader(std::filesystem::path path, const std::string& build) : path_(std::move(path)) {
        open();
        confirm();
        rewind();
        JournalReader in(stream_, left_);
        parse([&] { in(manifest_.version); });
        if (manifest_.version != version)
            refuse("it is of version " + manifest_.version + ", this is " + version,
                   "render all shards with one version");
        rewind();
        JournalReader all(stream_, left_);
        parse([&] {
            all(manifest_);
            check_manifest();
        });
        if (manifest_.build != build)
            refuse("another build made it: " + manifest_.build + ", this is " + build,
                   "render and merge with one program on machines of one kind");
        left_ = all.left();
        stream_.close();  // pictures may have more shards than a process may have open files
    }

    [[nodiscard]] const ShardManifest& manifest() const { return manifest_; }
    [[nodiscard]] std::string name() const { return shown_path(path_); }

    /// Reads what follows, once. Pixels go to their rows of `to.sums`, numbers replace others.
    /// @throws Error(invalid_input) when it is not what the manifest says.
    void read(ShardPasses& to) {
        const std::uint64_t manifest = whole_ - left_;
        open();
        confirm();
        rewind();
        stream_.seekg(static_cast<std::streamoff>(manifest), std::ios::cur);
        left_ -= manifest;
        JournalReader in(stream_, left_);
        parse([&] {
            to.passes.clear();
            in(to.passes);
            RowsReader(in, manifest_.image, manifest_.rows())(to.sums);
            if (to.sums.passes() != to.passes.size() || in.left() != 0) throw BrokenJournal{};
        });
        stream_.close();
    }

    /// @throws Error(invalid_input) that says why the file is of no use.
    [[noreturn]] void refuse(const std::string& reason, const std::string& remedy) const {
        throw Error(ErrorCode::invalid_input,
                    shown_path(path_) + ": this shard cannot be used (" + reason + "); " + remedy);
    }

 private:
    template <class Use>
    void parse(const Use& use) const {
        try {
            use();
        } catch (const BrokenJournal&) {
            refuse_damaged();
        }
    }

    [[noreturn]] void refuse_damaged() const {
        refuse("it is damaged", "delete it and render it again");
    }

    void open() {
        std::error_code failure;
        const std::uintmax_t bytes = std::filesystem::file_size(path_, failure);
        stream_.open(path_, std::ios::binary);
        if (failure || !stream_) refuse("it cannot be read", "give shards of mir render --shard");
        std::array<char, shard_magic.size()> start{};
        stream_.read(start.data(), start.size());
        const std::string_view begin(start.data(), start.size());
        if (!stream_ || begin != shard_magic)
            refuse("it does not begin like a shard of this version",
                   "give shards that mir render --shard of one version made");
        if (bytes < shard_magic.size() + sizeof(std::uint64_t)) refuse_damaged();
        whole_ = bytes - shard_magic.size() - sizeof(std::uint64_t);
    }

    /// Asks the hash at the end, before anything is believed.
    void confirm() {
        ByteHash hash;
        std::array<char, 1 << 16> piece{};
        for (std::uint64_t left = whole_; left > 0;) {
            const std::uint64_t n = std::min<std::uint64_t>(left, piece.size());
            stream_.read(piece.data(), static_cast<std::streamsize>(n));
            if (!stream_) refuse_damaged();
            hash.add(piece.data(), n);
            left -= n;
        }
        std::uint64_t kept = 0;
        stream_.read(reinterpret_cast<char*>(&kept), sizeof kept);
        if (!stream_ || kept != hash.value()) refuse_damaged();
    }

    void rewind() {
        stream_.clear();
        stream_.seekg(static_cast<std::streamoff>(shard_magic.size()));
        left_ = whole_;
    }

    void check_manifest() const {
        const ShardNumber s = manifest_.shard;
        const Extent image = manifest_.image;
        if (image.width == 0 || image.width > 65536 || image.height > 65536 ||
            s.count > std::min(image.height, max_shards) || s.number < 1 || s.number > s.count)
            throw BrokenJournal{};
    }

    std::filesystem::path path_;
    std::ifstream stream_;
    std::uint64_t whole_ = 0;  ///< bytes between the magic and the hash
    std::uint64_t left_ = 0;   ///< of those, not read yet
    ShardManifest manifest_;
};

}  // namespace mir::detail
