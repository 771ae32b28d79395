// SPDX-License-Identifier: MIT
#include "report.hpp"

#include "mir/core/error.hpp"
#include "mir/version.hpp"

#include <cstdio>
#include <filesystem>
#include <fstream>

namespace mirpaper {
namespace {

std::string digits_of(double x) {
    char digits[32];
    std::snprintf(digits, sizeof digits, "%.9g", x);
    return digits;
}

/// Names and values of one line, for both formats.
class Fields {
 public:
    void add(const std::string& name, const std::string& text) {
        fields_.push_back({name, text, true});
    }
    void add(const std::string& name, double x, bool known = true) {
        fields_.push_back({name, known ? digits_of(x) : "", false});
    }

    [[nodiscard]] std::string json() const {
        std::string line;
        for (const Field& f : fields_) {
            if (f.value.empty()) continue;
            line += (line.empty() ? "{\"" : ", \"") + f.name + "\": ";
            line += f.is_text ? quoted(f.value) : f.value;
        }
        return line + "}";
    }
    [[nodiscard]] std::string csv_header() const {
        std::string line;
        for (const Field& f : fields_) line += (line.empty() ? "" : ",") + f.name;
        return line + "\n";
    }
    [[nodiscard]] std::string csv() const {
        std::string line;
        for (const Field& f : fields_)
            line += (&f == &fields_.front() ? "" : ",") + (f.is_text ? quoted(f.value) : f.value);
        return line + "\n";
    }

    static std::string quoted(const std::string& text) {
        std::string out = "\"";
        for (const char c : text) {
            if (c == '"' || c == '\\') out += '\\';
            out += c;
        }
        return out + "\"";
    }

 private:
    struct Field {
        std::string name;
        std::string value;
        bool is_text;
    };

    std::vector<Field> fields_;
};

void add_times(Fields& f, const Row& row) {
    const bool timed = row.seconds.count > 0;
    f.add("seconds", row.seconds.median, timed);
    f.add("seconds_min", row.seconds.min, timed);
    f.add("seconds_max", row.seconds.max, timed);
    f.add("repeat", row.seconds.count, timed);
    f.add("wall_seconds", row.wall.median, row.wall.count > 0);
    f.add("contributions_per_second", row.rate(), timed);
    f.add("kernel_visibility_seconds", row.visibility_seconds, row.visibility_seconds > 0.0);
    f.add("kernel_shading_seconds", row.shading_seconds, row.shading_seconds > 0.0);
    f.add("mean_luminance", row.mean_luminance, timed);
    f.add("paper_seconds", row.paper_seconds, row.paper_seconds > 0.0);
    f.add("paper_contributions_per_second", row.paper_contributions, row.paper_contributions > 0.0);
}

void add_stages(Fields& f, const std::optional<StageSeconds>& measured) {
    const bool known = measured.has_value();
    const StageSeconds s = measured.value_or(StageSeconds{});
    for (std::size_t i = 0; i < work_names.size(); ++i)
        f.add(std::string(work_names[i]) + "_seconds", s.of[i], known);
    f.add("busy_seconds", s.busy, known);
    f.add("span_seconds", s.span, known);
    f.add("overlap", s.overlap(), known);
    f.add("hidden_transfer", s.hidden_transfer(), known);
}

void add_counters(Fields& f, const std::optional<RayCounters>& counted) {
    const bool known = counted.has_value();
    const RayCounters c = counted.value_or(RayCounters{});
    f.add("facing", c.facing, known);
    f.add("visible", c.visible, known);
    f.add("nodes_per_ray", c.nodes, known);
    f.add("leaves_per_ray", c.leaves, known);
    f.add("triangles_per_ray", c.triangles, known);
    f.add("lanes_busy", c.lanes_busy, known);
    f.add("rays", static_cast<double>(c.rays), known);
}

Fields fields_of(const Row& row) {
    Fields f;
    f.add("figure", row.figure);
    f.add("scene", row.scene);
    f.add("backend", row.backend);
    f.add("algorithm", row.algorithm);
    f.add("variant", row.variant);
    f.add("clock", row.clock);
    f.add("width", row.image.width);
    f.add("height", row.image.height);
    f.add("tile_width", row.tile.width);
    f.add("tile_height", row.tile.height);
    f.add("vpls", row.vpls);
    add_times(f, row);
    add_stages(f, row.stages);
    add_counters(f, row.counters);
    return f;
}

Fields fields_of(const SceneNote& scene) {
    Fields f;
    f.add("name", scene.name);
    f.add("hash", scene.hash);
    f.add("triangles", static_cast<double>(scene.triangles));
    f.add("tree_seconds", scene.tree_seconds);
    f.add("tree_sah_cost", scene.tree_sah_cost);
    f.add("tree_bytes", static_cast<double>(scene.tree_bytes));
    f.add("traversal_cost", scene.tree.traversal_cost);
    f.add("empty_bonus", scene.tree.empty_bonus);
    f.add("splits", scene.splits);
    return f;
}

template <class T>
std::string json_list(const std::vector<T>& items) {
    std::string list;
    for (const T& item : items) list += (list.empty() ? "  " : ",\n  ") + fields_of(item).json();
    return "[\n" + list + "\n ]";
}

void write(const std::filesystem::path& file, const std::string& text) {
    std::ofstream stream(file, std::ios::binary);
    stream << text;
    stream.close();
    if (!stream)
        throw mir::Error(mir::ErrorCode::io, file.string() +
                                                 " could not be written (no right to, or the disk "
                                                 "is full); give another folder with --out");
}

}  // namespace

std::string json_of(const Results& results) {
    std::string devices;
    for (const std::string& d : results.devices)
        devices += (devices.empty() ? "" : ", ") + Fields::quoted(d);
    return "{\"mir\": " + Fields::quoted(mir::version) + ",\n \"devices\": [" + devices +
           "],\n \"scenes\": " + json_list(results.scenes) +
           ",\n \"rows\": " + json_list(results.rows) + "}\n";
}

std::string csv_of(const Results& results) {
    std::string csv = fields_of(Row{}).csv_header();
    for (const Row& row : results.rows) csv += fields_of(row).csv();
    return csv;
}

void write_reports(const Results& results, const std::string& folder) {
    std::error_code ignored;  // write() says what does not work
    std::filesystem::create_directories(folder, ignored);
    const std::filesystem::path path(folder);
    write(path / "paper.json", json_of(results));
    write(path / "paper.csv", csv_of(results));
    write(path / "paper.md", markdown_of(results));
}

}  // namespace mirpaper
