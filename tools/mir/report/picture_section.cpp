// SPDX-License-Identifier: MIT
#include "mir/compare/comparable.hpp"
#include "mir/io/html_page.hpp"
#include "report/layers.hpp"
#include "report/sections.hpp"
#include "report/vpl_drawing.hpp"
#include "text.hpp"

#include <algorithm>

namespace mirtool {
namespace {

/// Leaves room for text, VPLs and statistics in 5 MB.
constexpr std::size_t most_picture_bytes = 4'400'000;

std::string option(const std::string& value, const std::string& label, bool chosen = false) {
    return "<option value=\"" + value + (chosen ? "\" selected>" : "\">") + label + "</option>";
}

std::string tone_options(mir::ToneCurve chosen) {
    std::string all;
    for (const mir::ToneCurveName& t : mir::tone_curve_names)
        all += option(std::string(t.name), std::string(t.label), t.curve == chosen);
    return all;
}

/// The choices of what to show; each names the layers that are added up.
std::string layer_options(const ReportPictures& pictures) {
    std::string beauty, indirect, single;
    for (const ReportLayer& layer : pictures.layers) {
        single += option(layer.id, layer.label);
        if (layer.id == "reference" || layer.id == "denoised") continue;
        beauty += (beauty.empty() ? "" : " ") + layer.id;
        if (layer.id.starts_with("bounce")) indirect += (indirect.empty() ? "" : " ") + layer.id;
    }
    std::string all = option(beauty, "Beauty");
    if (!indirect.empty()) all += option(indirect, "Indirect light");
    all += single;
    if (!pictures.error.empty())
        all += R"(<option value="error" data-image="error">Signed error</option>)";
    return all;
}

std::string range(const std::string& id, const std::string& label, const std::string& attributes) {
    return "<div><label for=\"" + id + "\">" + label + R"(</label><input type="range" id=")" + id +
           "\" " + attributes + "><output id=\"" + id + "-value\" for=\"" + id +
           "\"></output></div>\n";
}

std::string controls(const ReportInput& in, const ReportPictures& pictures,
                     const mir::PreviewLook& look) {
    std::string out = R"(<div id="controls" class="controls" role="group" )"
                      "aria-label=\"Controls of the picture\" hidden>\n"
                      R"(<div><label for="layer">Layer</label><select id="layer">)" +
                      layer_options(pictures) + "</select></div>\n";
    const double ev = static_cast<double>(look.exposure_ev);
    out += range("exposure", "Exposure",
                 "min=\"" + number(ev - 10.0) + "\" max=\"" + number(ev + 10.0) +
                     R"(" step="0.1" value=")" + number(ev) + "\"");
    out += R"(<div><label for="curve">Tone curve</label><select id="curve">)" +
           tone_options(look.tone) + "</select></div>\n";
    if (!pictures.error.empty())
        out += range("split", "Split: render left, reference right",
                     R"(min="0" max="100" step="1" value="50")");
    return out + vpl_controls(in) + "</div>\n";
}

std::string stage(const ReportInput& in, const ReportPictures& pictures,
                  const mir::PreviewLook& look) {
    const mir::Extent full = in.result.beauty.extent();
    const auto side = [&](std::uint32_t n) {
        return std::to_string((n + pictures.shrink - 1) / pictures.shrink);
    };
    return R"(<div class="stage" style="max-width: )" + std::to_string(std::max(full.width, 640u)) +
           "px\">\n<img id=\"still\" alt=\"" + mir::detail::html_escaped(in.options.scene) +
           ", beauty at " + number(double(look.exposure_ev)) + " EV\" width=\"" +
           std::to_string(full.width) + "\" height=\"" + std::to_string(full.height) +
           "\" src=\"data:image/png;base64," + pictures.still +
           "\">\n<canvas id=\"canvas\" role=\"img\" aria-label=\"Picture\" tabindex=\"0\" "
           R"(aria-describedby="keys" width=")" +
           side(full.width) + "\" height=\"" + side(full.height) + "\" data-shrink=\"" +
           std::to_string(pictures.shrink) + "\" hidden></canvas>\n" + vpl_drawing(in) + "</div>\n";
}

std::string notes(const ReportPictures& pictures) {
    std::string text =
        "<p id=\"readout\" role=\"status\"></p>\n<p id=\"keys\">Radiance is read under the "
        "pointer, "
        "or with the arrow keys when the picture has the focus (Shift for steps of ten). It is "
        "stored in steps of 1 %; the OpenEXR file is exact.";
    if (pictures.shrink > 1)
        text += " One pixel here is the mean of " + std::to_string(pictures.shrink) + "x" +
                std::to_string(pictures.shrink) + " of the render, to keep this file small.";
    return text + "</p>\n";
}

std::string error_figure(const ReportPictures& pictures) {
    if (pictures.error.empty()) return "";
    const std::string caption =
        "Signed error of luminance: red where the render is brighter than the reference, blue "
        "where it is darker, in full colour from " +
        number(pictures.error_range) + " W/(m² sr)";
    return R"(<figure class="error"><img id="error" alt=")" + caption +
           "\" src=\"data:image/png;base64," + pictures.error + "\"><figcaption>" + caption +
           "</figcaption></figure>\n";
}

}  // namespace

std::string picture_section(const ReportInput& in, const mir::PreviewLook& look) {
    const ReportPictures pictures = report_pictures(in, look, most_picture_bytes);
    std::string section =
        "<h2>Picture</h2>\n<p id=\"status\" role=\"status\">The picture stands still: layers and "
        "exposure need JavaScript.</p>\n" +
        controls(in, pictures, look) + stage(in, pictures, look) + vpl_legend(in) +
        notes(pictures) + error_figure(pictures);
    for (const ReportLayer& layer : pictures.layers)
        section += R"(<script type="application/octet-stream" id=")" + layer.id + "\">" +
                   layer.code + "</script>\n";
    return section;
}

}  // namespace mirtool
