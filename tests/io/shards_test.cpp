// SPDX-License-Identifier: MIT
//
// Shards of a picture, and what their merge refuses.
#include "mir/core/byte_hash.hpp"
#include "mir/io/merge_shards.hpp"
#include "mir/io/shard_file.hpp"
#include "mir/runtime/shard_render.hpp"
#include "mir/scenes.hpp"
#include "runtime/noise_renderer.hpp"
#include "support/catch.hpp"
#include "support/temporary_folder.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>

using mirtest::NoiseRenderer;
using mirtest::same_bits;
using Paths = std::vector<std::filesystem::path>;

namespace {

const mir::Scene scene;
const std::string this_build = "a build";

mir::RenderSettings small_settings() {
    mir::RenderSettings s;
    s.image = {3, 5};
    s.seed = 5;
    return s;
}

/// What of a shard a test wants otherwise.
struct Wanted {
    mir::ShardNumber shard{1, 1};
    mir::RenderSettings settings = small_settings();
    std::uint32_t passes = 2;
    std::uint32_t stop = 2;  ///< passes that are done
    std::string build = this_build;
    std::string version = mir::version;
    std::string look = "plain";
};

NoiseRenderer renderer(std::size_t earlier = 0) {
    NoiseRenderer noise;
    noise.bounces = {1, 2};
    noise.earlier = earlier;
    return noise;
}

mir::ShardManifest manifest_of(const Wanted& w) {
    mir::ShardManifest m = mir::shard_manifest(scene, w.settings, w.passes, w.shard);
    m.build = w.build;
    m.version = w.version;
    m.look = w.look;
    m.recipe = {"render", "a scene"};
    m.remarks = {"a remark of the program"};
    return m;
}

void write_shard(const std::filesystem::path& path, const Wanted& w) {
    const mir::ShardFile file(path, manifest_of(w));
    mir::ShardPasses done = file.read();
    const NoiseRenderer noise = renderer(done.passes.size());
    mir::ShardRender render(noise, scene, w.settings, w.shard, w.passes, nullptr,
                            std::move(done.sums), std::move(done.passes));
    while (render.passes().size() < w.stop) render.next_pass();
    file.write(render.sums(), render.passes());
}

mir::RenderResult whole() {
    const NoiseRenderer noise = renderer();
    mir::ProgressiveRender render(noise, scene, small_settings(), {.passes = 2});
    while (!render.is_complete()) render.next_pass();
    return render.result();
}

/// All shards of the picture, in their order.
Paths all_shards(const mirtest::TemporaryFolder& folder, std::uint32_t count) {
    Paths paths;
    for (std::uint32_t k = 1; k <= count; ++k) {
        paths.push_back(folder / (std::to_string(k) + ".shard"));
        write_shard(paths.back(), {.shard = {k, count}});
    }
    return paths;
}

std::string bytes_of(const std::filesystem::path& path) {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

void write_bytes(const std::filesystem::path& path, const std::string& bytes) {
    std::ofstream(path, std::ios::binary) << bytes;
}

/// Checks that a merge is refused in a sentence with these words.
void check_refused(const Paths& paths, const std::string& part) {
    try {
        static_cast<void>(mir::merge_shards(paths, this_build));
        FAIL("they were merged");
    } catch (const mir::Error& e) {
        INFO(e.what());
        CHECK(e.code() == mir::ErrorCode::invalid_input);
        CHECK(std::string(e.what()).find(part) != std::string::npos);
    }
}

/// Gives bytes that were altered the hash of a shard that was not.
std::string rehashed(std::string bytes) {
    const std::size_t begin = std::string("mir shard 1\n").size();
    const std::size_t end = bytes.size() - sizeof(std::uint64_t);
    mir::ByteHash hash;
    hash.add(bytes.data() + begin, end - begin);
    const std::uint64_t value = hash.value();
    std::copy_n(reinterpret_cast<const char*>(&value), sizeof value, bytes.begin() + end);
    return bytes;
}

}  // namespace

TEST_CASE("shards in any order make the bits of a whole picture") {
    const mir::RenderResult a = whole();
    for (const std::uint32_t count : {1u, 2u, 3u, 5u}) {
        CAPTURE(count);
        const mirtest::TemporaryFolder folder("shards");
        Paths paths = all_shards(folder, count);
        std::rotate(paths.begin(), paths.begin() + count / 2, paths.end());
        const mir::MergedPicture merged = mir::merge_shards(paths, this_build);
        const mir::RenderResult& b = merged.result;
        for (const auto layer : {&mir::RenderResult::beauty, &mir::RenderResult::emission,
                                 &mir::RenderResult::direct, &mir::RenderResult::indirect})
            CHECK(same_bits(a.*layer, b.*layer));
        REQUIRE(b.bounces.size() == 2);
        for (std::size_t i = 0; i < 2; ++i) CHECK(same_bits(a.bounces[i], b.bounces[i]));
        CHECK(same_bits(a.guides.albedo, b.guides.albedo));
        CHECK(same_bits(a.guides.depth, b.guides.depth));
        CHECK(a.statistics.relative_error == b.statistics.relative_error);
        CHECK(a.statistics.path_luminance == b.statistics.path_luminance);
        CHECK(a.statistics.light_paths == b.statistics.light_paths);
        CHECK(a.statistics.complete == b.statistics.complete);
        CHECK(b.warnings.front() == "a remark of the program");
        CHECK(std::equal(a.warnings.begin(), a.warnings.end(), b.warnings.begin() + 1,
                         b.warnings.end()));
        CHECK(merged.manifest.recipe == std::vector<std::string>{"render", "a scene"});
    }
}

TEST_CASE("a shard goes on from the passes in its file, to the same bits") {
    const mirtest::TemporaryFolder folder("shards");
    Paths paths = all_shards(folder, 2);
    write_shard(folder / "b.shard", {.shard = {2, 2}, .stop = 1});
    write_shard(folder / "b.shard", {.shard = {2, 2}});
    CHECK(same_bits(mir::merge_shards({paths[0], folder / "b.shard"}, this_build).result.beauty,
                    whole().beauty));
    CHECK(folder.files() == 3);
    // Another part, other passes.
    for (const Wanted& other : {Wanted{.shard = {1, 2}}, Wanted{.shard = {2, 2}, .passes = 3}})
        CHECK_THROWS_AS(write_shard(folder / "b.shard", other), mir::Error);
}

TEST_CASE("a merge refuses shards that are missing, there twice, or of different pictures") {
    const mirtest::TemporaryFolder folder("shards");
    const Paths good = all_shards(folder, 3);
    const auto other = [&](const Wanted& w) {
        write_shard(folder / "other.shard", w);
        return Paths{good[0], good[1], folder / "other.shard"};
    };
    const mir::ShardNumber third{3, 3};
    check_refused({good[0], good[2]}, "shards of the picture are missing (2 of 3)");
    check_refused({good[0]}, "missing (2, 3 of 3)");
    check_refused({good[0], good[1], good[2], good[1]}, "it is shard 2 of 3, as is");
    check_refused(other({.shard = third, .stop = 1}), "it holds 1 of 2 passes");
    mir::RenderSettings seed = small_settings();
    seed.seed = 6;
    std::filesystem::remove(folder / "other.shard");
    check_refused(other({.shard = third, .settings = seed}), "rendered with other settings than");
    std::filesystem::remove(folder / "other.shard");
    mir::RenderSettings size = small_settings();
    size.image = {4, 5};
    check_refused(other({.shard = third, .settings = size}), "a picture of another size than");
    std::filesystem::remove(folder / "other.shard");
    check_refused(other({.shard = third, .passes = 3, .stop = 3}), "a picture of other passes");
    std::filesystem::remove(folder / "other.shard");
    check_refused(other({.shard = {3, 4}}), "split otherwise than");
    std::filesystem::remove(folder / "other.shard");
    check_refused(other({.shard = third, .look = "bright"}), "asks for another file");
    std::filesystem::remove(folder / "other.shard");
    check_refused(other({.shard = third, .build = "other"}), "another build made it: other");
    std::filesystem::remove(folder / "other.shard");
    check_refused(other({.shard = third, .version = "0.0.1"}), "it is of version 0.0.1");
    check_refused({folder / "none.shard"}, "it cannot be read");
    CHECK_THROWS_AS(mir::merge_shards({}, this_build), mir::Error);
}

TEST_CASE("a shard that was cut or altered anywhere is refused") {
    const mirtest::TemporaryFolder folder("shards");
    const std::filesystem::path path = all_shards(folder, 1).front();
    const std::string good = bytes_of(path);
    for (std::size_t i = 0; i < good.size(); ++i) {
        INFO("byte " << i << " of " << good.size());
        write_bytes(path, good.substr(0, i));
        check_refused({path}, "this shard cannot be used");
        std::string bad = good;
        bad[i] = static_cast<char>(bad[i] ^ (1 << i % 8));
        write_bytes(path, bad);
        check_refused({path}, "this shard cannot be used");
    }
    write_bytes(path, good + "x");
    check_refused({path}, "it is damaged");
}

TEST_CASE("sizes that lie in a shard whose hash is right are refused") {
    const mirtest::TemporaryFolder folder("shards");
    const std::filesystem::path path = all_shards(folder, 1).front();
    const std::string good = bytes_of(path);
    // Sizes of texts, lists and the first image stand between these.
    const std::size_t begin = good.find('\n') + 1;
    const std::size_t end = good.find("a remark of the program");
    REQUIRE(end != std::string::npos);
    for (std::size_t i = begin; i + 8 < end; ++i)
        for (const std::uint64_t lie : {~std::uint64_t{0}, std::uint64_t{1} << 33}) {
            INFO("byte " << i << ", " << lie);
            std::string bad = good;
            std::copy_n(reinterpret_cast<const char*>(&lie), sizeof lie, bad.begin() + i);
            write_bytes(path, rehashed(bad));
            try {
                static_cast<void>(mir::merge_shards({path}, this_build));
            } catch (const mir::Error& e) {
                CHECK(e.code() == mir::ErrorCode::invalid_input);
            }
        }
    std::string longer = good;
    longer.insert(longer.size() - 8, "more");
    write_bytes(path, rehashed(longer));
    check_refused({path}, "it is damaged");
}

TEST_CASE("shards that place other VPLs are told apart") {
    const mirtest::TemporaryFolder folder("shards");
    const Paths paths = all_shards(folder, 2);
    const mir::ShardFile file(paths[1], manifest_of({.shard = {2, 2}}));
    mir::ShardPasses passes = file.read();
    passes.passes[1].shared ^= 1;
    file.write(passes.sums, passes.passes);
    check_refused(paths, "its VPLs, rays or shares of light are not those of the first shard");
}

TEST_CASE("rows of shards cover an image once") {
    for (const std::uint32_t count : {1u, 3u, 7u}) {
        std::uint32_t next = 0;
        for (std::uint32_t k = 1; k <= count; ++k) {
            const mir::PixelRows rows = mir::rows_of({k, count}, 7);
            CHECK(rows.first == next);
            CHECK(rows.count >= 7 / count);
            next += rows.count;
        }
        CHECK(next == 7);
    }
    for (const mir::ShardNumber bad : {mir::ShardNumber{0, 2}, mir::ShardNumber{3, 2},
                                       mir::ShardNumber{1, 0}, mir::ShardNumber{1, 8}})
        CHECK_THROWS_AS(mir::rows_of(bad, 7), mir::Error);
}
