// SPDX-License-Identifier: MIT
#include "mir/io/html_report.hpp"

#include "mir/io/html_text.hpp"
#include "support/catch.hpp"
#include "support/temporary_folder.hpp"

#include <fstream>
#include <iterator>
#include <string>

namespace {

using mir::Image;
using mir::Rgb;
using mirtest::TemporaryFolder;

std::string text_of(const std::filesystem::path& path) {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

bool has(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

std::size_t count(const std::string& text, const std::string& part) {
    std::size_t n = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
        ++n;
    return n;
}

std::string base64_of(const std::string& text) {
    return mir::detail::base64({text.begin(), text.end()});
}

}  // namespace

TEST_CASE("base64 gives the test values of RFC 4648") {
    CHECK(base64_of("").empty());
    CHECK(base64_of("f") == "Zg==");
    CHECK(base64_of("fo") == "Zm8=");
    CHECK(base64_of("foo") == "Zm9v");
    CHECK(base64_of("foob") == "Zm9vYg==");
    CHECK(base64_of("fooba") == "Zm9vYmE=");
    CHECK(base64_of("foobar") == "Zm9vYmFy");
    CHECK(mir::detail::base64({0xff, 0xfe, 0xfd}) == "//79");
}

TEST_CASE("a report holds its title, rows and pictures and asks for nothing else") {
    const TemporaryFolder folder("html_report");
    const Image<Rgb> image({3, 2}, Rgb{0.1f, 0.2f, 0.3f});
    mir::write_html_report(folder / "a.html",
                           {"A title", {{"rmse", "0.25"}}, {{"one", &image}, {"two", &image}}});
    const std::string page = text_of(folder / "a.html");
    CHECK(page.rfind("<!DOCTYPE html>", 0) == 0);
    CHECK(has(page, "<title>A title</title>"));
    CHECK(has(page, ">rmse</th><td>0.25<"));
    CHECK(count(page, "src=") == 2);
    CHECK(count(page, "src=\"data:image/png;base64,iVBORw0KGgo") == 2);
    CHECK(count(page, "default-src 'none'") == 1);
    for (const char* outside : {"http:", "https:", "<script", "<link", "url(", "@import"})
        CHECK_FALSE(has(page, outside));
    CHECK(folder.files() == 1);
}

TEST_CASE("text of a report is never markup") {
    const TemporaryFolder folder("html_report_escapes");
    const Image<Rgb> image({1, 1});
    const std::string evil = "\"><script>alert('&')</script>";
    mir::write_html_report(folder / "a.html", {evil, {{evil, evil}}, {{evil, &image}}});
    const std::string page = text_of(folder / "a.html");
    CHECK_FALSE(has(page, "<script"));
    CHECK_FALSE(has(page, "alert('"));
    CHECK(count(page, "&quot;&gt;&lt;script&gt;alert(&#39;&amp;&#39;)&lt;/script&gt;") == 6);
}

TEST_CASE("text of a report cannot change the order of what is around it, nor hide") {
    CHECK(mir::detail::html_escaped("a\xe2\x80\xae"
                                    "b<\x1b\xff>") == "a\\u202eb&lt;\\x1b\\xff&gt;");
    const std::string umlauts(3000, '\xc3');
    CHECK(mir::detail::html_escaped(umlauts).size() == 12000);
}

TEST_CASE("equal input gives equal bytes of report") {
    const TemporaryFolder folder("html_report_equal");
    const Image<Rgb> image({8, 8}, Rgb{0.1f, 0.2f, 0.3f});
    for (const char* name : {"a.html", "b.html"})
        mir::write_html_report(folder / name, {"t", {{"k", "v"}}, {{"c", &image}}});
    CHECK(text_of(folder / "a.html") == text_of(folder / "b.html"));
}

TEST_CASE("a report that cannot be written is an error that names the file") {
    const TemporaryFolder folder("html_report_missing");
    try {
        mir::write_html_report(folder / "missing" / "a.html", {});
        FAIL("nothing was thrown");
    } catch (const mir::Error& error) {
        CHECK(error.code() == mir::ErrorCode::io);
        CHECK(has(error.what(), "a.html"));
    }
    const Image<Rgb> empty;
    CHECK_THROWS_AS(mir::write_html_report(folder / "a.html", {"t", {}, {{"c", &empty}}}),
                    mir::Error);
    CHECK_THROWS_AS(mir::write_html_report(folder / "a.html", {"t", {}, {{"c", nullptr}}}),
                    mir::Error);
    CHECK(folder.files() == 0);
}
