// SPDX-License-Identifier: MIT
#include "compare_output.hpp"

#include "mir/compare/error_picture.hpp"
#include "mir/io/exr.hpp"
#include "mir/io/html_report.hpp"
#include "mir/io/png.hpp"
#include "mir/version.hpp"
#include "output_places.hpp"
#include "text.hpp"

#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <cstdio>
#include <utility>

namespace mirtool {
namespace {

using Json = nlohmann::ordered_json;
using Rows = std::vector<std::pair<std::string, std::string>>;

constexpr std::array<const char*, 3> channel_names{"R", "G", "B"};

std::string triple(const std::array<double, 3>& v) {
    return number(v[0]) + ", " + number(v[1]) + ", " + number(v[2]);
}

/// Ratios of the channels' means; NaN where the reference's is zero.
std::array<double, 3> ratios_of(const mir::ImageMetrics& m) {
    std::array<double, 3> ratios{};
    for (std::size_t c = 0; c < 3; ++c)
        ratios[c] = m.reference_mean[c] == 0.0 ? std::nan("") : m.mean[c] / m.reference_mean[c];
    return ratios;
}

/// Rows on the light of both pictures.
void add_means(Rows& rows, const mir::ImageMetrics& m) {
    const mir::LargestDifference& most = m.largest;
    rows.emplace_back("mean R, G, B", triple(m.mean));
    rows.emplace_back("mean of reference", triple(m.reference_mean));
    rows.emplace_back("ratio of means", triple(ratios_of(m)));
    rows.emplace_back("mean difference", number(100.0 * m.mean_difference()) + " %");
    rows.emplace_back("largest difference",
                      number(most.value) + " (" + channel_names[most.channel] + " of pixel " +
                          std::to_string(most.x) + ", " + std::to_string(most.y) + ")");
}

bool has_origin(const Comparison& c) {
    return c.origin != mir::DVec3(0.0) || c.reference_origin != mir::DVec3(0.0);
}

/// Rows on what positions are counted from, where that is said.
void add_origins(Rows& rows, const Comparison& c) {
    if (!has_origin(c)) return;
    rows.emplace_back("origin", place(c.origin) + " m");
    rows.emplace_back("origin of reference", place(c.reference_origin) + " m");
}

std::string scaled_text(const Comparison& c, const CompareOptions& o) {
    return number(c.scaled.mean) + " (" + number(c.scaled.trimmed) + " without the worst " +
           number(100.0 * mir::ScaledRelMseSettings{}.worst_share) + " % of the pixels" +
           (o.second_reference.empty() ? ")" : "; noise of the references left out)");
}

Rows rows_of(const Comparison& c, const CompareOptions& o) {
    const mir::ImageMetrics& m = c.metrics;
    const mir::FlipExposures& e = c.flip_exposures;
    Rows rows{{"image", o.image},
              {"reference", o.reference},
              {"layer", o.layer.empty() ? "beauty" : o.layer},
              {"size", std::to_string(c.image.width()) + " x " + std::to_string(c.image.height())}};
    if (!o.second_reference.empty()) rows.emplace_back("second reference", o.second_reference);
    add_origins(rows, c);
    rows.insert(rows.end(),
                {{"RMSE", number(m.rmse())},
                 {"MSE", number(m.mse)},
                 {"relMSE", number(m.rel_mse) + " (epsilon " + number(o.epsilon) + ")"},
                 {"scaled relMSE", scaled_text(c, o)},
                 {"MAE", number(m.mae)},
                 {"HDR-FLIP", number(c.flip) + " (" + std::to_string(e.count) + " exposures from " +
                                  number(e.start) + " to " + number(e.stop) + " EV)"},
                 {"LDR-FLIP", number(c.ldr_flip) + " (at " + number(c.exposure) + " EV)"}});
    add_means(rows, m);
    for (const std::string& name : c.exceeded) rows.emplace_back("above its limit", name);
    return rows;
}

/// What was compared.
Json head_of(const Comparison& c, const CompareOptions& o) {
    Json head{{"version", mir::version}, {"image", o.image}, {"reference", o.reference}};
    if (!o.second_reference.empty()) head["second_reference"] = o.second_reference;
    head["layer"] = o.layer;
    head["width"] = c.image.width();
    head["height"] = c.image.height();
    return head;
}

Json scaled_json(const Comparison& c) {
    const mir::ScaledRelMseSettings settings;
    return {{"mean", c.scaled.mean},
            {"trimmed", c.scaled.trimmed},
            {"worst_share", settings.worst_share},
            {"epsilon", settings.epsilon}};
}

void add_flip(Json& out, const Comparison& c, const CompareOptions& o) {
    const mir::FlipExposures& e = c.flip_exposures;
    out["flip"] = c.flip;
    out["flip_exposures"] = {{"start", e.start}, {"stop", e.stop}, {"count", e.count}};
    out["ldr_flip"] = c.ldr_flip;
    out["exposure"] = c.exposure;
    out["pixels_per_degree"] = o.pixels_per_degree;
}

/// JSON has no infinity and no NaN: they become null.
Json json_of(const Comparison& c, const CompareOptions& o) {
    const mir::ImageMetrics& m = c.metrics;
    Json out = head_of(c, o);
    if (has_origin(c))
        out["origin"] = {
            {"image", {c.origin.x, c.origin.y, c.origin.z}},
            {"reference", {c.reference_origin.x, c.reference_origin.y, c.reference_origin.z}}};
    out["rmse"] = m.rmse();
    out["mse"] = m.mse;
    out["relmse"] = m.rel_mse;
    out["relmse_epsilon"] = o.epsilon;
    out["scaled_relmse"] = scaled_json(c);
    out["mae"] = m.mae;
    add_flip(out, c, o);
    out["mean_radiance"] = {
        {"image", m.mean}, {"reference", m.reference_mean}, {"ratio", ratios_of(m)}};
    out["mean_difference_percent"] = 100.0 * m.mean_difference();
    out["largest_difference"] = {{"value", m.largest.value},
                                 {"x", m.largest.x},
                                 {"y", m.largest.y},
                                 {"channel", channel_names[m.largest.channel]}};
    out["exceeded"] = c.exceeded;
    if (!o.report.empty()) out["report"] = o.report;
    if (!o.error.empty()) out["error"] = o.error;
    return out;
}

void write_report(const Comparison& c, const CompareOptions& o,
                  const mir::Image<mir::Rgb>& error_picture, float range) {
    const mir::Image<mir::Rgb> flip_picture = mir::flip_picture(c.flip_map);
    const std::string at = " at " + number(c.exposure) + " EV";
    mir::write_html_report(
        o.report,
        {o.image + " compared with " + o.reference,
         rows_of(c, o),
         {{"image" + at, &c.image, c.exposure},
          {"reference" + at, &c.reference, c.exposure},
          {"signed error of luminance: red where the image is brighter, blue where it is darker, "
           "in full colour from " +
               number(range),
           &error_picture},
          {"HDR-FLIP: black for 0, pale yellow for 1", &flip_picture}}});
}

}  // namespace

void check_outputs(const CompareOptions& o) {
    std::vector<std::string> inputs{o.image, o.reference};
    if (!o.second_reference.empty()) inputs.push_back(o.second_reference);
    check_output_places(inputs, {o.report, o.error}, "comparison");
}

void write_outputs(const Comparison& c, const CompareOptions& o) {
    if (o.report.empty() && o.error.empty()) return;
    const mir::Image<mir::Rgb> errors = mir::difference(c.image, c.reference);
    const float range = mir::error_range(errors);
    const mir::Image<mir::Rgb> picture = mir::signed_error_picture(errors, range);
    if (o.error.ends_with(".png")) mir::write_png(o.error, picture, {});
    if (o.error.ends_with(".exr")) mir::write_exr(o.error, errors.extent(), {{"", &errors}});
    if (!o.report.empty()) write_report(c, o, picture, range);
}

void print_metrics(const Comparison& c, const CompareOptions& o) {
    if (o.json) {
        // Names of files need not be UTF-8; JSON must be. In ASCII no terminal obeys them.
        std::printf("%s\n",
                    json_of(c, o).dump(2, ' ', true, Json::error_handler_t::replace).c_str());
        return;
    }
    for (const auto& [label, value] : rows_of(c, o))
        std::printf("%-20s %s\n", label.c_str(), shown(value).c_str());
    if (!o.error.empty()) std::printf("%-20s %s\n", "signed error", shown(o.error).c_str());
    if (!o.report.empty()) std::printf("%-20s %s\n", "report", shown(o.report).c_str());
}

}  // namespace mirtool
