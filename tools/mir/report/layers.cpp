// SPDX-License-Identifier: MIT
#include "report/layers.hpp"

#include "mir/compare/error_picture.hpp"
#include "mir/io/html_text.hpp"
#include "mir/io/png.hpp"
#include "mir/io/radiance_code.hpp"

#include <algorithm>

namespace mirtool {
namespace {

/// Pixels across of the picture that is shown where no script runs.
constexpr std::uint32_t still_width = 640;

std::vector<ReportLayer> shown_layers(const ReportInput& in) {
    const mir::RenderResult& r = in.result;
    std::vector<ReportLayer> layers{{"direct", "Direct light", &r.direct, ""},
                                    {"emission", "Emission", &r.emission, ""}};
    // The bounces add up to the indirect light.
    if (r.bounces.empty()) layers.push_back({"indirect", "Indirect light", &r.indirect, ""});
    for (std::size_t i = 0; i < r.bounces.size(); ++i) {
        const std::string n = std::to_string(i + 1);
        layers.push_back({"bounce" + n, "Bounce " + n, &r.bounces[i], ""});
    }
    if (!r.denoised.pixels().empty()) layers.push_back({"denoised", "Denoised", &r.denoised, ""});
    if (in.reference.extent().area() > 0)
        layers.push_back({"reference", "Reference", &in.reference, ""});
    return layers;
}

std::string png_of(const mir::Image<mir::Rgb>& image, const mir::PreviewLook& look,
                   const ReportInput& in) {
    return mir::detail::base64(mir::detail::encode_png(image, look, in.options.report));
}

/// Codes all pictures at one size and returns how many bytes they take. Stops beyond `most`.
std::size_t encode_all(ReportPictures& out, const mir::Image<mir::Rgb>& error,
                       const ReportInput& in, std::size_t most) {
    std::size_t bytes = out.still.size();
    if (error.extent().area() > 0) out.error = png_of(shrunk(error, out.shrink), {}, in);
    bytes += out.error.size();
    for (ReportLayer& layer : out.layers) {
        layer.code = mir::detail::base64(mir::deflate_radiance(shrunk(*layer.image, out.shrink)));
        bytes += layer.code.size();
        if (bytes > most) break;
    }
    return bytes;
}

}  // namespace

mir::Image<mir::Rgb> shrunk(const mir::Image<mir::Rgb>& image, std::uint32_t factor) {
    if (factor == 1) return image;
    const auto side = [factor](std::uint32_t n) { return (n + factor - 1) / factor; };
    mir::Image<mir::Rgb> out({side(image.width()), side(image.height())});
    for (std::uint32_t y = 0; y < out.height(); ++y) {
        for (std::uint32_t x = 0; x < out.width(); ++x) {
            const std::uint32_t right = std::min(image.width(), (x + 1) * factor);
            const std::uint32_t bottom = std::min(image.height(), (y + 1) * factor);
            mir::Rgb sum;
            for (std::uint32_t v = y * factor; v < bottom; ++v)
                for (std::uint32_t u = x * factor; u < right; ++u) sum += image(u, v);
            out(x, y) =
                sum * (1.0f / static_cast<float>((right - x * factor) * (bottom - y * factor)));
        }
    }
    return out;
}

ReportPictures report_pictures(const ReportInput& in, const mir::PreviewLook& look,
                               std::size_t most_bytes) {
    const mir::Image<mir::Rgb>& beauty = in.result.beauty;
    ReportPictures out;
    out.layers = shown_layers(in);
    const std::uint32_t still = (beauty.width() + still_width - 1) / still_width;
    out.still = png_of(shrunk(beauty, still), look, in);
    mir::Image<mir::Rgb> error;
    if (in.reference.extent().area() > 0) {
        const mir::Image<mir::Rgb> errors = mir::difference(beauty, in.reference);
        out.error_range = mir::error_range(errors);
        error = mir::signed_error_picture(errors, out.error_range);
    }
    const std::uint32_t most_shrink = std::max(beauty.width(), beauty.height());
    while (encode_all(out, error, in, most_bytes) > most_bytes && out.shrink < most_shrink)
        ++out.shrink;
    return out;
}

}  // namespace mirtool
