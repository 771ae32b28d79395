// SPDX-License-Identifier: MIT
#include "tool/exr_file.hpp"
#include "tool/mir_program.hpp"

#include <nlohmann/json.hpp>

using namespace mirtest;
using nlohmann::json;

TEST_CASE("a render's statistics come as JSON, and nothing else on standard output") {
    const TemporaryFolder folder("render_json");
    const Outcome outcome =
        run_mir(small_render(folder / "a.exr") + Words{"--sampler", "ir", "--json", "--seed", "5"});
    REQUIRE(outcome.exit_code == 0);
    CHECK(outcome.err.empty());
    const json all = json::parse(outcome.out);
    CHECK(all.at("scene") == "builtin:cornell-box");
    CHECK(all.at("scene_hash") == attribute_of(folder / "a.exr", "mir:scene_hash"));
    CHECK(all.at("picture") == (folder / "a.exr").string());
    CHECK(all.at("preview") == (folder / "a.png").string());
    CHECK(all.at("width") == 24);
    CHECK(all.at("height") == 18);
    CHECK(all.at("seed") == 5);
    CHECK(all.at("sampler") == "ir");
    CHECK(all.at("scheduler") == "cpu-blocks");
    CHECK(all.at("triangles") == 36);
    CHECK(all.at("dropped_triangles") == 0);
    CHECK(all.at("luxels") == 4 * 24 * 18);
    CHECK(all.at("vpls").get<int>() > 0);
    CHECK(all.at("light_paths").get<int>() > 0);
    CHECK(all.at("contributions") == all.at("luxels").get<int>() * all.at("vpls").get<int>());
    for (const char* key : {"contributions_per_second", "emitted_power", "bound"})
        CHECK(all.at(key).get<double>() > 0.0);
    CHECK(all.at("non_lambertian_share") == 0.0);
    CHECK(all.at("widened_share") == 0.0);
    for (const char* key :
         {"removed_share", "removed_share_error", "cut_share", "cut_share_error", "direct_noise"})
        CHECK(all.at(key).get<double>() >= 0.0);
    CHECK_FALSE(all.contains("removed_tiles"));
    CHECK(all.at("vsl_radius") == 0.0);
    CHECK(all.at("residual_paths") == 0);
    CHECK(all.at("residual_luminance") == 0.0);
    CHECK(all.at("peak_memory_bytes").get<double>() > 1e6);
    CHECK(all.at("warnings").is_array());
    CHECK(all.at("normalisation") == "none");
    CHECK(all.at("indirect_luminance").get<double>() > 0.0);
    for (const char* key : {"path_luminance", "states", "dropped_share"})
        CHECK(all.at(key).get<double>() == 0.0);
    double light = 0.0;
    for (const json& each : all.at("light_budget")) light += each.at("share").get<double>();
    CHECK(light == Approx(1.0));
    const json& seconds = all.at("seconds");
    for (const char* key :
         {"upload", "bootstrap", "paths", "residual", "visibility", "response", "download"})
        CHECK(seconds.at(key).get<double>() == 0.0);
    double sum = 0.0;
    for (const char* key :
         {"geometry", "build", "bound", "sampling", "gbuffer", "direct", "reconstruction",
          "light_budget", "caustics", "film", "guides", "hash", "other"}) {
        CHECK(seconds.at(key).get<double>() > 0.0);
        sum += seconds.at(key).get<double>();
    }
    CHECK(seconds.at("total").get<double>() == Approx(sum));
    CHECK(seconds.size() == 23);
}

TEST_CASE("what the bound removed is told by tiles beside its layer") {
    const TemporaryFolder folder("removed_tiles");
    const Outcome outcome = run_mir(small_render(folder / "a.exr") +
                                    Words{"--sampler", "ir", "--aov", "removed", "--filter", "box",
                                          "--json", "--bound", "0.5"});
    REQUIRE(outcome.exit_code == 0);
    const json all = json::parse(outcome.out);
    const json& tiles = all.at("removed_tiles");
    CHECK(tiles.at("side") == 8);
    REQUIRE(tiles.at("columns") == 3);
    REQUIRE(tiles.at("rows") == 3);
    double sum = 0.0;
    for (std::size_t i = 0; i < 9; ++i)  // 24 x 18 pixels: the lowest tiles have two rows
        sum += tiles.at("luminance").at(i).get<double>() * 8.0 * (i < 6 ? 8.0 : 2.0);
    CHECK(sum / (24.0 * 18.0) == Approx(all.at("removed_luminance").get<double>()).epsilon(1e-4));
    CHECK(sum > 0.0);
}

TEST_CASE("normalised VPLs give the image the luminance that the sampler found") {
    const TemporaryFolder folder("render_json_energy");
    const Outcome outcome =
        run_mir(small_render(folder / "a.exr") + Words{"--sampler", "mir", "--json"});
    REQUIRE(outcome.exit_code == 0);
    const json all = json::parse(outcome.out);
    CHECK(all.at("normalisation") == "full");
    CHECK(all.at("states").get<double>() > 0.0);
    for (const char* key : {"bootstrap", "sampling", "visibility", "response"})
        CHECK(all.at("seconds").at(key).get<double>() > 0.0);
    const double kept = 1.0 - all.at("dropped_share").get<double>();
    CHECK(all.at("indirect_luminance").get<double>() ==
          Approx(all.at("path_luminance").get<double>() * kept).epsilon(1e-5));
}

TEST_CASE("chains say in the JSON how they did") {
    const TemporaryFolder folder("render_json_chains");
    const Outcome outcome =
        run_mir(small_render(folder / "a.exr") + Words{"--json", "--chains", "4"});
    REQUIRE(outcome.exit_code == 0);
    const json chains = json::parse(outcome.out).at("chains");
    for (const char* key : {"large", "small", "bidirectional", "suffix"}) {
        const json& moves = chains.at(key);
        CHECK(moves.at("accepted").get<int>() <= moves.at("proposed").get<int>());
        CHECK(moves.at("rate").get<double>() <= 1.0);
    }
    CHECK(chains.at("recorded_states") == 16);
    CHECK(chains.at("distinct_vpls").get<int>() >= 1);
    CHECK(chains.at("effective_samples").get<double>() <= 16.0);
    CHECK(chains.at("split_r_hat").get<double>() > 0.0);
    CHECK(chains.at("capped") == false);
    const json& luminance = chains.at("path_luminance");
    CHECK(luminance.at("low").get<double>() < luminance.at("mean").get<double>());
    CHECK(luminance.at("high").get<double>() > luminance.at("mean").get<double>());
    CHECK(luminance.at("contributing").get<int>() <= luminance.at("paths").get<int>());
    CHECK(chains.at("large_step_luminance").at("mean").get<double>() > 0.0);
}

TEST_CASE("the mean radiance of the JSON is that of the file") {
    const TemporaryFolder folder("render_json_mean");
    const Outcome outcome =
        run_mir(small_render(folder / "a.exr") + Words{"--json", "--aov", "all"});
    const json means = json::parse(outcome.out).at("mean_radiance");
    for (const char* layer : {"beauty", "emission", "direct", "indirect"}) {
        const std::string name = layer == std::string("beauty") ? "" : layer;
        double red = 0.0;
        const auto image = mir::read_exr(folder / "a.exr", name).image;
        for (const mir::Rgb& pixel : image.pixels())
            red += static_cast<double>(pixel.r) / (24 * 18);
        CHECK(means.at(layer).at(0).get<double>() == Approx(red));
        CHECK(means.at(layer).size() == 3);
    }
}

TEST_CASE("warnings appear in the JSON even when the render is quiet") {
    const TemporaryFolder folder("render_json_warning");
    const Outcome outcome = run_mir(small_render(folder / "a.exr") +
                                    Words{"--json", "--sampler", "ir", "--bound", "0.0001"});
    CHECK(outcome.err.empty());
    const json warnings = json::parse(outcome.out).at("warnings");
    REQUIRE(warnings.size() == 1);
    CHECK(has(warnings[0].get<std::string>(), "the bound removed"));
}
