// SPDX-License-Identifier: MIT
#include "mir/scene/projection.hpp"
#include "mir/scenes.hpp"
#include "support/vpl_file.hpp"
#include "tool/exr_file.hpp"
#include "tool/report_file.hpp"

#include <nlohmann/json.hpp>

#include <cmath>
#include <numbers>
#include <set>

using namespace mirtest;

namespace {

/// A render with report, reference and file of VPLs in a folder of its own.
struct Reported {
    TemporaryFolder folder{"report"};
    std::string picture = (folder / "b.exr").string();
    std::string reference = (folder / "a.exr").string();
    std::string vpls = (folder / "b.ply").string();
    Outcome outcome;
    std::string page;

    explicit Reported(const Words& more = {}) {
        REQUIRE(run_mir(small_render(reference) + Words{"--seed", "7", "--no-png"}).exit_code == 0);
        outcome = run_mir(small_render(picture) +
                          Words{"--no-png", "--report", (folder / "b.html").string(),
                                "--report-reference", reference, "--vpls-out", vpls} +
                          more);
        REQUIRE(outcome.exit_code == 0);
        page = file_bytes(folder / "b.html");
    }
};

}  // namespace

TEST_CASE("a report is one file that loads nothing and runs no script but its own") {
    const Reported r;
    CHECK(r.folder.files() == 4);
    CHECK(r.outcome.out ==
          r.picture + "\n" + (r.folder / "b.html").string() + "\n" + r.vpls + "\n");
    CHECK(r.page.rfind("<!DOCTYPE html>", 0) == 0);
    CHECK(r.page.size() - r.page.rfind("</html>") == 8);
    for (const char* outside : {"http:", "https:", "<link", "url(", "@import", "<iframe", "fetch("})
        CHECK_FALSE(has(r.page, outside));
    const std::string markup = markup_of(r.page);
    for (const std::string& source : all_matches(markup, R"(\ssrc="([^"]{0,30}))"))
        CHECK(source.rfind("data:image/png;base64,", 0) == 0);
    CHECK(all_matches(markup, R"(<[^>]*\s(on[a-z]+=))").empty());
    const std::string policy = between(r.page, "Content-Security-Policy\"\n content=\"", "\"");
    CHECK(policy.rfind("default-src 'none'; img-src data:; style-src 'unsafe-inline'", 0) == 0);
    // The hash of the policy is that of the script, by another program.
    std::ofstream(r.folder / "script", std::ios::binary)
        << between(r.page, "<script>", "</script>");
    const Outcome sum =
        RunningProgram({"/usr/bin/sha256sum", (r.folder / "script").string()}).wait();
    REQUIRE(sum.exit_code == 0);
    std::vector<std::uint8_t> hash;
    for (std::size_t i = 0; i < 64; i += 2)
        hash.push_back(static_cast<std::uint8_t>(std::stoi(sum.out.substr(i, 2), nullptr, 16)));
    CHECK(has(policy, "script-src 'sha256-" + mir::detail::base64(hash) + "'"));
}

TEST_CASE("a report can be read by ear and used by keyboard") {
    const Reported r({"--aov", "bounces"});
    const std::string markup = markup_of(r.page);
    CHECK(has(markup, "<html lang=\"en\">"));
    CHECK(has(r.page, "prefers-color-scheme: dark"));
    CHECK(all_matches(markup, "<h([1-6])")[0] == "1");
    CHECK(count_of(markup, "<h1") == 1);
    CHECK(count_of(markup, "<h2") == 9);
    CHECK(all_matches(markup, "<(h[3-6])").empty());
    CHECK(count_of(markup, "<table") == 7);
    CHECK(count_of(markup, "<table>\n<caption>") == 7);
    CHECK(count_of(markup, "<th") == count_of(markup, "<th scope=") + count_of(markup, "<thead"));
    const Words ids = all_matches(markup, R"re(\sid="([^"]+)")re");
    CHECK(std::set<std::string>(ids.begin(), ids.end()).size() == ids.size());
    const Words controls = all_matches(markup, R"re(<(?:input|select)[^>]*\sid="([^"]+)")re");
    CHECK(controls.size() == 6);
    CHECK(controls.size() == count_of(markup, "<input") + count_of(markup, "<select"));
    for (const std::string& id : controls) CHECK(has(markup, "<label for=\"" + id + "\">"));
    CHECK(count_of(markup, "<img") == count_of(markup, " alt=\""));
    for (const std::string& graphic : all_matches(markup, "(<svg[^>]*>)"))
        CHECK((has(graphic, "aria-hidden=\"true\"") || has(graphic, "aria-label=\"")));
}

TEST_CASE("the layers of a report add up to the radiance of the OpenEXR file") {
    const Reported r({"--aov", "bounces"});
    const mir::Image<mir::Rgb> beauty = mir::read_exr(r.picture).image;
    const std::string names = between(r.page, "<option value=\"", "\">Beauty<");
    mir::Image<mir::Rgb> sum(beauty.extent());
    std::size_t layers = 0;
    for (const std::string& name : all_matches(names, "([a-z0-9]+)")) {
        const mir::Image<mir::Rgb> layer = layer_of(r.page, name);
        REQUIRE(layer.extent() == beauty.extent());
        for (std::size_t i = 0; i < sum.pixels().size(); ++i) sum.pixels()[i] += layer.pixels()[i];
        ++layers;
    }
    CHECK(layers > 3);
    CHECK(has(names, "bounce2"));
    double light = 0.0, error = 0.0;
    for (std::size_t i = 0; i < sum.pixels().size(); ++i) {
        // Negative lobes of the filter are black in a report.
        if (std::min({beauty.pixels()[i].r, beauty.pixels()[i].g, beauty.pixels()[i].b}) < 0.0f)
            continue;
        light += static_cast<double>(luminance(beauty.pixels()[i]));
        error += std::fabs(static_cast<double>(luminance(sum.pixels()[i] - beauty.pixels()[i])));
    }
    CHECK(error < 0.006 * light);
    const mir::Image<mir::Rgb> reference = mir::read_exr(r.reference).image;
    const mir::Rgb a = layer_of(r.page, "reference")(12, 9);
    CHECK(a.r + a.g + a.b ==
          Approx(reference(12, 9).r + reference(12, 9).g + reference(12, 9).b).epsilon(0.006));
}

TEST_CASE("circles of a report lie where the camera sees VPLs, their areas follow the powers") {
    const Reported r;
    const auto scene = mir::builtin::make("cornell-box");
    std::multiset<double> powers;
    std::set<std::string> places;
    for (const VplOfFile& v : read_vpls(file_bytes(r.vpls))) {
        const auto film = mir::project(scene.cameras[0], 24.0f / 18.0f, v.vpl.position);
        const double power = std::numbers::pi * static_cast<double>(luminance(v.vpl.intensity));
        if (!film || power <= 0.0 || film->x < 0 || film->x >= 1 || film->y < 0 || film->y >= 1)
            continue;
        powers.insert(power);
        std::array<char, 32> place{};
        std::snprintf(place.data(), place.size(), "%.1f %.1f", static_cast<double>(film->x * 24),
                      static_cast<double>(film->y * 18));
        places.insert(place.data());
    }
    const std::string drawing = between(r.page, "<svg id=\"vpls\"", "</svg>");
    const Words x = all_matches(drawing, R"re( cx="([^"]+)")re");
    const Words y = all_matches(drawing, R"re( cy="([^"]+)")re");
    std::multiset<double> radii;
    for (const std::string& radius : all_matches(drawing, R"re( r="([^"]+)")re"))
        radii.insert(std::stod(radius));
    REQUIRE(radii.size() > 3);
    REQUIRE(radii.size() == powers.size());
    for (std::size_t i = 0; i < x.size(); ++i) CHECK(places.contains(x[i] + " " + y[i]));
    const double scale = *radii.rbegin() / std::sqrt(*powers.rbegin());
    for (auto p = powers.begin(), q = radii.begin(); p != powers.end(); ++p, ++q)
        CHECK(*q == Approx(scale * std::sqrt(*p)).margin(0.02));
}

TEST_CASE("a report tells time, settings, scene and chains, and names are no markup") {
    const TemporaryFolder folder("report_facts");
    const std::string scene = (folder / "<b>.glb").string();
    REQUIRE(run_mir({"export", "builtin:cornell-box", "-o", scene}).exit_code == 0);
    const std::string report = (folder / "r.html").string();
    const Outcome outcome = run_mir(small_render(folder / "a.exr", scene) +
                                    Words{"--json", "--chains", "2", "--report", report});
    REQUIRE(outcome.exit_code == 0);
    const auto json = nlohmann::json::parse(outcome.out);
    CHECK(json.at("report") == report);
    const std::string page = file_bytes(report);
    CHECK_FALSE(has(page, "<b>"));
    CHECK(has(page, "&lt;b&gt;.glb rendered by mir"));
    CHECK(has(page, json.at("scene_hash").get<std::string>()));
    for (const char* fact : {"split R-hat", "P_c", "dropped share", "effective samples", "24x18",
                             ">reconstruction</", ">total</", "cpu-blocks", "36, 2 of them emit"})
        CHECK(has(page, fact));
    double seconds = 0.0;
    const std::string times = between(page, "Wall time by stage", "</table>");
    for (const std::string& time : all_matches(times, "</th><td>([0-9.]+)</td>"))
        seconds += std::stod(time);
    // All stages and their total.
    CHECK(seconds == Approx(2.0 * json.at("seconds").at("total").get<double>()).margin(0.002));
}

TEST_CASE("a report of several passes charts their error over VPLs and over seconds") {
    const Reported r({"--passes", "18", "--json"});
    const auto json = nlohmann::json::parse(r.outcome.out);
    const auto& points = json.at("convergence");
    REQUIRE(points.size() == 17);  // 1 to 16, and the last
    CHECK(points.front().at("relative_error").is_null());
    CHECK(points.back().at("passes") == 18);
    CHECK(points.back().at("vpls") == json.at("vpls"));
    CHECK(points.back().at("seconds") == json.at("seconds").at("total"));
    CHECK(points.back().at("relative_error") == json.at("relative_error"));
    const mir::Image<mir::Rgb> seen = mir::read_exr(r.picture).image;
    const mir::Image<mir::Rgb> wanted = mir::read_exr(r.reference).image;
    double squares = 0.0, light = 0.0;
    for (std::size_t i = 0; i < seen.pixels().size(); ++i) {
        const auto y = static_cast<double>(luminance(wanted.pixels()[i]));
        squares += std::pow(static_cast<double>(luminance(seen.pixels()[i])) - y, 2.0);
        light += y;
    }
    const double pixels = static_cast<double>(seen.pixels().size());
    // The file is read as it was written, in single precision.
    CHECK(points.back().at("reference_error").get<double>() ==
          Approx(std::sqrt(squares / pixels) / (light / pixels)).epsilon(1e-4));
    const std::string section = between(r.page, "<h2>Convergence", "<h2>");
    CHECK(count_of(section, "<svg class=\"series\" role=\"img\" aria-label=\"") == 2);
    CHECK(count_of(section, "<polyline") == 4);
    CHECK(count_of(section, "<tr><th scope=\"row\">") == 17);
    for (const std::string& line : all_matches(section, R"re(<polyline points="([^"]+))re"))
        CHECK(count_of(line, ",") >= 16);
    for (const std::string& place : all_matches(section, R"re(c[xy]="([^"]+))re"))
        CHECK((std::stod(place) >= 8.0 && std::stod(place) <= 446.0));
}

TEST_CASE("charts are of what a logarithm can show") {
    const TemporaryFolder folder("report_convergence");
    const std::string report = (folder / "r.html").string();
    // Every pass is the same black: no error, and a reference without mean luminance.
    const std::string scene = (folder / "dark.obj").string();
    std::ofstream(scene) << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    const auto dark = [&](const char* name) {
        return small_render(folder / name, scene) + Words{"--allow-no-light"};
    };
    REQUIRE(run_mir(dark("a.exr")).exit_code == 0);
    REQUIRE(run_mir(dark("b.exr") + Words{"--passes", "3", "--report", report, "--report-reference",
                                          (folder / "a.exr").string()})
                .exit_code == 0);
    const std::string section = between(file_bytes(report), "<h2>Convergence", "<h2>");
    CHECK(count_of(section, "<svg") == 0);
    CHECK(count_of(section, "<tr><th scope=\"row\">") == 3);
    CHECK(has(section, "0.00 %"));
    CHECK(has(section, "unknown"));
}

TEST_CASE("renders without VPLs have reports without them, dark ones too") {
    const TemporaryFolder folder("report_path");
    const std::string report = (folder / "r.html").string();
    const Words path{"--integrator", "path", "--samples", "1", "--report", report};
    REQUIRE(run_mir(small_render(folder / "a.exr") + path).exit_code == 0);
    const std::string page = file_bytes(report);
    for (const char* absent : {"<circle", "vpl-show\"", "Markov chains", "id=\"reference\""})
        CHECK_FALSE(has(markup_of(page), absent));
    const std::string scene = (folder / "dark.obj").string();
    std::ofstream(scene) << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    REQUIRE(run_mir(small_render(folder / "b.exr", scene) +
                    Words{"--allow-no-light", "--report", report})
                .exit_code == 0);
    CHECK(has(file_bytes(report), "</html>"));
}

TEST_CASE("a report of 1600x1200 pixels stays below 5 MB, even of noise, which it shrinks",
          "[slow]") {
    const TemporaryFolder folder("report_size");
    const std::string report = (folder / "r.html").string();
    const Words noise{
        "--integrator", "path",  "--samples", "1",        "--bounces", "2", "--direct-samples", "1",
        "--no-png",     "--aov", "none",      "--report", report};
    REQUIRE(run_mir(small_render(folder / "a.exr", "builtin:cornell-box", 1600, 1200) + noise)
                .exit_code == 0);
    const std::string page = file_bytes(report);
    CHECK(page.size() < 5'000'000);
    CHECK(page.size() > 500'000);
    CHECK(has(page, "data-shrink=\"2\""));
    CHECK(has(page, "is the mean of 2x2 of the render"));
    const mir::Image<mir::Rgb> shown = layer_of(page, "indirect");
    CHECK(shown.extent() == mir::Extent{800, 600});
    const mir::Image<mir::Rgb> beauty = mir::read_exr(folder / "a.exr").image;
    mir::Rgb mean;
    for (const std::uint32_t y : {400u, 401u})
        for (const std::uint32_t x : {800u, 801u}) mean += beauty(x, y) * 0.25f;
    const mir::Rgb direct = layer_of(page, "direct")(400, 200);
    const mir::Rgb both = direct + shown(400, 200) + layer_of(page, "emission")(400, 200);
    CHECK(luminance(both) == Approx(luminance(mean)).epsilon(0.02));
}

TEST_CASE("what a report or a file of VPLs cannot be is one error before any work") {
    const TemporaryFolder folder("report_errors");
    const std::string lost = (folder / "missing" / "r.html").string();
    const std::string report = (folder / "r.html").string();
    const std::string small = (folder / "small.exr").string();
    REQUIRE(
        run_mir(small_render(small, "builtin:cornell-box", 8, 8) + Words{"--no-png"}).exit_code ==
        0);
    const Words render{"builtin:cornell-box", "--width", "24", "--height", "18", "--quiet"};
    check_failing_render(render + Words{"--report", lost}, 1, "r.html");
    check_failing_render(render + Words{"--vpls-out", (folder / "missing" / "v.ply").string()}, 1,
                         "v.ply");
    check_failing_render(render + Words{"--vpls-out", "v.obj"}, 2, "does not end in .ply or .glb");
    check_failing_render(render + Words{"--vpls-out", "v.ply", "--integrator", "path"}, 2,
                         "places no VPLs");
    check_failing_render(render + Words{"--report-reference", small}, 2, "--report");
    check_failing_render(render + Words{"--report", report, "--report-reference", "no.exr"}, 3,
                         "no.exr");
    check_failing_render(render + Words{"--report", report, "--report-reference", small}, 3,
                         "small.exr: the reference has 8x8 pixels and the picture to render 24x18");
    check_failing_render(render + Words{"--report", small, "--report-reference", small}, 2,
                         "would replace");
    CHECK(folder.files() == 1);
}

TEST_CASE("a file of VPLs holds those that were placed, with finite powers") {
    const Reported r({"--json"});
    const auto json = nlohmann::json::parse(r.outcome.out);
    CHECK(json.at("vpl_file") == r.vpls);
    const std::vector<VplOfFile> vpls = read_vpls(file_bytes(r.vpls));
    CHECK(vpls.size() == json.at("vpls").get<std::size_t>());
    REQUIRE_FALSE(vpls.empty());
    double power = 0.0;
    for (const VplOfFile& v : vpls) {
        CHECK(is_finite(v.vpl.intensity));
        CHECK(glm::length(v.vpl.normal) == Approx(1.0).epsilon(1e-5));
        CHECK(v.bounce >= 2);
        power += std::numbers::pi * static_cast<double>(luminance(v.vpl.intensity));
    }
    CHECK(power > 0.0);
}

TEST_CASE("VPLs are written as glTF too") {
    const TemporaryFolder folder("report_glb");
    const std::string vpls = (folder / "v.glb").string();
    REQUIRE(run_mir(small_render(folder / "a.exr") + Words{"--vpls-out", vpls}).exit_code == 0);
    const Outcome seen = run_mir({"info", vpls, "--json"});
    REQUIRE(seen.exit_code == 0);
    CHECK(nlohmann::json::parse(seen.out).at("ignored").at("primitive of points") == 1);
}
