// SPDX-License-Identifier: MIT
#include "tool/browser.hpp"
#include "tool/report_file.hpp"

#include <nlohmann/json.hpp>

#include <set>

using namespace mirtest;

namespace {

/// What is missing to judge pages; empty when nothing is.
std::string missing() {
    if (browser().empty()) return "no chromium, chromium-browser or google-chrome on the path";
    if (!std::filesystem::exists(MIR_AXE)) return "no " MIR_AXE ", which .ci/run fetches";
    return "";
}

/// `text` with the only occurrence of `from` replaced.
std::string with(std::string text, const std::string& from, const std::string& to) {
    INFO(from);
    REQUIRE(count_of(text, from) == 1);
    return text.replace(text.find(from), from.size(), to);
}

/// A copy of a page that axe-core looks at when it is drawn, with its verdict in an element at the
/// end. The page's policy would let neither script run: that it does so is tested elsewhere.
std::string judged(const std::string& page) {
    const std::string policy = "<meta http-equiv=\"Content-Security-Policy\"";
    const std::string run = R"(
<script>addEventListener('load', () => axe.run({runOnly:
 ['wcag2a', 'wcag2aa', 'wcag21a', 'wcag21aa', 'wcag22aa', 'best-practice']}).then(r => {
 const e = document.createElement('pre');
 e.id = 'verdict';
 e.textContent = btoa(unescape(encodeURIComponent(JSON.stringify({passes: r.passes.length,
  violations: r.violations.map(v => ({id: v.id, nodes: v.nodes.map(n => n.html)})),
  open: r.incomplete.flatMap(v => v.nodes.map(n => v.id + ' ' + n.html))}))));
 document.body.append(e); }));</script>
</body>)";
    return with(with(page, policy, "<meta name=\"policy\""), "</body>",
                "<script>" + file_bytes(MIR_AXE) + "</script>" + run);
}

struct Verdict {
    std::size_t passes = 0;
    std::set<std::string> violations;  ///< names of rules
    Words open;                        ///< what axe-core leaves to people: rule and element
    std::string text;
};

Verdict verdict_on(const std::string& page, const TemporaryFolder& folder, const Words& more = {}) {
    const auto path = folder / "judged.html";
    std::ofstream(path, std::ios::binary) << judged(page);
    const Outcome dom = open_page(path, folder, Words{"--dump-dom"} + more);
    const auto bytes = from_base64(between(dom.out, "<pre id=\"verdict\">", "</pre>"));
    UNSCOPED_INFO(dom.err);
    REQUIRE_FALSE(bytes.empty());
    const auto found = nlohmann::json::parse(bytes.begin(), bytes.end());
    Verdict verdict{found["passes"], {}, found["open"], found["violations"].dump(1)};
    for (const auto& violation : found["violations"]) verdict.violations.insert(violation["id"]);
    return verdict;
}

void check_readable(const std::string& page, const TemporaryFolder& folder) {
    const Words dark_and_wide = {"--blink-settings=preferredColorScheme=0",
                                 "--window-size=1200,900"};
    const Words light_and_narrow = {"--blink-settings=preferredColorScheme=1",
                                    "--window-size=360,640"};
    for (const Words& look : {dark_and_wide, light_and_narrow}) {
        const Verdict v = verdict_on(page, folder, look);
        INFO(look[0] << ' ' << look[1] << ": " << v.text);
        CHECK(v.violations.empty());
        CHECK(v.passes >= 10);
        // It cannot tell what is behind the letters of a drawing: the page is.
        for (const std::string& element : v.open) CHECK(has(element, "color-contrast <text "));
    }
}

}  // namespace

TEST_CASE("reports of renders and comparisons keep to WCAG 2.2, A and AA, in light and dark") {
    if (const std::string what = missing(); !what.empty()) {
        WARN("skipped: " << what);
        return;
    }
    const TemporaryFolder folder("report_accessibility");
    const auto path = [&](const char* name) { return (folder / name).string(); };
    const auto render = [&](const char* name, const Words& more) {
        REQUIRE(run_mir(small_render(path(name)) + Words{"--no-png"} + more).exit_code == 0);
    };
    render("a.exr", {"--seed", "2"});
    render("b.exr", {"--report", path("r.html"), "--report-reference", path("a.exr")});
    REQUIRE(
        run_mir({"compare", path("a.exr"), path("b.exr"), "--html", path("c.html")}).exit_code ==
        0);
    const std::string report = file_bytes(path("r.html"));
    check_readable(report, folder);
    check_readable(file_bytes(path("c.html")), folder);
    // The judge sees what is wrong.
    const std::string deaf = with(report, "<html lang=\"en\">", "<html>");
    CHECK(verdict_on(deaf, folder).violations == std::set<std::string>{"html-has-lang"});
    const std::string pale =
        with(report, "</style>", "h1 { color: #d0d0d0; background: #e8e8e8 }</style>");
    CHECK(verdict_on(pale, folder).violations == std::set<std::string>{"color-contrast"});
}
