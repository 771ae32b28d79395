// SPDX-License-Identifier: MIT
#include "report/vpl_drawing.hpp"

#include "mir/data/main_bounces.hpp"
#include "mir/io/html_page.hpp"
#include "mir/scene/projection.hpp"
#include "report/sections.hpp"
#include "text.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace mirtool {
namespace {

/// Bounces that have a colour of their own. The last one stands for all later ones too.
constexpr std::uint8_t colours = 6;

std::uint8_t colour_of(std::uint8_t bounce) { return std::clamp<std::uint8_t>(bounce, 1, colours); }

std::string bounce_text(std::uint8_t colour) {
    constexpr std::array<const char*, colours> names{"1: lamps", "2: first reflection", "3", "4",
                                                     "5",        "6 and more"};
    return names.at(colour - 1u);
}

/// A VPL in the picture, its place in pixels.
struct Spot {
    mir::Vec2 place{0};
    double power = 0.0;  ///< luminance, W
    std::uint8_t colour = 1;
    bool hidden = false;  ///< behind a surface
};

double power_of(const mir::Vpl& vpl) {
    return std::numbers::pi * static_cast<double>(luminance(vpl.intensity));
}

/// True when the camera sees something nearer than `point` at a place of its picture.
bool is_hidden(const ReportInput& in, const mir::Camera& camera, mir::Vec2 place, mir::Vec3 point) {
    const float seen = in.result.guides.depth(static_cast<std::uint32_t>(place.x),
                                              static_cast<std::uint32_t>(place.y));
    return seen > 0.0f && camera.depth(point) > 1.01f * seen;
}

/// The VPLs inside of the picture, the strongest first.
std::vector<Spot> spots_of(const ReportInput& in) {
    const mir::RenderSettings& s = in.options.settings;
    const mir::Camera& camera = in.loaded.scene.cameras[s.camera];
    const mir::VplList& vpls = in.result.vpls;
    const std::vector<std::uint8_t> bounces = main_bounces(vpls);
    const auto width = static_cast<float>(s.image.width);
    const auto height = static_cast<float>(s.image.height);
    std::vector<Spot> spots;
    for (std::size_t j = 0; j < bounces.size(); ++j) {
        const mir::Vpl& vpl = vpls.vpls()[j];
        const auto film = mir::project(camera, s.aspect(), vpl.position);
        if (!film || power_of(vpl) <= 0.0) continue;
        const mir::Vec2 place{film->x * width, film->y * height};
        if (!(place.x >= 0.0f && place.x < width && place.y >= 0.0f && place.y < height)) continue;
        spots.push_back({place, power_of(vpl), colour_of(bounces[j]),
                         is_hidden(in, camera, place, vpl.position)});
    }
    std::stable_sort(spots.begin(), spots.end(),
                     [](const Spot& a, const Spot& b) { return a.power > b.power; });
    return spots;
}

/// Number and power of the VPLs of each colour, all of them.
struct Share {
    std::size_t vpls = 0;
    double power = 0.0;
};

std::array<Share, colours + 1> shares_of(const mir::VplList& vpls) {
    std::array<Share, colours + 1> shares{};
    const std::vector<std::uint8_t> bounces = main_bounces(vpls);
    for (std::size_t j = 0; j < bounces.size(); ++j) {
        Share& share = shares[colour_of(bounces[j])];
        ++share.vpls;
        share.power += power_of(vpls.vpls()[j]);
    }
    return shares;
}

std::string class_of(std::uint8_t colour) { return "b" + std::to_string(colour); }

}  // namespace

std::string vpl_drawing(const ReportInput& in) {
    if (in.result.vpls.empty()) return "";
    std::vector<Spot> spots = spots_of(in);
    double power = 0.0;
    for (const Spot& spot : spots) power += spot.power;
    // A VPL of mean power is as wide as 1.6 % of the picture.
    const mir::Extent size = in.result.beauty.extent();
    const double mean_radius = 0.008 * std::max(size.width, size.height);
    const double scale = mean_radius * std::sqrt(static_cast<double>(spots.size()) / power);
    if (spots.size() > most_drawn_vpls) spots.resize(most_drawn_vpls);
    std::string svg = R"(<svg id="vpls" class="vpl off" aria-hidden="true" viewBox="0 0 )" +
                      std::to_string(size.width) + " " + std::to_string(size.height) + "\">\n";
    for (std::uint8_t colour = 1; colour <= colours; ++colour) {
        svg += "<g id=\"vpl-" + class_of(colour) + "\" class=\"" + class_of(colour) + "\">";
        for (const Spot& spot : spots)
            if (spot.colour == colour)
                svg += "<circle cx=\"" + fixed(spot.place.x, 1) + "\" cy=\"" +
                       fixed(spot.place.y, 1) + "\" r=\"" +
                       fixed(scale * std::sqrt(spot.power), 2) + "\"" +
                       (spot.hidden ? " class=\"h\"" : "") + "/>";
        svg += "</g>\n";
    }
    return svg + "</svg>\n";
}

std::string vpl_controls(const ReportInput& in) {
    if (in.result.vpls.empty()) return "";
    std::string out = R"(<div><input type="checkbox" id="vpl-show"><label for="vpl-show"> )"
                      "Draw VPLs</label> <label for=\"vpl-bounce\">of bounce</label>"
                      R"(<select id="vpl-bounce"><option value="all">all</option>)";
    const auto shares = shares_of(in.result.vpls);
    for (std::uint8_t colour = 1; colour <= colours; ++colour)
        if (shares[colour].vpls > 0)
            out += "<option value=\"vpl-" + class_of(colour) + "\">" + bounce_text(colour) +
                   "</option>";
    return out + "</select></div>\n";
}

std::string vpl_legend(const ReportInput& in) {
    if (in.result.vpls.empty()) return "";
    std::string list = "<ul id=\"vpl-legend\" class=\"legend\">\n";
    const auto shares = shares_of(in.result.vpls);
    for (std::uint8_t colour = 1; colour <= colours; ++colour)
        if (shares[colour].vpls > 0)
            list += R"(<li><svg class="swatch" aria-hidden="true" viewBox="0 0 16 16"><circle )"
                    "class=\"" +
                    class_of(colour) + R"(" cx="8" cy="8" r="7"/></svg> VPLs of bounce )" +
                    bounce_text(colour) + "</li>\n";
    return list + "</ul>\n";
}

std::string vpls_section(const ReportInput& in) {
    const mir::VplList& vpls = in.result.vpls;
    if (vpls.empty()) return "";
    const auto shares = shares_of(vpls);
    double all = 0.0;
    for (const Share& share : shares) all += share.power;
    mir::detail::HtmlTable table{
        "Placed VPLs by the bounce that brings most of their power (1 is light of a lamp itself)",
        {"Bounce", "VPLs", "Power, W (luminance)", "Share of the power"},
        {}};
    for (std::uint8_t colour = 1; colour <= colours; ++colour)
        if (const Share& share = shares[colour]; share.vpls > 0)
            table.rows.push_back({bounce_text(colour), std::to_string(share.vpls),
                                  number(share.power),
                                  all > 0.0 ? percent(share.power / all) : "none"});
    const std::vector<Spot> spots = spots_of(in);
    const auto hidden =
        std::count_if(spots.begin(), spots.end(), [](const Spot& spot) { return spot.hidden; });
    return "<h2>Virtual point lights</h2>\n<p>" + std::to_string(vpls.size()) + " placed, " +
           std::to_string(spots.size()) + " shine and lie inside of the picture, " +
           std::to_string(hidden) +
           " of them behind a surface, drawn faint. The area of a circle is proportional to the "
           "power of its light; at most " +
           std::to_string(most_drawn_vpls) + " are drawn, the strongest.</p>\n" +
           mir::detail::html_table(table);
}

}  // namespace mirtool
