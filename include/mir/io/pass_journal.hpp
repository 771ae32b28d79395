// SPDX-License-Identifier: MIT
#pragma once

#include "mir/io/atomic_file.hpp"
#include "mir/io/detail/journal_stream.hpp"
#include "mir/io/detail/shown_path.hpp"
#include "mir/runtime/pass_sums.hpp"
#include "mir/runtime/settings_hash.hpp"
#include "mir/scene/scene_hash.hpp"
#include "mir/version.hpp"

#include <cerrno>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

namespace mir {

/// The file in which a progressive render keeps its sums. Another process can go on from them to
/// the bits that this one would have reached. It belongs to one scene, one set of settings
/// (SettingsHash) and one version of the library, and is good on machines of one kind. Nothing in
/// it is trusted that its hash does not confirm; it is no protection against forgery.
class PassJournal {
 public:
    /// Makes sure that `path` can be written.
    /// @throws Error(io).
    PassJournal(std::filesystem::path path, const Scene& scene, const RenderSettings& settings)
        : path_(std::move(path)), owner_(owner_of(scene, settings)) {
        const AtomicFile probe(path_);
    }

    /// The sums in the file; none where there is no file.
    /// @throws Error(invalid_argument) for a file that is damaged or belongs to another render.
    [[nodiscard]] PassSums read() const;

    /// Replaces the file as a whole.
    /// @throws Error(io) when it cannot be written; an older one stays as it was.
    void write(const PassSums& sums) const;

 private:
    static constexpr std::string_view magic = "mir passes 1\n";

    static std::string owner_of(const Scene& scene, const RenderSettings& settings) {
        return std::string(version) + " " + SceneHash(scene).hex() + " " +
               std::to_string(SettingsHash(settings).value());
    }

    [[nodiscard]] PassSums parse(std::istream& stream, std::uint64_t bytes) const;

    [[noreturn]] void refuse(const std::string& reason) const {
        throw Error(ErrorCode::invalid_argument,
                    detail::shown_path(path_) + ": the passes in it cannot be continued (" +
                        reason +
                        "); delete the file to start from nothing, or write another picture");
    }

    std::filesystem::path path_;
    std::string owner_;
};

inline void PassJournal::write(const PassSums& sums) const {
    AtomicFile file(path_);
    errno = 0;
    std::ofstream stream(file.temporary(), std::ios::binary | std::ios::trunc);
    stream << magic;
    detail::JournalWriter writer(stream);
    writer(owner_, sums);
    const std::uint64_t hash = writer.hash();
    writer(hash);
    stream.close();
    if (!stream)
        throw Error(ErrorCode::io, detail::shown_path(path_) + ": the passes cannot be kept (" +
                                       std::strerror(errno != 0 ? errno : EIO) +
                                       "); free space there or render without --resume");
    file.commit();
}

inline PassSums PassJournal::read() const {
    std::error_code failure;
    const std::uintmax_t bytes = std::filesystem::file_size(path_, failure);
    if (failure == std::errc::no_such_file_or_directory) return {};
    std::ifstream stream(path_, std::ios::binary);
    if (failure || !stream) refuse("it cannot be read");
    try {
        return parse(stream, bytes);
    } catch (const detail::BrokenJournal&) {
        refuse("it is damaged");
    }
}

inline PassSums PassJournal::parse(std::istream& stream, std::uint64_t bytes) const {
    std::string start(magic.size(), '\0');
    stream.read(start.data(), static_cast<std::streamsize>(start.size()));
    if (!stream || start != magic) refuse("it is no journal of this program");
    detail::JournalReader reader(stream, bytes - magic.size());
    std::string owner;
    reader(owner);
    if (owner != owner_) refuse("they are of another scene, other settings or another version");
    PassSums sums;
    reader(sums);
    const std::uint64_t hash = reader.hash();
    std::uint64_t kept = 0;
    reader(kept);
    if (kept != hash || reader.left() != 0) throw detail::BrokenJournal{};
    return sums;
}

}  // namespace mir
