// SPDX-License-Identifier: MIT
#include "paper/options.hpp"

#include "paper/paper_numbers.hpp"
#include "support/catch.hpp"

namespace {

mirpaper::ParsedOptions parsed(std::vector<const char*> words) {
    words.insert(words.begin(), "bench_paper");
    return mirpaper::parse(static_cast<int>(words.size()), words.data());
}

}  // namespace

TEST_CASE("Without options everything is measured as the paper did") {
    const auto [options, help, error] = parsed({});
    CHECK(error.empty());
    CHECK_FALSE(help);
    CHECK(options.size == mir::Extent{1600, 1200});
    CHECK(options.repeat == 20);
    for (const char* figure : {"8", "9", "10", "11", "rates", "stages"})
        CHECK(options.wants(figure));
    CHECK_FALSE(options.wants("12"));
}

TEST_CASE("Options of bench_paper are read") {
    const auto [o, help, error] =
        parsed({"--figure",         "9,11",       "--backend",     "cpu",
                "--scenes",         "car,garage", "--vpls",        "16,1024",
                "--size",           "64x48",      "--repeat",      "3",
                "--host-repeat",    "2",          "--threads",     "4",
                "--traversal-cost", "0.5",        "--empty-bonus", "0.25",
                "--splits",         "0.1",        "--out",         "there"});
    REQUIRE(error.empty());
    CHECK(o.figures == std::vector<std::string>{"9", "11"});
    CHECK(o.backends == std::vector<std::string>{"cpu"});
    CHECK(o.scenes == std::vector<std::string>{"car", "garage"});
    CHECK(o.vpls == std::vector<std::uint32_t>{16, 1024});
    CHECK(o.size == mir::Extent{64, 48});
    CHECK(o.repeat == 3);
    CHECK(o.host_repeat == 2);
    CHECK(o.threads == 4);
    CHECK(o.tree.traversal_cost == 0.5f);
    CHECK(o.tree.empty_bonus == 0.25f);
    CHECK(o.wide.splits == 0.1f);
    CHECK(o.out == "there");
    CHECK(parsed({"--help"}).help);
}

TEST_CASE("Bad options of bench_paper are refused in one line that names them") {
    const std::vector<std::vector<const char*>> bad{
        {"--figure", "7"},      {"--figure", ""},
        {"--figure"},           {"--backend", "gpu"},
        {"--scenes", "nope"},   {"--vpls", "0"},
        {"--vpls", "12x"},      {"--vpls", ""},
        {"--size", "10"},       {"--size", "0x10"},
        {"--size", "10x"},      {"--size", "99999x1"},
        {"--repeat", "0"},      {"--repeat", "-1"},
        {"--host-repeat", "x"}, {"--threads", "1000000"},
        {"--unknown", "1"},     {"word"},
        {"--empty-bonus", "1"}, {"--traversal-cost", "0"},
        {"--empty-bonus", "x"}, {"--splits", "2"},
    };
    for (const auto& words : bad) {
        const std::string error = parsed(words).error;
        CHECK(error.find(words.front()) != std::string::npos);
        CHECK(error.find('\n') == std::string::npos);
    }
}

TEST_CASE("The paper's numbers are found by figure, scene, algorithm and tile") {
    CHECK(mirpaper::paper_seconds("8", "sphere", "cpu", "256x256") == 200.0);
    CHECK(mirpaper::paper_seconds("9", "car-grille", "rcvp", "256x256") == 31.0);
    CHECK(mirpaper::paper_seconds("11", "car", "rcvp", "512x512") == 15.0);
    CHECK(mirpaper::paper_seconds("11", "car", "rc", "512x512") == 0.0);
    CHECK(mirpaper::paper_seconds("9", "garage", "rc", "256x256") == 0.0);
    CHECK(mirpaper::paper_peak("garage") == 140e6);
    CHECK(mirpaper::paper_peak("car-grille") == 0.0);
}
