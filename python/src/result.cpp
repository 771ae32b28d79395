// SPDX-License-Identifier: MIT
#include "result.hpp"

#include "denoising.hpp"
#include "errors.hpp"
#include "mir/denoise/denoiser.hpp"
#include "mir/film/filter.hpp"
#include "mir/io/exr.hpp"
#include "mir/io/png.hpp"
#include "render_attributes.hpp"
#include "render_facts.hpp"
#include "views.hpp"
#include "vpls.hpp"
#include "watch.hpp"

#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>
#include <nlohmann/json.hpp>

#include <optional>
#include <utility>
#include <vector>

namespace nb = nanobind;

namespace mirpy {
namespace {

template <class T>
std::optional<NumpyArray<float>> or_none(mir::Image<T>& image, nb::handle owner) {
    if (image.pixels().empty()) return std::nullopt;
    return view_of(image, owner);
}

/// The picture as people see it.
mir::PreviewLook look_of(const mir::Image<mir::Rgb>& picture) {
    return {mir::tone_exposure(picture), mir::ToneCurve::agx, true};
}

nb::bytes png_of(const PyResult& self) {
    const auto bytes =
        mir::detail::encode_png(self.result.beauty, look_of(self.result.beauty), "picture.png");
    return nb::bytes(bytes.data(), bytes.size());
}

void save(const PyResult& self, const std::filesystem::path& path) {
    const mir::RenderResult& r = self.result;
    const nb::gil_scoped_release release;
    if (path.extension() == ".png") {
        mir::write_png(path, r.beauty, look_of(r.beauty));
    } else if (path.extension() == ".exr") {
        mir::write_exr(path, r.beauty.extent(), mirtool::layers_of(r, self.options),
                       mirtool::attributes_of(r, self.options));
    } else {
        throw ArgumentError("path", "its name ends neither in .exr nor in .png; choose one");
    }
}

using Json = nlohmann::ordered_json;

nb::dict to_python(const Json& facts) {
    return nb::cast<nb::dict>(nb::module_::import_("json").attr("loads")(facts.dump()));
}

Json all_facts(const PyResult& self) {
    Json facts;
    facts["scene_hash"] = self.result.statistics.scene_hash;
    mirtool::add_facts(facts, self.result, self.options.settings);
    return facts;
}

nb::dict facts_of(const PyResult& self) { return to_python(all_facts(self)); }

/// Where the light comes from, and what is missing of it.
nb::dict budget_of(const PyResult& self) {
    const Json facts = all_facts(self);
    Json budget;
    for (const char* name :
         {"emitted_power", "mean_radiance", "indirect_luminance", "removed_share",
          "removed_share_error", "cut_share", "cut_share_error", "direct_noise", "dropped_share",
          "residual_luminance", "gather_difference"})
        if (facts.contains(name)) budget[name] = facts[name];
    return to_python(budget);
}

/// Made once: arrays may look at it.
NumpyArray<float> denoised_of(nb::handle self, const std::optional<std::string>& library) {
    auto& r = nb::cast<PyResult&>(self).result;
    if (r.denoised.pixels().empty()) {
        const auto file = library
                              ? *library
                              : nb::cast<std::string>(
                                    nb::module_::import_("mir._denoiser").attr("find_library")());
        mir::Image<mir::Rgb> clean;
        mir::Monitor monitor;
        std::string name;
        watched(monitor, nb::none(), [&] {
            const mir::Denoiser denoiser(file);
            clean = mir::denoise(r, denoiser, &monitor);
            name = denoiser.name();
        });
        // Another thread may have been sooner, and arrays look at its picture.
        if (!r.denoised.pixels().empty()) return view_of(r.denoised, self);
        r.denoised = std::move(clean);
        r.denoiser = std::move(name);
        const auto kind = nb::cast<PyResult&>(self).options.settings.filter.kind;
        const std::string remark = mirtool::filter_remark(std::string(to_string(kind)));
        if (!remark.empty()) r.warnings.push_back(remark);
    }
    return view_of(r.denoised, self);
}

std::vector<NumpyArray<float>> bounces_of(nb::handle self) {
    std::vector<NumpyArray<float>> all;
    for (mir::Image<mir::Rgb>& image : nb::cast<PyResult&>(self).result.bounces)
        all.push_back(view_of(image, self));
    return all;
}

/// A property that is a view of an image of the result.
template <class Get>
void def_layer(nb::class_<PyResult>& type, const char* name, const Get& get, const char* text) {
    type.def_prop_ro(
        name,
        [get](nb::handle self) { return view_of(get(nb::cast<PyResult&>(self).result), self); },
        text);
}

void bind_layers(nb::class_<PyResult>& type) {
    using R = mir::RenderResult;
    def_layer(
        type, "beauty", [](R & r) -> auto& { return r.beauty; },
        "(h, w, 3): emission + direct + indirect, W m^-2 sr^-1, linear Rec. 709.");
    def_layer(
        type, "emission", [](R & r) -> auto& { return r.emission; },
        "(h, w, 3): of what the camera sees, environment included, W m^-2 sr^-1.");
    def_layer(
        type, "direct", [](R & r) -> auto& { return r.direct; },
        "(h, w, 3): light of one scattering event, W m^-2 sr^-1.");
    def_layer(
        type, "indirect", [](R & r) -> auto& { return r.indirect; },
        "(h, w, 3): the rest, of VPLs, discs or longer paths, W m^-2 sr^-1.");
    def_layer(
        type, "coverage", [](R & r) -> auto& { return r.coverage; },
        "(h, w): share of a pixel where a surface is seen, 0..1.");
    def_layer(
        type, "albedo", [](R & r) -> auto& { return r.guides.albedo; },
        "(h, w, 3): reflectance, 0..1.");
    def_layer(
        type, "normal", [](R & r) -> auto& { return r.guides.normal; },
        "(h, w, 3): shading normal, mean over the pixel.");
    def_layer(
        type, "position", [](R & r) -> auto& { return r.guides.position; },
        "(h, w, 3): place that the pixel's first luxel sees, metres; 0: background.");
    def_layer(
        type, "depth", [](R & r) -> auto& { return r.guides.depth; },
        "(h, w): distance from the lens plane, metres; 0: background.");
    type.def_prop_ro("bounces", bounces_of,
                     "List of (h, w, 3): light of 1, 2, ... scattering events; with "
                     "aov=\"bounces\" alone.");
    type.def_prop_ro(
        "removed",
        [](nb::handle self) { return or_none(nb::cast<PyResult&>(self).result.removed, self); },
        "(h, w, 3): what the bound removed, as the VPLs tell it; with aov=\"removed\" alone, else "
        "None.");
    type.def_prop_ro(
        "pick_error",
        [](nb::handle self) { return or_none(nb::cast<PyResult&>(self).result.pick_error, self); },
        "(h, w): standard error of the luminance of `indirect` from gathering few VPLs of many; "
        "with aov=\"pick_error\" alone, else None.");
}

std::string shown(const PyResult& self) {
    const mir::RenderResult& r = self.result;
    return "<mir.Result " + std::to_string(r.beauty.width()) + "x" +
           std::to_string(r.beauty.height()) + ", " + std::to_string(r.vpls.size()) + " VPLs, " +
           std::to_string(r.warnings.size()) + " warnings>";
}

}  // namespace

void bind_result(nb::module_& m) {
    nb::class_<PyResult> type(
        m, "Result", "A finished picture. Its layers are float32 arrays over its own memory.");
    bind_layers(type);
    type.def_prop_ro("statistics", facts_of,
                     "Dictionary of what `mir render --json` tells of a picture.")
        .def_prop_ro("light_budget", budget_of,
                     "Dictionary: where the light comes from, and what is missing of it.\n\n"
                     "removed_share: of indirect light, by the bound; cut_share: by the largest\n"
                     "number of reflections; 0..1, with standard errors where they were measured.\n"
                     "direct_noise: of a pixel, relative. dropped_share: of VPLs that no luxel\n"
                     "sees.")
        .def_prop_ro(
            "warnings", [](const PyResult& r) { return r.result.warnings; }, "Sentences.")
        .def_prop_ro(
            "vpls",
            [](const PyResult& r) {
                const float bound = r.result.statistics.bound;
                return vpls_of(r.result.vpls,
                               bound > 0.0f ? bound : std::numeric_limits<float>::max());
            },
            "Copy of the VPLs that lit the picture.")
        .def(
            "denoised", denoised_of, nb::arg("library").none() = nb::none(),
            "(h, w, 3): the beauty without noise, by Open Image Denoise; save() stores it, too.\n\n"
            "Render with filter=\"box\": others spread noise, so that it looks like detail.\n"
            "library: its file; None: that of an installed package such as pyoidn, else the "
            "system's.")
        .def("save", save, nb::arg("path"),
             "Writes the file that `mir render` writes (.exr), or its preview (.png).")
        .def("_repr_png_", png_of)
        .def("__repr__", shown);
}

}  // namespace mirpy
