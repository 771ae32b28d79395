// SPDX-License-Identifier: MIT
#include "io/features/page.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <sstream>
#include <string>

using namespace mirtest;

TEST_CASE("docs/scene_files.md shows the features and what becomes of them") {
    const std::filesystem::path file = std::filesystem::path(MIR_DOCS_DIR) / "scene_files.md";
    std::ifstream in(file, std::ios::binary);
    REQUIRE(in);
    const std::string page{std::istreambuf_iterator<char>(in), {}};
    const std::string wanted = features::with_tables(page, features::page_tables());
    if (std::getenv("MIR_WRITE_DOCS") != nullptr) {
        write_file(file, wanted);
        WARN("written: " << file);
        return;
    }
    INFO("the page (-) and the tests (+) differ first in\n"
         << features::first_difference(page, wanted)
         << "\nMIR_WRITE_DOCS=1 in the environment of this test writes the page anew");
    const bool is_as_wanted = page == wanted;
    CHECK(is_as_wanted);
}

TEST_CASE("every row of the features says something, and no two of a table say the same") {
    std::set<std::string> rows;
    std::istringstream lines(features::page_tables());
    std::string section;
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with("### ")) section = line;
        if (!line.starts_with("| ") || line.starts_with("| Feature") ||
            line.starts_with("| Extension"))
            continue;
        INFO(line);
        CHECK(std::count(line.begin(), line.end(), '|') == 4);
        CHECK(line.find("|  |") == std::string::npos);
        CHECK(rows.insert(section + line.substr(0, line.find(" | "))).second);
    }
    CHECK(rows.size() > 150);
}
