// SPDX-License-Identifier: MIT
#include "options.hpp"

#include "mir/scenes.hpp"

#include <algorithm>
#include <charconv>
#include <functional>
#include <sstream>

namespace mirpaper {
namespace {

using Names = std::vector<std::string>;

const Names figure_names{"8",      "9",      "10",      "11",     "rates",
                         "stages", "luxels", "kernels", "shafts", "counters"};
const Names quick_figures{"8", "stages", "luxels", "kernels", "shafts", "counters"};
constexpr std::uint32_t most_vpls = 65536;

/// A value that cannot be used; the message is the line that the user reads.
struct BadValue {
    std::string message;
};

Names words_of(const std::string& text) {
    Names words;
    std::istringstream stream(text);
    for (std::string word; std::getline(stream, word, ',');) words.push_back(word);
    return words;
}

std::string joined(const Names& names) {
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
    return text;
}

Names choose(const std::string& option, const std::string& text, const Names& known) {
    Names words = words_of(text);
    const auto stranger = std::find_if(words.begin(), words.end(), [&](const std::string& word) {
        return std::find(known.begin(), known.end(), word) == known.end();
    });
    if (stranger != words.end())
        throw BadValue{option + ": '" + *stranger + "' is unknown; choose of " + joined(known)};
    if (words.empty()) throw BadValue{option + " names nothing; choose of " + joined(known)};
    return words;
}

std::uint32_t number(const std::string& option, const std::string& text, std::uint32_t least,
                     std::uint32_t most) {
    std::uint32_t value = 0;
    const char* const end = text.data() + text.size();
    const auto [rest, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc() || rest != end || value < least || value > most)
        throw BadValue{option + ": '" + text + "' is not a whole number from " +
                       std::to_string(least) + " to " + std::to_string(most)};
    return value;
}

float real(const std::string& option, const std::string& text) {
    float value = 0.0f;
    const char* const end = text.data() + text.size();
    const auto [rest, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc() || rest != end)
        throw BadValue{option + ": '" + text + "' is not a number"};
    return value;
}

/// A choice for a tree, which knows its own limits.
template <class TreeOptions>
void set_tree(float& choice, const TreeOptions& tree, const std::string& option,
              const std::string& text) {
    choice = real(option, text);
    try {
        mir::check(tree);
    } catch (const mir::Error& e) {
        throw BadValue{option + ": " + e.what()};
    }
}

mir::Extent size(const std::string& option, const std::string& text) {
    const std::size_t cross = text.find('x');
    if (cross == std::string::npos)
        throw BadValue{option + ": '" + text + "' is no size; give WIDTHxHEIGHT, as in 1600x1200"};
    return {number(option, text.substr(0, cross), 1, 16384),
            number(option, text.substr(cross + 1), 1, 16384)};
}

Names figures(const std::string& option, const std::string& text) {
    Names known = figure_names;
    known.insert(known.end(), {"all", "quick"});
    Names wanted;
    for (const std::string& name : choose(option, text, known)) {
        const Names more = name == "all"     ? figure_names
                           : name == "quick" ? quick_figures
                                             : Names{name};
        wanted.insert(wanted.end(), more.begin(), more.end());
    }
    return wanted;
}

Names scenes(const std::string& option, const std::string& text) {
    Names known;
    for (const mir::builtin::Entry& entry : mir::builtin::scenes) known.emplace_back(entry.name);
    return choose(option, text, known);
}

std::vector<std::uint32_t> numbers(const std::string& option, const std::string& text) {
    std::vector<std::uint32_t> values;
    for (const std::string& word : words_of(text))
        values.push_back(number(option, word, 1, most_vpls));
    if (values.empty()) throw BadValue{option + " names no number of VPLs"};
    return values;
}

void set(Options& o, const std::string& option, const std::string& value) {
    if (option == "--figure")
        o.figures = figures(option, value);
    else if (option == "--backend")
        o.backends = choose(option, value, {"cpu", "cuda"});
    else if (option == "--scenes")
        o.scenes = scenes(option, value);
    else if (option == "--vpls")
        o.vpls = numbers(option, value);
    else if (option == "--size")
        o.size = size(option, value);
    else if (option == "--repeat")
        o.repeat = number(option, value, 1, 10000);
    else if (option == "--host-repeat")
        o.host_repeat = number(option, value, 1, 10000);
    else if (option == "--threads")
        o.threads = number(option, value, 0, 4096);
    else if (option == "--traversal-cost")
        set_tree(o.tree.traversal_cost, o.tree, option, value);
    else if (option == "--empty-bonus")
        set_tree(o.tree.empty_bonus, o.tree, option, value);
    else if (option == "--splits")
        set_tree(o.wide.splits, o.wide, option, value);
    else if (option == "--out")
        o.out = value;
    else
        throw BadValue{"'" + option + "' is no option; --help lists them"};
}

}  // namespace

bool Options::wants(const std::string& figure) const {
    return std::find(figures.begin(), figures.end(), figure) != figures.end();
}

ParsedOptions parse(int argc, const char* const* argv) {
    ParsedOptions parsed;
    parsed.options.figures = figure_names;
    try {
        for (int i = 1; i < argc; i += 2) {
            const std::string option = argv[i];
            if (option == "--help" || option == "-h") {
                parsed.help = true;
                return parsed;
            }
            if (i + 1 == argc && option.starts_with("--"))
                throw BadValue{option + " needs a value; --help lists the options"};
            set(parsed.options, option, i + 1 < argc ? argv[i + 1] : "");
        }
    } catch (const BadValue& bad) {
        parsed.error = bad.message;
    }
    return parsed;
}

std::string usage() {
    return "bench_paper: the measurements of the 2009 paper, section 6, on this machine\n\n"
           "  --figure LIST       of " +
           joined(figure_names) +
           "; all (default),\n"
           "                      or quick: one scene, few things\n"
           "  --backend LIST      cpu, cuda (default: all that exist)\n"
           "  --scenes LIST       built-in scenes instead of those of each figure\n"
           "  --vpls LIST         numbers of VPLs instead of those of each figure\n"
           "  --size WIDTHxHEIGHT luxels (default 1600x1200)\n"
           "  --repeat N          runs of which the median is taken (default 20)\n"
           "  --host-repeat N     the same where rays are traced on the host (default 3)\n"
           "  --threads N         of the host (default 0: every core)\n"
           "  --traversal-cost X  of an inner node of the kd-tree, in triangle tests\n"
           "  --empty-bonus X     of planes of the kd-tree that cut off empty space, 0 <= X < 1\n"
           "  --splits X          of triangles of the wide hierarchy, for each of them; 0 <= X <= "
           "1\n"
           "  --out FOLDER        writes paper.json, paper.csv and paper.md there\n\n"
           "Tables go to stdout, progress to stderr. Exit codes: 0 done, 1 failed, 2 usage, 4 no "
           "such device.\n";
}

}  // namespace mirpaper
