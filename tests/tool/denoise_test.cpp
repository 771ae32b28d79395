// SPDX-License-Identifier: MIT
#include "denoise/told.hpp"
#include "mir/compare/metrics.hpp"
#include "tool/exr_file.hpp"
#include "tool/mir_program.hpp"

#include <nlohmann/json.hpp>

#include <cstdlib>

// MIR_FAKE_OIDN_2 is a library of the tests: it halves a picture and adds a hundredth of the albedo
// and a thousandth of the normal.

using namespace mirtest;
using nlohmann::json;

namespace {

using Picture = mir::Image<mir::Rgb>;

const Words by_fake{"--denoiser", MIR_FAKE_OIDN_2};

/// A small noisy picture with these layers.
std::string noisy(const std::filesystem::path& exr, const char* layers) {
    const Words few{"--direct-samples", "1", "--filter", "box", "--aov", layers};
    REQUIRE(run_mir(small_render(exr) + few).exit_code == 0);
    return exr.string();
}

Picture layer(const std::filesystem::path& exr, const std::string& name = "") {
    return mir::read_exr(exr, name).image;
}

/// Root mean square of the difference.
double rmse(const Picture& a, const Picture& b) { return mir::compare_images(a, b).rmse(); }

Outcome denoise(const Words& arguments) { return run_mir(Words{"denoise"} + arguments); }

/// What the fake makes of a layer.
Picture halved(const Picture& light, const Picture& albedo, const Picture& normal) {
    Picture out = light;
    for (std::size_t i = 0; i < out.pixels().size(); ++i)
        out.pixels()[i] =
            0.5f * out.pixels()[i] + 0.01f * albedo.pixels()[i] + 0.001f * normal.pixels()[i];
    return out;
}

}  // namespace

TEST_CASE("a render with --denoise has the layer beside all that it has without") {
    const TemporaryFolder folder("denoise_render");
    noisy(folder / "plain.exr", "all");
    const Words more{"--direct-samples",
                     "1",
                     "--aov",
                     "all",
                     "--denoise",
                     "--json",
                     "--report",
                     folder / "a.html",
                     "--report-reference",
                     folder / "plain.exr"};
    const Outcome outcome = run_mir(small_render(folder / "a.exr") + more + by_fake);
    REQUIRE(outcome.exit_code == 0);
    for (const char* same : {"", "direct", "indirect", "emission", "albedo", "normal"})
        CHECK(rmse(layer(folder / "a.exr", same), layer(folder / "plain.exr", same)) == 0.0);
    const Picture albedo = layer(folder / "a.exr", "albedo");
    const Picture normal = layer(folder / "a.exr", "normal");
    Picture wanted = halved(layer(folder / "a.exr", "direct"), albedo, normal);
    const Picture indirect = halved(layer(folder / "a.exr", "indirect"), albedo, normal);
    const Picture emission = layer(folder / "a.exr", "emission");
    for (std::size_t i = 0; i < wanted.pixels().size(); ++i)
        wanted.pixels()[i] += indirect.pixels()[i] + emission.pixels()[i];
    // Albedo and normal are stored in half precision.
    CHECK(rmse(layer(folder / "a.exr", "denoised"), wanted) < 1e-4);
    CHECK(attribute_of(folder / "a.exr", "mir:denoiser") == "Open Image Denoise 2.4.3");
    CHECK(attribute_of(folder / "plain.exr", "mir:denoiser") == "none");
    const json told = json::parse(outcome.out).at("denoised");
    CHECK(told.at("denoiser") == "Open Image Denoise 2.4.3");
    CHECK(told.at("rmse").at("before") == 0.0);
    CHECK(told.at("rmse").at("after") > 0.0);
    // The preview shows it.
    CHECK((file_bytes(folder / "a.png") != file_bytes(folder / "plain.png")));
    const std::string report = file_bytes(folder / "a.html");
    CHECK(has(report, "Beauty by Open Image Denoise 2.4.3 against"));
    CHECK(has(report, "<option value=\"denoised\">Denoised"));
}

TEST_CASE("mir denoise writes a picture with the noisy one beside it, and leaves its input") {
    const TemporaryFolder folder("denoise_file");
    const std::string in = noisy(folder / "in.exr", "all");
    const std::string bytes = file_bytes(in);
    const std::string out = folder / "out.exr";
    const Outcome outcome = denoise(Words{in, out, "--reference", in} + by_fake);
    REQUIRE(outcome.exit_code == 0);
    CHECK(outcome.out == out + "\n");
    CHECK(has(outcome.err, "mir: denoised by Open Image Denoise 2.4.3 in "));
    CHECK(has(outcome.err, "RMSE 0 before, "));
    CHECK((file_bytes(in) == bytes));
    CHECK(layers_of(out) == std::set<std::string>{"", "noisy"});
    CHECK(rmse(layer(out, "noisy"), layer(in)) == 0.0);
    // The same as of a render.
    REQUIRE(run_mir(small_render(folder / "a.exr") + Words{"--direct-samples", "1", "--denoise"} +
                    by_fake)
                .exit_code == 0);
    CHECK(rmse(layer(out), layer(folder / "a.exr", "denoised")) < 1e-4);
    CHECK(attribute_of(out, "mir:denoiser") == "Open Image Denoise 2.4.3");
    CHECK(attribute_of(out, "mir:seed") == "0");
}

TEST_CASE("a picture without guides, or without parts, is denoised as it is and one line says so") {
    const TemporaryFolder folder("denoise_bare");
    const std::string out = folder / "out.exr";
    const std::string bare = noisy(folder / "bare.exr", "none");
    const Outcome without = denoise(Words{bare, out, "--json"} + by_fake);
    REQUIRE(without.exit_code == 0);
    CHECK(has(without.err, "bare.exr: it has no layer albedo"));
    const json told = json::parse(without.out);
    CHECK(told.at("guides").empty());
    CHECK(told.at("parts").empty());
    CHECK(told.at("denoised").at("rmse").is_null());
    Picture half = layer(bare);
    for (mir::Rgb& pixel : half.pixels()) pixel = 0.5f * pixel;
    CHECK(rmse(layer(out), half) == 0.0);
    const std::string albedo = noisy(folder / "albedo.exr", "albedo");
    const Outcome with = denoise(Words{albedo, out} + by_fake);
    CHECK(with.exit_code == 0);
    CHECK(has(with.err, "it has no layer normal"));
    CHECK(denoise(Words{albedo, out, "--quiet"} + by_fake).err.empty());
}

TEST_CASE("a pixel filter that hides noise from a denoiser is named, and is not the default") {
    const TemporaryFolder folder("denoise_filter");
    const Words denoised = small_render(folder / "a.exr") + Words{"--denoise", "--json"} + by_fake;
    const auto told = [&](const Words& more) {
        return json::parse(run_mir(denoised + more).out).at("warnings").dump();
    };
    CHECK_FALSE(has(told({}), "pixel filter"));
    CHECK(attribute_of(folder / "a.exr", "mir:filter") == "box");
    CHECK(has(told({"--filter", "gaussian"}), "the pixel filter gaussian spreads noise"));
    CHECK(attribute_of(folder / "a.exr", "mir:filter") == "gaussian");
    const Outcome outcome = denoise(Words{folder / "a.exr", folder / "b.exr"} + by_fake);
    CHECK(has(outcome.err, "a.exr: the pixel filter gaussian spreads noise"));
}

TEST_CASE("a denoiser that fails leaves the picture with its noise") {
    const TemporaryFolder folder("denoise_failure");
    const Words plain = small_render(folder / "a.exr");
    REQUIRE(run_mir(plain + Words{"--filter", "box"}).exit_code == 0);
    const Picture noisy = layer(folder / "a.exr");
    std::filesystem::remove(folder / "a.exr");
    const Told failure("failure");
    const Outcome outcome = run_mir(plain + Words{"--denoise"} + by_fake);
    CHECK(outcome.exit_code == 1);
    CHECK(has(outcome.err, "the picture is not denoised: "));
    CHECK(has(outcome.err, "out of memory"));
    CHECK(rmse(layer(folder / "a.exr"), noisy) == 0.0);
    CHECK(std::filesystem::exists(folder / "a.png"));
}

TEST_CASE("without a denoiser nothing is rendered, and one sentence says what to do") {
    const Words nowhere{"--denoiser", "/nowhere/libOpenImageDenoise.so"};
    check_failing_render(Words{"builtin:sphere", "--denoise"} + nowhere, 4,
                         "/nowhere/libOpenImageDenoise.so: no denoiser can be loaded");
    check_failing_render(Words{"builtin:sphere"} + nowhere, 2, "--denoise");
    const TemporaryFolder folder("denoise_none");
    const std::string in = noisy(folder / "in.exr", "none");
    check_failure(denoise(Words{in, folder / "out.exr"} + nowhere), 4, "MIR_OIDN_LIBRARY");
    check_failure(denoise(Words{in, in} + by_fake), 2, "it would replace another file");
    check_failure(denoise(Words{folder / "no.exr", folder / "out.exr"} + by_fake), 3, "no.exr");
    CHECK_FALSE(std::filesystem::exists(folder / "out.exr"));
}

TEST_CASE("the real denoiser brings a noisy picture nearer to its reference", "[extended]") {
    const TemporaryFolder folder("denoise_real");
    const auto room = [&](const char* name, const Words& more) {
        Outcome outcome =
            run_mir(small_render(folder / name, "builtin:cornell-box", 96, 72) + more);
        REQUIRE(outcome.exit_code != 1);
        return outcome;
    };
    room("reference.exr", {"--integrator", "path", "--samples", "256", "--filter", "box"});
    const Outcome outcome =
        room("a.exr", {"--integrator", "path", "--samples", "1", "--luxels", "4", "--denoise"});
    if (outcome.exit_code == 4) {
        WARN("skipped: " << outcome.err);
        return;
    }
    REQUIRE(outcome.exit_code == 0);
    const Picture reference = layer(folder / "reference.exr");
    CHECK(rmse(layer(folder / "a.exr", "denoised"), reference) <
          0.5 * rmse(layer(folder / "a.exr"), reference));
}
