// SPDX-License-Identifier: MIT
//
// Pictures that are put together of shards: the bytes of a whole render.
#include "tool/exr_file.hpp"
#include "tool/mir_program.hpp"

#include <nlohmann/json.hpp>

using namespace mirtest;

namespace {

Words shard(const std::filesystem::path& file, const std::string& number, const Words& more = {}) {
    Words words = small_render(file) + Words{"--shard", number};
    return words + more;
}

Words merge(const TemporaryFolder& folder, int count) {
    Words words{"merge", "--quiet", "-o", folder / "m.exr"};
    for (int k = count; k >= 1; --k) words.push_back(folder / (std::to_string(k) + ".shard"));
    return words;
}

}  // namespace

TEST_CASE("merged shards have the bytes of a whole render") {
    const TemporaryFolder folder("shards_same");
    const Words way = GENERATE(
        Words{}, Words{"--passes", "3", "--aov", "all,bounces,removed"},
        Words{"--sampler", "ir", "--luxels", "9", "--filter", "lanczos", "--compensate", "2"},
        Words{"--sampler", "ir", "--vsl", "--exposure", "1"},
        Words{"--sum", "cuts", "--picks", "4", "--aov", "indirect,pick_error", "--tile", "16"},
        Words{"--normalise", "prepass", "--prepass-luxels", "64", "--scheduler", "cpu"},
        Words{"--integrator", "path", "--samples", "2", "--passes", "2"},
        Words{"--integrator", "micro", "--surfels", "64"});
    CAPTURE(way);
    const Outcome whole = run_mir(small_render(folder / "a.exr") + way + Words{"--json"});
    REQUIRE(whole.exit_code == 0);
    for (int k = 1; k <= 3; ++k) {
        const std::string name = std::to_string(k);
        const Words other = k == 2 ? Words{"--threads", "1"} : Words{};
        REQUIRE(run_mir(shard(folder / (name + ".shard"), name + "/3", way + other)).exit_code ==
                0);
    }
    const Outcome merged = run_mir(merge(folder, 3) + Words{"--json"});
    REQUIRE(merged.exit_code == 0);
    CHECK((file_bytes(folder / "a.exr") == file_bytes(folder / "m.exr")));
    CHECK((file_bytes(folder / "a.png") == file_bytes(folder / "m.png")));
    // Statistics too, but for times and names.
    auto a = nlohmann::json::parse(whole.out);
    auto b = nlohmann::json::parse(merged.out);
    for (const char* other : {"seconds", "contributions_per_second", "peak_memory_bytes", "picture",
                              "preview", "convergence"}) {
        a.erase(other);
        b.erase(other);
    }
    CHECK(a == b);
}

TEST_CASE("a shard says what it is, and is refused where it does not belong") {
    const TemporaryFolder folder("shards_words");
    const Outcome first = run_mir(shard(folder / "1.shard", "1/2", {"--json"}));
    REQUIRE(first.exit_code == 0);
    const auto facts = nlohmann::json::parse(first.out);
    CHECK(facts.at("shard") == 1);
    CHECK(facts.at("shards") == 2);
    CHECK(facts.at("first_row") == 0);
    CHECK(facts.at("rows") == 9);
    const Words alone{"merge", "-q", folder / "1.shard", "-o", folder / "m.exr"};
    check_failure(run_mir(alone), 3, "shards of the picture are missing (2 of 2)");
    REQUIRE(run_mir(shard(folder / "2.shard", "2/2", {"--seed", "1"})).exit_code == 0);
    check_failure(run_mir(merge(folder, 2)), 3, "was rendered with other settings than");
    CHECK_FALSE(std::filesystem::exists(folder / "m.exr"));
    for (const char* bad : {"0/2", "3/2", "1", "1/", "a/b", "1/65537"})
        check_failure(run_mir(shard(folder / "3.shard", bad)), 2, "is no part of a picture");
    check_failure(run_mir(shard(folder / "3.shard", "1/19")), 2, "more shards than it has rows");
    check_failure(run_mir(shard(folder / "3.shard", "1/2", {"--time", "1"})), 2, "--passes");
    check_failure(run_mir(shard(folder / "3.shard", "1/2", {"--report", folder / "a.html"})), 2,
                  "a shard has no preview, report or VPLs of its own");
    check_failure(run_mir(shard(folder / "3.shard", "1/2", {"--denoise"})), 2,
                  "a shard is not denoised");
    CHECK_FALSE(std::filesystem::exists(folder / "3.shard"));
}

TEST_CASE("two workers may write one shard at the same time", "[extended]") {
    const TemporaryFolder folder("shards_twice");
    const Words passes{"--passes", "4"};
    REQUIRE(run_mir(small_render(folder / "a.exr") + passes).exit_code == 0);
    for (const char* name : {"1", "2", "3"}) {
        const Words words = shard(folder / (std::string(name) + ".shard"), std::string(name) + "/3",
                                  passes + Words{"--resume", "--save-every", "0"});
        RunningProgram one(mir_command(words));
        RunningProgram two(mir_command(words));
        CHECK(one.wait().exit_code == 0);
        CHECK(two.wait().exit_code == 0);
    }
    REQUIRE(run_mir(merge(folder, 3)).exit_code == 0);
    CHECK((file_bytes(folder / "a.exr") == file_bytes(folder / "m.exr")));
    CHECK((file_bytes(folder / "a.png") == file_bytes(folder / "m.png")));
    CHECK(folder.files() == 7);  // pictures and shards, nothing left over
}
