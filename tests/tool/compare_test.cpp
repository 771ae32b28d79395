// SPDX-License-Identifier: MIT
#include "mir/version.hpp"
#include "tool/compared_pictures.hpp"

#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfOutputFile.h>
#include <nlohmann/json.hpp>

#include <chrono>
#include <cmath>
#include <set>
#include <thread>

using namespace mirtest;
using namespace mirtest::compared;
using nlohmann::json;

namespace {

/// Writes a picture with what mir never writes: numbers that are none.
std::string store_unchecked(const std::filesystem::path& path, Picture picture) {
    Imf::Header header(static_cast<int>(picture.width()), static_cast<int>(picture.height()));
    Imf::FrameBuffer buffer;
    float* first = &picture.pixels().front().r;
    for (const char* name : {"R", "G", "B"}) {
        header.channels().insert(name, Imf::Channel(Imf::FLOAT));
        buffer.insert(name, Imf::Slice::Make(Imf::FLOAT, first++, header.dataWindow(),
                                             sizeof(mir::Rgb), sizeof(mir::Rgb) * picture.width()));
    }
    Imf::OutputFile file(path.c_str(), header);
    file.setFrameBuffer(buffer);
    file.writePixels(static_cast<int>(picture.height()));
    return path.string();
}

std::set<std::string> keys_of(const json& object) {
    std::set<std::string> keys;
    for (const auto& [key, value] : object.items()) keys.insert(key);
    return keys;
}

}  // namespace

TEST_CASE("compare has a help that names every option") {
    const Outcome help = compare({"--help"});
    CHECK(help.exit_code == 0);
    CHECK(help.err.empty());
    for (const char* option : {"--second-reference", "--layer", "--html", "--error", "--json",
                               "--max-rmse", "--max-relmse", "--max-flip", "--max-mean-difference",
                               "--epsilon", "--pixels-per-degree", "--exposure"})
        CHECK(has(help.out, option));
}

TEST_CASE("compare prints metrics for programs") {
    const Pictures p;
    const json m = metrics({p.a, p.b});
    CHECK(keys_of(m) == std::set<std::string>{"version",
                                              "image",
                                              "reference",
                                              "layer",
                                              "width",
                                              "height",
                                              "rmse",
                                              "mse",
                                              "relmse",
                                              "relmse_epsilon",
                                              "scaled_relmse",
                                              "mae",
                                              "flip",
                                              "flip_exposures",
                                              "ldr_flip",
                                              "exposure",
                                              "pixels_per_degree",
                                              "mean_radiance",
                                              "mean_difference_percent",
                                              "largest_difference",
                                              "exceeded"});
    CHECK(m.at("version") == mir::version);
    CHECK(m.at("image") == p.a);
    CHECK(m.at("reference") == p.b);
    CHECK(m.at("layer") == "");
    CHECK(m.at("width") == 24);
    CHECK(m.at("height") == 16);
    const double values = 3.0 * 24 * 16;
    const double mse = ((values - 1) * 0.01 + 4.0) / values;
    CHECK(m.at("mse").get<double>() == Approx(mse));
    CHECK(m.at("rmse").get<double>() == Approx(std::sqrt(mse)));
    CHECK(m.at("relmse").get<double>() == Approx(mse / 0.26));
    CHECK(m.at("relmse_epsilon") == 0.01);
    const json& scaled = m.at("scaled_relmse");
    const double light = 0.25 * 1.01;
    CHECK(scaled.at("mean").get<double>() == Approx(mse / light));
    // One of 384 pixels is the worst 0.5 %.
    CHECK(scaled.at("trimmed").get<double>() == Approx(0.01 / light));
    CHECK(scaled.at("worst_share") == 0.005);
    CHECK(scaled.at("epsilon") == 0.01);
    CHECK(m.at("mae").get<double>() == Approx(((values - 1) * 0.1 + 2.0) / values));
    CHECK(m.at("mean_radiance").at("image").at(0).get<double>() == Approx(0.6));
    CHECK(m.at("mean_radiance").at("reference").at(2).get<double>() == Approx(0.5));
    CHECK(m.at("mean_radiance").at("ratio").at(0).get<double>() == Approx(1.2));
    CHECK(m.at("mean_difference_percent").get<double>() ==
          Approx(100.0 * (0.1 + 1.9 / 384.0) / 0.5));
    CHECK(m.at("largest_difference") == json{{"value", 2.0}, {"x", 5}, {"y", 7}, {"channel", "G"}});
    CHECK(m.at("flip").get<double>() > 0.0);
    CHECK(m.at("ldr_flip").get<double>() > 0.0);
    CHECK(m.at("flip_exposures").at("count") == 2);
    CHECK(m.at("pixels_per_degree").get<double>() == Approx(67.02));
    CHECK(m.at("exceeded").empty());
}

TEST_CASE("compare prints the same metrics for people, on standard output alone") {
    const Pictures p;
    const Outcome outcome = compare({p.a, p.b});
    CHECK(outcome.exit_code == 0);
    CHECK(outcome.err.empty());
    for (const char* label :
         {"RMSE ", "relMSE ", "scaled relMSE ", "MAE ", "HDR-FLIP ", "LDR-FLIP ", "mean R, G, B ",
          "ratio of means ", "mean difference ", "2 (G of pixel 5, 7)"})
        CHECK(has(outcome.out, label));
    CHECK(p.folder.files() == 2);
}

TEST_CASE("a picture does not differ from itself") {
    const Pictures p;
    const json m = metrics({p.a, p.a, "--max-rmse", "0", "--max-relmse", "0", "--max-flip", "0",
                            "--max-mean-difference", "0"});
    for (const char* key :
         {"rmse", "mse", "relmse", "mae", "flip", "ldr_flip", "mean_difference_percent"})
        CHECK(m.at(key) == 0.0);
    CHECK(m.at("largest_difference").at("value") == 0.0);
}

TEST_CASE("compare reads the layer asked for, and options reach the metrics") {
    const Pictures p;
    const json layer = metrics({p.a, p.b, "--layer", "half"});
    CHECK(layer.at("mean_radiance").at("reference").at(0).get<double>() == Approx(0.25));
    CHECK(layer.at("layer") == "half");
    const json usual = metrics({p.a, p.b});
    CHECK(metrics({p.a, p.b, "--epsilon", "0.26"}).at("relmse").get<double>() ==
          Approx(usual.at("mse").get<double>() / 0.51));
    CHECK(metrics({p.a, p.b, "--pixels-per-degree", "20"}).at("flip") != usual.at("flip"));
    const json dark = metrics({p.a, p.b, "--exposure", "-5"});
    CHECK(dark.at("exposure") == -5.0);
    CHECK(dark.at("ldr_flip").get<double>() < usual.at("ldr_flip").get<double>());
    CHECK(dark.at("flip") == usual.at("flip"));
}

TEST_CASE("a limit that is passed gives code 1, is named, and leaves the results complete") {
    const Pictures p;
    const std::pair<const char*, const char*> limits[]{
        {"--max-rmse", "rmse"},
        {"--max-relmse", "relmse"},
        {"--max-flip", "flip"},
        {"--max-mean-difference", "mean_difference_percent"}};
    for (const auto& [option, name] : limits) {
        INFO(option);
        const Outcome outcome = compare({p.a, p.b, option, "0.001", "--json"});
        CHECK(outcome.exit_code == 1);
        REQUIRE(lines_of(outcome.err).size() == 1);
        CHECK(has(outcome.err, std::string(": ") + name + " is "));
        CHECK(has(outcome.err, option));
        const json m = json::parse(outcome.out);
        CHECK(m.at("exceeded") == json::array({name}));
        const double value = m.at(name).get<double>();
        CHECK(compare({p.a, p.b, option, std::to_string(value * 1.01)}).exit_code == 0);
        CHECK(compare({p.a, p.b, option, std::to_string(value * 0.99)}).exit_code == 1);
    }
}

TEST_CASE("a mean that should be zero is beyond every limit, and no number of JSON") {
    const Pictures p;
    const std::string black = store(p.folder / "black.exr", plain(0.0f));
    const Outcome outcome = compare({p.a, black, "--max-mean-difference", "1e30", "--json"});
    CHECK(outcome.exit_code == 1);
    const json m = json::parse(outcome.out);
    CHECK(m.at("mean_difference_percent").is_null());
    CHECK(m.at("mean_radiance").at("ratio").at(0).is_null());
}

TEST_CASE("compare writes a report and the signed error") {
    const Pictures p;
    const std::string report = (p.folder / "r.html").string();
    const std::string error = (p.folder / "e.png").string();
    const json m = metrics({p.a, p.b, "--html", report, "--error", error});
    CHECK(m.at("report") == report);
    CHECK(m.at("error") == error);
    CHECK(p.folder.files() == 4);
    CHECK(file_bytes(error).compare(0, 4, "\x89PNG") == 0);
    const std::string page = file_bytes(report);
    CHECK(has(page, "</html>"));
    for (const char* text : {"RMSE", "relMSE", "HDR-FLIP", "signed error", "ratio of means"})
        CHECK(has(page, text));
    std::size_t pictures = 0;
    for (std::size_t at = 0;
         (at = page.find("src=\"data:image/png;base64,", at)) != std::string::npos; ++at)
        ++pictures;
    CHECK(pictures == 4);
    for (const char* outside : {"http:", "https:", "<script", "url("})
        CHECK_FALSE(has(page, outside));
}

TEST_CASE("an error picture that ends in .exr holds image minus reference") {
    const Pictures p;
    const std::string error = (p.folder / "e.exr").string();
    CHECK(compare({p.b, p.a, "--error", error}).exit_code == 0);
    const Picture difference = mir::read_exr(error).image;
    CHECK(difference(5, 7).g == -2.0f);
    CHECK(difference(0, 0).r == Approx(-0.1f));
}

TEST_CASE("names of files are no markup in the report") {
    const Pictures p;
    const std::string name = store(p.folder / "<b>&\"'.exr", plain(0.5f));
    const std::string report = (p.folder / "r.html").string();
    CHECK(compare({name, p.b, "--html", report}).exit_code == 0);
    const std::string page = file_bytes(report);
    CHECK_FALSE(has(page, "<b>"));
    CHECK(has(page, "&lt;b&gt;&amp;&quot;&#39;.exr"));
}

TEST_CASE("compare wants two pictures and sound options") {
    const Pictures p;
    check_failure(compare({}), 2, "image is required");
    check_failure(compare({p.a}), 2, "reference is required");
    check_failure(compare({p.a, p.b, "--max-rmes", "1"}), 2, "did you mean --max-rmse?");
    for (const Words& wrong :
         {Words{"--max-rmse", "-1"}, Words{"--max-relmse", "nan"}, Words{"--max-flip", "little"},
          Words{"--max-mean-difference", "-0.1"}, Words{"--epsilon", "-1"},
          Words{"--pixels-per-degree", "0"}, Words{"--exposure", "inf"},
          Words{"--error", "e.jpg"}}) {
        INFO(wrong[0] << " " << wrong[1]);
        check_failure(compare(Words{p.a, p.b} + wrong), 2, wrong[0]);
    }
}

TEST_CASE("compare never replaces a picture that it compares, nor one output by another") {
    const Pictures p;
    const std::string before = file_bytes(p.b);
    check_failure(compare({p.a, p.b, "--html", p.b}), 2, "would replace");
    check_failure(compare({p.a, p.b, "--error", (p.folder / "." / "a.exr").string()}), 2,
                  "would replace");
    const std::string both = (p.folder / "both.png").string();
    check_failure(compare({p.a, p.b, "--error", both, "--html", both}), 2, "would replace");
    CHECK(file_bytes(p.b) == before);
    CHECK(p.folder.files() == 2);
}

TEST_CASE("a report that cannot be written is known before anything is read") {
    const Pictures p;
    const std::string lost = (p.folder / "missing" / "r.html").string();
    check_failure(compare({"no.exr", p.b, "--html", lost}), 1, "r.html");
}

TEST_CASE("pictures that cannot be read or compared give code 3 and leave no file") {
    const Pictures p;
    const std::string report = (p.folder / "r.html").string();
    const auto refused = [&](const Words& pictures, const std::string& part) {
        check_failure(compare(pictures + Words{"--html", report}), 3, part);
        CHECK_FALSE(std::filesystem::exists(report));
    };
    refused({"no.exr", p.b}, "no.exr");
    refused({p.a, "no.exr"}, "no.exr");
    std::ofstream(p.folder / "text.exr") << "no picture at all";
    refused({(p.folder / "text.exr").string(), p.b}, "it is no OpenEXR file");
    refused({p.a, p.b, "--layer", "fog"}, "layer 'fog' is not in it");
    const std::string small = store(p.folder / "small.exr", Picture({3, 2}));
    refused({small, p.b}, "small.exr has 3x2 pixels and");
    refused({small, p.b}, "has 24x16");
}

TEST_CASE("NaN and infinity in a picture are refused with file and pixel") {
    const Pictures p;
    Picture picture = plain(0.5f);
    picture(2, 3).b = std::nanf("");
    picture(4, 3).r = std::numeric_limits<float>::infinity();
    const std::string broken = store_unchecked(p.folder / "broken.exr", picture);
    for (const Words& pictures : {Words{broken, p.b}, Words{p.a, broken}})
        check_failure(compare(pictures), 3,
                      broken + ": 2 of 384 pixels are NaN or infinite, the first at (2, 3)");
}

TEST_CASE("Ctrl-C ends a comparison with code 130 and leaves no file behind") {
    const TemporaryFolder folder("compare_interrupt");
    // Contrast of 10^36 makes HDR-FLIP look at 120 exposures.
    Picture image({1200, 1000}, mir::Rgb{1e-6f, 1e-6f, 1e-6f});
    image(7, 7) = {1e30f, 1e30f, 1e30f};
    const std::string path = store(folder / "a.exr", image);
    RunningProgram program(
        mir_command({"compare", path, path, "--html", (folder / "r.html").string()}));
    std::this_thread::sleep_for(std::chrono::seconds(1));
    program.send(SIGINT);
    check_failure(program.wait(), 130, "the comparison was cancelled");
    CHECK(folder.files() == 1);
}
