// SPDX-License-Identifier: MIT
#include "mir/version.hpp"
#include "tool/exr_file.hpp"
#include "tool/mir_program.hpp"

#include <nlohmann/json.hpp>

#include <set>

using namespace mirtest;

namespace {

/// Runs a render that must succeed without a word on standard error.
Outcome render(const Words& arguments) {
    Outcome outcome = run_mir(arguments);
    INFO(outcome.err);
    REQUIRE(outcome.exit_code == 0);
    CHECK(outcome.err.empty());
    return outcome;
}

/// "width x height" of a PNG file.
std::string png_size(const std::filesystem::path& path) {
    const std::string bytes = file_bytes(path);
    if (bytes.size() < 24 || bytes.compare(0, 4, "\x89PNG") != 0) return "no PNG";
    const auto number = [&](std::size_t at) {
        unsigned n = 0;
        for (std::size_t i = 0; i < 4; ++i) n = n << 8 | static_cast<unsigned char>(bytes[at + i]);
        return std::to_string(n);
    };
    return number(16) + "x" + number(20);
}

std::string exr_size(const std::filesystem::path& path) {
    const mir::Extent extent = mir::read_exr(path).image.extent();
    return std::to_string(extent.width) + "x" + std::to_string(extent.height);
}

}  // namespace

TEST_CASE("a render writes a picture and a preview of the size asked for, and names both") {
    const TemporaryFolder folder("render");
    const Outcome outcome = render(small_render(folder / "a.exr"));
    CHECK(outcome.out == (folder / "a.exr").string() + "\n" + (folder / "a.png").string() + "\n");
    CHECK(exr_size(folder / "a.exr") == "24x18");
    CHECK(png_size(folder / "a.png") == "24x18");
    CHECK(folder.files() == 2);
}

TEST_CASE("a render tells on standard error what it did, unless it shall be quiet") {
    const TemporaryFolder folder("render_summary");
    Words loud = small_render(folder / "a.exr");
    loud.pop_back();
    const Outcome outcome = run_mir(loud);
    CHECK(outcome.exit_code == 0);
    CHECK(has(outcome.err, "36 triangles, 1728 luxels"));
    for (const std::string& line : lines_of(outcome.err)) CHECK(line.rfind("mir: ", 0) == 0);
    // As many chains as VPLs, so that none has two states to compare.
    CHECK(!has(outcome.err, "R-hat"));
    CHECK(has(run_mir(loud + Words{"--chains", "2"}).err, ", R-hat "));
}

TEST_CASE("cuts fill in what was left open: many VPLs of light paths") {
    const TemporaryFolder folder("render_cuts");
    const auto found = [&](const Words& more) {
        const Words words{"render",   "builtin:cornell-box",
                          "--width",  "8",
                          "--height", "8",
                          "--quiet",  "--json",
                          "-o",       (folder / "a.exr").string()};
        return nlohmann::json::parse(run_mir(words + more).out);
    };
    const auto open = found({"--sum", "cuts"});
    CHECK(open.at("picks") == 256);
    CHECK(open.at("vpls") > 200000);
    CHECK(open.at("normalisation") == "none");
    const auto said = found({"--sum", "cuts", "--vpls", "100", "--sampler", "mir"});
    CHECK(said.at("vpls") <= 100);
    CHECK(said.at("normalisation") == "proposal");
    CHECK(found({"--sum", "all"}).at("picks") == 0);
}

TEST_CASE("a render names the stages that took time, and VPLs where there are some") {
    const TemporaryFolder folder("render_stages");
    const auto said = [&](const Words& more) {
        Words words = small_render(folder / "a.exr", "builtin:cornell-box", 64, 48);
        words.pop_back();
        return run_mir(words + more).err;
    };
    const std::string vpls = said({});
    CHECK(has(vpls, " luxels, 16 VPLs from "));
    CHECK(has(vpls, " M contributions/s"));
    const std::string paths = said({"--integrator", "path", "--samples", "64", "--threads", "1"});
    CHECK(has(paths, "paths "));
    CHECK_FALSE(has(paths, "VPLs"));
    CHECK_FALSE(has(paths, "contributions"));
    CHECK_FALSE(has(paths, " 0.00,"));
}

TEST_CASE("pictures are named after the scene and written here when no name is given") {
    const TemporaryFolder folder("render_name");
    const Outcome outcome =
        run_mir({"render", "builtin:furnace", "--width", "8", "--height", "8", "-q"}, folder / "");
    CHECK(outcome.out == "furnace.exr\nfurnace.png\n");
    CHECK(std::filesystem::exists(folder / "furnace.exr"));
    CHECK(std::filesystem::exists(folder / "furnace.png"));
    CHECK(folder.files() == 2);
}

TEST_CASE("the preview can be named or left out") {
    const TemporaryFolder folder("render_png");
    render(small_render(folder / "a.exr") + Words{"--png", (folder / "b.png").string()});
    CHECK(png_size(folder / "b.png") == "24x18");
    CHECK(folder.files() == 2);
    const Outcome none = render(small_render(folder / "c.exr") + Words{"--no-png"});
    CHECK(none.out == (folder / "c.exr").string() + "\n");
    CHECK(folder.files() == 3);
}

TEST_CASE("exposure changes the preview, not the picture") {
    const TemporaryFolder folder("render_exposure");
    render(small_render(folder / "a.exr") + Words{"--exposure", "1"});
    render(small_render(folder / "b.exr") + Words{"--exposure", "-1.5"});
    CHECK((file_bytes(folder / "a.exr") == file_bytes(folder / "b.exr")));
    CHECK((file_bytes(folder / "a.png") != file_bytes(folder / "b.png")));
}

TEST_CASE("tone curves change the preview, not the picture") {
    const TemporaryFolder folder("render_tone");
    render(small_render(folder / "usual.exr"));
    std::set<std::string> previews;
    for (const std::string name : {"agx", "aces", "reinhard", "none"}) {
        render(small_render(folder / (name + ".exr")) + Words{"--tone", name});
        CHECK(file_bytes(folder / (name + ".exr")) == file_bytes(folder / "usual.exr"));
        previews.insert(file_bytes(folder / (name + ".png")));
    }
    CHECK(previews.size() == 4);
    CHECK(previews.contains(file_bytes(folder / "usual.png")));
}

TEST_CASE("a render says whether chains mutated, and which options then did nothing") {
    const TemporaryFolder folder("render_chains");
    const auto said = [&](const Words& more) {
        Words words = small_render(folder / "a.exr");
        words.pop_back();
        return run_mir(words + more).err;
    };
    CHECK(has(said({}), "16 independent starts drawn from "));
    CHECK_FALSE(has(said({}), "had no effect"));
    CHECK(has(said({"--stride", "8", "--mutation", "bidirectional"}),
              "so --stride, --mutation had no effect"));
    const std::string mutated = said({"--stride", "8", "--chains", "2"});
    CHECK(has(mutated, "2 chains, "));
    CHECK(has(mutated, " mutations ("));
    CHECK_FALSE(has(mutated, "had no effect"));
}

TEST_CASE("a side that is not given follows from the camera") {
    const TemporaryFolder folder("render_size");
    const auto size = [&](const Words& sides) {
        const Words scene{"render", "builtin:sphere", "-o", (folder / "a.exr").string()};
        render(scene + sides +
               Words{"--vpls", "1", "--direct-samples", "1", "--luxels", "1", "-q"});
        return exr_size(folder / "a.exr");
    };
    CHECK(size({"--width", "40"}) == "40x30");
    CHECK(size({"--height", "60"}) == "80x60");
    CHECK(size({"--width", "7", "--height", "1"}) == "7x1");
    CHECK(size({}) == "640x480");
}

TEST_CASE("the file holds the layers asked for") {
    const TemporaryFolder folder("render_layers");
    const auto path = folder / "a.exr";
    using Names = std::set<std::string>;
    render(small_render(path));
    CHECK(layers_of(path) == Names{"", "albedo", "normal", "depth"});
    Names all{"", "albedo", "normal", "position", "depth", "direct", "indirect", "emission"};
    render(small_render(path) + Words{"--aov", "all"});
    CHECK(layers_of(path) == all);
    all.insert("removed");
    render(small_render(path) + Words{"--aov", "removed,all"});
    CHECK(layers_of(path) == all);
    render(small_render(path) + Words{"--aov", "none"});
    CHECK(layers_of(path) == Names{""});
    render(small_render(path) + Words{"--aov", "depth,albedo"});
    CHECK(layers_of(path) == Names{"", "albedo", "depth"});
    render(small_render(path) + Words{"--aov", "removed"});
    CHECK(layers_of(path) == Names{"", "removed"});
    render(small_render(path) + Words{"--aov", "bounces", "--bounces", "3"});
    CHECK(layers_of(path) == Names{"", "bounce1", "bounce2", "bounce3"});
}

TEST_CASE("the picture is the sum of emission, direct and indirect light") {
    const TemporaryFolder folder("render_sum");
    const std::string direct = GENERATE("separate", "vpl");
    render(small_render(folder / "a.exr") + Words{"--direct", direct, "--aov", "all"});
    const auto sum = sum_of_layers(folder / "a.exr", {"emission", "direct", "indirect"});
    CHECK(largest_difference(mir::read_exr(folder / "a.exr").image, sum) < 1e-4f);
}

TEST_CASE("indirect light is the sum of its bounces") {
    const TemporaryFolder folder("render_bounces");
    render(small_render(folder / "a.exr") + Words{"--aov", "indirect,bounces", "--luxels", "4"});
    std::set<std::string> bounces = layers_of(folder / "a.exr");
    bounces.erase("");
    bounces.erase("indirect");
    CHECK(bounces.size() >= 2);
    const auto indirect = mir::read_exr(folder / "a.exr", "indirect").image;
    const float off = largest_difference(indirect, sum_of_layers(folder / "a.exr", bounces));
    // Some hundred float additions of values below 10.
    CHECK(off < 1e-4f);
    CHECK(largest_difference(indirect, mir::Image<mir::Rgb>(indirect.extent())) > 0.01f);
}

TEST_CASE("the header tells how the picture was made") {
    const TemporaryFolder folder("render_header");
    const auto path = folder / "a.exr";
    render(small_render(path) + Words{"--seed", "18446744073709551615", "--sampler", "keller",
                                      "--filter", "box", "--luxels", "2", "--bound", "0.25"});
    CHECK(attribute_of(path, "mir:version") == mir::version);
    CHECK(attribute_of(path, "mir:scene_hash").size() == 16);
    CHECK(attribute_of(path, "mir:seed") == "18446744073709551615");
    CHECK(attribute_of(path, "mir:sampler") == "keller");
    CHECK(attribute_of(path, "mir:filter") == "box");
    CHECK(attribute_of(path, "mir:luxels_per_pixel") == "2");
    CHECK(attribute_of(path, "mir:bound") == "0.250000");
    const int vpls = std::stoi(attribute_of(path, "mir:vpls"));
    CHECK(vpls > 0);
    CHECK(attribute_of(path, "mir:contributions") == std::to_string(24 * 18 * 2 * vpls));
    CHECK(std::stoi(attribute_of(path, "mir:light_paths")) > 0);
    for (const char* name :
         {"mir:removed_share", "mir:removed_share_error", "mir:cut_share", "mir:cut_share_error"})
        CHECK(std::stof(attribute_of(path, name)) >= 0.0f);
    CHECK(attribute_of(path, "mir:seconds") == "none");
    render(small_render(path) + Words{"--record-seconds", "--chains", "4"});
    CHECK(std::stof(attribute_of(path, "mir:seconds")) > 0.0f);
    CHECK(attribute_of(path, "mir:sampler") == "mir");
    CHECK(attribute_of(path, "mir:normalisation") == "full");
    CHECK(std::stoi(attribute_of(path, "mir:states")) > 0);
    CHECK(std::stof(attribute_of(path, "mir:path_luminance")) > 0.0f);
    CHECK(std::stof(attribute_of(path, "mir:path_luminance_error")) > 0.0f);
    CHECK(std::stof(attribute_of(path, "mir:large_step_luminance")) > 0.0f);
    CHECK(std::stof(attribute_of(path, "mir:acceptance_large")) > 0.0f);
    CHECK(std::stof(attribute_of(path, "mir:acceptance_small")) > 0.0f);
    CHECK(std::stof(attribute_of(path, "mir:acceptance_suffix")) > 0.0f);
    CHECK(std::stof(attribute_of(path, "mir:effective_samples")) >= 1.0f);
    CHECK(std::stof(attribute_of(path, "mir:split_r_hat")) > 0.9f);
    CHECK(std::stof(attribute_of(path, "mir:dropped_share")) >= 0.0f);
}

TEST_CASE("every choice is accepted and changes the picture", "[extended]") {
    const TemporaryFolder folder("render_choices");
    const auto picture = [&](const Words& choice) {
        // Chains that record twice, so that mutations matter.
        const bool own = !choice.empty() && choice[0] == "--chains";
        render(small_render(folder / "a.exr") + Words{"--aov", "none", "--luxels", "2"} +
               (own ? Words{} : Words{"--chains", "4"}) + choice);
        return mir::read_exr(folder / "a.exr").image;
    };
    const auto usual = picture({});
    for (const Words& same :
         {Words{"--sampler", "mir"}, Words{"--normalise", "full"}, Words{"--stride", "64"},
          Words{"--tries", "8"}, Words{"--large-steps", "0.5"}, Words{"--mutation", "primary"},
          Words{"--paths", "bidirectional"}, Words{"--suffix-refresh", "8"},
          Words{"--bootstrap-error", "0.03"}, Words{"--stop", "fixed"},
          Words{"--integrator", "vpl"}, Words{"--sequence", "random"},
          Words{"--direct", "separate"}, Words{"--filter", "gaussian"}, Words{"--bound", "auto"},
          Words{"--bounces", "32"}, Words{"--direct-samples", "32"}, Words{"--camera", "0"},
          Words{"--camera", "front"}}) {
        INFO(same[0] << " " << same[1]);
        CHECK(largest_difference(picture(same), usual) == 0.0f);
    }
    for (const Words& other : {Words{"--sampler", "ir"},
                               Words{"--sampler", "keller"},
                               Words{"--sampler", "bir"},
                               Words{"--sampler", "roulette"},
                               Words{"--sampler", "ir", "--sequence", "halton"},
                               Words{"--normalise", "prepass"},
                               Words{"--normalise", "proposal"},
                               Words{"--normalise", "prepass", "--prepass-luxels", "2000"},
                               Words{"--chains", "3"},
                               Words{"--stride", "3"},
                               Words{"--tries", "2"},
                               Words{"--large-steps", "0.3"},
                               Words{"--mutation", "bidirectional"},
                               Words{"--paths", "camera"},
                               Words{"--suffix-refresh", "1"},
                               Words{"--bootstrap-error", "0.005"},
                               Words{"--stop", "paper"},
                               Words{"--integrator", "path"},
                               Words{"--integrator", "path", "--samples", "4"},
                               Words{"--integrator", "path", "--light-search", "lamps"},
                               Words{"--integrator", "path", "--light-search", "directions"},
                               Words{"--integrator", "path", "--directions", "2"},
                               Words{"--direct", "vpl"},
                               Words{"--filter", "box"},
                               Words{"--filter", "mitchell"},
                               Words{"--bound", "none"},
                               Words{"--bound", "0.01"},
                               Words{"--bounces", "1"},
                               Words{"--direct-samples", "4"},
                               Words{"--seed", "1"}}) {
        INFO(other[0] << " " << other[1]);
        CHECK(largest_difference(picture(other), usual) > 0.0f);
    }
}
