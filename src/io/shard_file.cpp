// SPDX-License-Identifier: MIT
#include "mir/io/shard_file.hpp"

#include "io/detail/shard_reader.hpp"
#include "mir/io/atomic_file.hpp"
#include "mir/runtime/settings_hash.hpp"
#include "mir/scene/scene_hash.hpp"

#include <cerrno>
#include <cstring>
#include <tuple>

namespace mir {

ShardManifest shard_manifest(const Scene& scene, const RenderSettings& settings,
                             std::uint32_t passes, ShardNumber shard) {
    static_cast<void>(rows_of(shard, settings.image.height));
    RenderSettings whole = settings;
    whole.rows = {};
    ShardManifest made;
    made.version = version;
    made.scene_hash = SceneHash(scene).hex();
    made.settings_hash = SettingsHash(whole).value();
    made.image = settings.image;
    made.passes = passes;
    made.shard = shard;
    return made;
}

ShardFile::ShardFile(std::filesystem::path path, ShardManifest manifest)
    : path_(std::move(path)), manifest_(std::move(manifest)) {
    const AtomicFile probe(path_);
}

ShardPasses ShardFile::read() const {
    std::error_code failure;
    if (!std::filesystem::exists(path_, failure) && !failure) return {};
    detail::ShardReader reader(path_, manifest_.build);
    const ShardManifest& found = reader.manifest();
    const auto key = [](const ShardManifest& m) {
        return std::tie(m.scene_hash, m.settings_hash, m.image.width, m.image.height, m.passes,
                        m.shard.number, m.shard.count);
    };
    if (key(found) != key(manifest_))
        reader.refuse("it is of another scene, of other settings or another part",
                      "delete it to start from nothing, or write another file");
    ShardPasses passes;
    reader.read(passes);
    return passes;
}

void ShardFile::write(const PassSums& sums, const std::vector<ShardPass>& passes) const {
    AtomicFile file(path_);
    errno = 0;
    std::ofstream stream(file.temporary(), std::ios::binary | std::ios::trunc);
    stream << detail::shard_magic;
    detail::JournalWriter writer(stream);
    writer(manifest_, passes);
    detail::RowsWriter(writer, manifest_.rows())(sums);
    const std::uint64_t hash = writer.hash();
    writer(hash);
    stream.close();
    if (!stream)
        throw Error(ErrorCode::io, detail::shown_path(path_) + ": the shard cannot be written (" +
                                       std::strerror(errno != 0 ? errno : EIO) +
                                       "); free space there or choose another folder");
    file.commit();
}

}  // namespace mir
