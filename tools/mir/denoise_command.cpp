// SPDX-License-Identifier: MIT
#include "commands.hpp"
#include "denoising.hpp"
#include "exit_code.hpp"
#include "mir/compare/comparable.hpp"
#include "mir/core/stopwatch.hpp"
#include "mir/io/exr.hpp"
#include "mir/version.hpp"
#include "output_places.hpp"
#include "print_result.hpp"
#include "progress.hpp"
#include "read_picture.hpp"
#include "text.hpp"

#include <algorithm>
#include <cstdio>
#include <utility>
#include <vector>

namespace mirtool {
namespace {

using Json = nlohmann::ordered_json;

/// A picture from a file, with what of its layers helps.
struct NoisyPicture {
    mir::Image<mir::Rgb> whole;
    mir::RenderResult parts;  ///< guides; direct, indirect and emission where all three are there
    bool has_albedo = false;
    bool has_normal = false;
    bool has_parts = false;
    mir::ExrAttributes attributes;
};

bool has(const std::vector<std::string>& layers, const char* name) {
    return std::binary_search(layers.begin(), layers.end(), std::string(name));
}

/// A layer whose every value is a number.
mir::Image<mir::Rgb> read_layer(const DenoiseOptions& o, const char* layer) {
    mir::Image<mir::Rgb> image = read_picture(o.image, layer).image;
    mir::check_comparable(image, image, o.image, o.image);
    return image;
}

mir::Image<mir::Vec3> as_vectors(const mir::Image<mir::Rgb>& image) {
    mir::Image<mir::Vec3> out(image.extent());
    for (std::size_t i = 0; i < out.pixels().size(); ++i) {
        const mir::Rgb& from = image.pixels()[i];
        out.pixels()[i] = {from.r, from.g, from.b};
    }
    return out;
}

/// What the file says of how it came about.
mir::ExrAttributes kept_attributes(const mir::ExrImage& file) {
    mir::ExrAttributes kept;
    for (const auto& [name, value] : file.attributes)
        if (name.starts_with("mir:") && name != "mir:denoiser") kept.push_back({name, value});
    for (const auto& [name, value] : file.vectors)
        if (name.starts_with("mir:")) kept.push_back({name, value});
    return kept;
}

NoisyPicture read_noisy(const DenoiseOptions& o) {
    NoisyPicture noisy{
        {}, {{}, {}, {}, {}, {}, mir::Guides({0, 0}), {}, {}, {}}, false, false, false, {}};
    noisy.whole = read_layer(o, "");
    const mir::ExrImage file = mir::read_exr(o.image);
    noisy.attributes = kept_attributes(file);
    noisy.has_albedo = has(file.layers, "albedo");
    noisy.has_normal = noisy.has_albedo && has(file.layers, "normal");
    noisy.has_parts =
        has(file.layers, "direct") && has(file.layers, "indirect") && has(file.layers, "emission");
    if (noisy.has_albedo) noisy.parts.guides.albedo = read_layer(o, "albedo");
    if (noisy.has_normal) noisy.parts.guides.normal = as_vectors(read_layer(o, "normal"));
    if (!noisy.has_parts) return noisy;
    noisy.parts.direct = read_layer(o, "direct");
    noisy.parts.indirect = read_layer(o, "indirect");
    noisy.parts.emission = read_layer(o, "emission");
    return noisy;
}

mir::Image<mir::Rgb> cleaned(const NoisyPicture& noisy, const mir::Denoiser& denoiser,
                             mir::Monitor& monitor) {
    if (noisy.has_parts) return mir::denoise(noisy.parts, denoiser, &monitor);
    const mir::Guides& g = noisy.parts.guides;
    return denoiser.denoise(
        noisy.whole,
        {noisy.has_albedo ? &g.albedo : nullptr, noisy.has_normal ? &g.normal : nullptr}, &monitor);
}

mir::Image<mir::Rgb> read_reference(const DenoiseOptions& o, const NoisyPicture& noisy) {
    if (o.reference.empty()) return {};
    mir::Image<mir::Rgb> reference = read_picture(o.reference, "").image;
    mir::check_comparable(noisy.whole, reference, o.image, o.reference);
    return reference;
}

std::string filter_of(const mir::ExrAttributes& attributes) {
    for (const mir::ExrAttribute& a : attributes)
        if (const auto* text = std::get_if<std::string>(&a.value); text && a.name == "mir:filter")
            return *text;
    return "";
}

void say_what_lacks(const DenoiseOptions& o, const NoisyPicture& noisy) {
    if (o.quiet) return;
    const std::string remark = filter_remark(filter_of(noisy.attributes));
    if (!remark.empty())
        std::fprintf(stderr, "mir: %s: %s\n", shown(o.image).c_str(), remark.c_str());
    if (noisy.has_normal) return;
    std::fprintf(stderr,
                 "mir: %s: it has no layer %s, so edges and textures may be blurred; mir render "
                 "stores albedo and normal\n",
                 shown(o.image).c_str(), noisy.has_albedo ? "normal" : "albedo");
}

void print_json(const DenoiseOptions& o, const NoisyPicture& noisy, const Denoising& done) {
    Json guides = Json::array();
    if (noisy.has_albedo) guides.push_back("albedo");
    if (noisy.has_normal) guides.push_back("normal");
    Json out{{"version", mir::version}, {"image", o.image}, {"picture", o.output}};
    out["guides"] = guides;
    out["parts"] = noisy.has_parts ? Json{"direct", "indirect"} : Json::array();
    out["denoised"] = json_of(done);
    std::printf("%s\n", out.dump(2, ' ', true, Json::error_handler_t::replace).c_str());
}

}  // namespace

int run(const DenoiseOptions& o) {
    check_output_places({o.image, o.reference}, {o.output}, "denoising");
    const mir::Denoiser denoiser(o.denoiser, o.threads);
    NoisyPicture noisy = read_noisy(o);
    const mir::Image<mir::Rgb> reference = read_reference(o, noisy);
    say_what_lacks(o, noisy);
    // Also while the file is written, since a signal that ended the program there would leave half.
    mir::Monitor monitor;
    const CancelOnInterrupt cancel(monitor);
    Denoising done;
    done.denoiser = denoiser.name();
    mir::Image<mir::Rgb> clean;
    {
        const mir::Stopwatch watch(done.seconds);
        clean = cleaned(noisy, denoiser, monitor);
    }
    done.measure(noisy.whole, clean, reference, o.reference);
    noisy.attributes.push_back({"mir:denoiser", done.denoiser});
    mir::write_exr(o.output, clean.extent(), {{"", &clean}, {"noisy", &noisy.whole}},
                   noisy.attributes);
    if (!o.quiet) print(done);
    if (o.json)
        print_json(o, noisy, done);
    else
        print_result(o.output);
    return exit_done;
}

}  // namespace mirtool
