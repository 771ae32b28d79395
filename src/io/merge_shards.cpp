// SPDX-License-Identifier: MIT
#include "mir/io/merge_shards.hpp"

#include "io/detail/shard_reader.hpp"

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

namespace mir {
namespace {

using Shards = std::vector<std::unique_ptr<detail::ShardReader>>;  ///< in their order

/// What of two pictures differs; empty where nothing does.
std::string difference(const ShardManifest& a, const ShardManifest& b) {
    if (a.scene_hash != b.scene_hash) return "shows another scene than";
    if (a.image != b.image) return "is of a picture of another size than";
    if (a.settings_hash != b.settings_hash) return "was rendered with other settings than";
    if (a.passes != b.passes) return "is of a picture of other passes than";
    if (a.shard.count != b.shard.count) return "is of a picture that was split otherwise than";
    if (a.look != b.look) return "asks for another file (--aov, --tone, --exposure) than";
    return {};
}

std::string missing(const std::vector<bool>& there) {
    std::string text;
    std::size_t named = 0;
    std::size_t others = 0;
    for (std::size_t i = 0; i < there.size(); ++i) {
        if (there[i]) continue;
        if (named == 8) {
            ++others;
            continue;
        }
        text += (named++ == 0 ? "" : ", ") + std::to_string(i + 1);
    }
    return others == 0 ? text : text + " and " + std::to_string(others) + " more";
}

Shards open_all(const std::vector<std::filesystem::path>& paths, const std::string& build) {
    expects(!paths.empty(), "no shard was given (there is nothing to merge); give all of them");
    Shards all;
    for (const auto& path : paths)
        all.push_back(std::make_unique<detail::ShardReader>(path, build));
    return all;
}

/// Sorts shards of one picture, all of which must be there.
void check_set(Shards& all) {
    const detail::ShardReader& first = *all.front();
    std::vector<const detail::ShardReader*> places(first.manifest().shard.count);
    for (const auto& one : all) {
        const std::string differs = difference(one->manifest(), first.manifest());
        if (!differs.empty())
            one->refuse("it " + differs + " " + first.name(), "give shards of one picture");
        const detail::ShardReader*& place = places[one->manifest().shard.number - 1];
        if (place != nullptr)
            one->refuse(
                "it is shard " + to_string(one->manifest().shard) + ", as is " + place->name(),
                "give each shard once");
        place = one.get();
    }
    std::vector<bool> there;
    for (const detail::ShardReader* const place : places) there.push_back(place != nullptr);
    if (std::find(there.begin(), there.end(), false) != there.end())
        throw Error(ErrorCode::invalid_input,
                    "shards of the picture are missing (" + missing(there) + " of " +
                        std::to_string(places.size()) + "); render them and merge again");
    std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) {
        return a->manifest().shard.number < b->manifest().shard.number;
    });
}

void check_passes(const detail::ShardReader& shard, const std::vector<ShardPass>& passes,
                  const std::vector<ShardPass>& of_first) {
    const std::uint32_t wanted = shard.manifest().passes;
    if (passes.size() != wanted || wanted == 0)
        shard.refuse("it holds " + std::to_string(passes.size()) + " of " + std::to_string(wanted) +
                         " passes",
                     "let its render go on with --resume");
    for (std::size_t i = 0; i < passes.size() && !of_first.empty(); ++i)
        if (passes[i].shared != of_first[i].shared)
            shard.refuse("its VPLs, rays or shares of light are not those of the first shard",
                         "render all shards on machines of one kind");
}

/// Numbers of each pass of the whole picture.
std::vector<RenderStatistics> numbers_of(const std::vector<std::vector<ShardPass>>& shards) {
    std::vector<RenderStatistics> numbers;
    for (std::size_t pass = 0; pass < shards.front().size(); ++pass) {
        std::vector<const ShardPass*> parts;
        for (const auto& shard : shards) parts.push_back(&shard[pass]);
        numbers.push_back(merged(parts));
    }
    return numbers;
}

}  // namespace

MergedPicture merge_shards(const std::vector<std::filesystem::path>& shards,
                           const std::string& build) {
    Shards all = open_all(shards, build);
    check_set(all);
    ShardPasses picture;
    std::vector<std::vector<ShardPass>> passes;
    for (const auto& shard : all) {
        shard->read(picture);
        check_passes(*shard, picture.passes, passes.empty() ? picture.passes : passes.front());
        passes.push_back(std::move(picture.passes));
    }
    picture.sums.restate(numbers_of(passes));
    MergedPicture merged{picture.sums.result(), all.front()->manifest()};
    std::vector<std::string>& warnings = merged.result.warnings;
    const std::vector<std::string>& remarks = merged.manifest.remarks;
    warnings.insert(warnings.begin(), remarks.begin(), remarks.end());
    return merged;
}

}  // namespace mir
