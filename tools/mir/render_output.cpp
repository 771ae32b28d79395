// SPDX-License-Identifier: MIT
#include "render_output.hpp"

#include "load_scene.hpp"
#include "mir/io/exr.hpp"
#include "mir/io/vpl_glb.hpp"
#include "mir/io/vpl_ply.hpp"
#include "output_places.hpp"
#include "render_attributes.hpp"

#include <OpenEXR/ImfThreading.h>
#include <sys/resource.h>

#include <algorithm>
#include <filesystem>
#include <future>
#include <thread>

namespace mirtool {
namespace {

/// OpenEXR compresses blocks of lines beside each other, which changes no byte.
void compress_with(unsigned threads) {
    const unsigned cores = std::max(std::thread::hardware_concurrency(), 1u);
    Imf::setGlobalThreadCount(static_cast<int>(threads > 0 ? std::min(threads, cores) : cores));
}

}  // namespace

std::uint64_t peak_memory_bytes() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

std::string journal_of(const RenderOptions& o, const OutputPaths& paths) {
    return o.passes.resume ? paths.exr + ".journal" : std::string();
}

OutputPaths choose_outputs(const RenderOptions& o) {
    OutputPaths paths{o.output.empty() ? stem_of(o.scene) + ".exr" : o.output, o.preview};
    mir::expects(paths.exr != "-", "a picture cannot be written to standard output; name a file");
    if (paths.png.empty() && !o.no_preview)
        paths.png = std::filesystem::path(paths.exr).replace_extension(".png").string();
    if (o.no_preview) paths.png.clear();
    mir::expects(!are_one_file(paths.png, paths.exr),
                 "picture and preview have the same name (the picture is OpenEXR, a PNG beside it "
                 "its preview); let the picture end in .exr");
    mir::expects(!are_one_file(o.scene, paths.exr) && !are_one_file(o.scene, paths.png),
                 "the picture would replace the scene that it shows; give another name with -o");
    mir::expects(o.vpls_out.empty() || o.settings.integrator == mir::Integrator::vpl,
                 "this integrator places no VPLs (there would be none to write); leave --vpls-out "
                 "out or use --integrator vpl");
    check_output_places({o.scene, o.environment.file, o.report_reference, o.denoiser},
                        {paths.exr, paths.png, o.report, o.vpls_out, journal_of(o, paths)},
                        "render");
    return paths;
}

mir::PreviewLook preview_look(const RenderOptions& o, const mir::Image<mir::Rgb>& picture) {
    const auto automatic = [&] {
        return o.tone == mir::ToneCurve::none ? mir::auto_exposure(picture)
                                              : mir::tone_exposure(picture);
    };
    return {o.exposure ? *o.exposure : automatic(), o.tone, true};
}

void write_outputs(const OutputPaths& paths, const mir::RenderResult& r, const RenderOptions& o) {
    compress_with(o.settings.threads);
    const mir::Image<mir::Rgb>& seen = r.denoised.pixels().empty() ? r.beauty : r.denoised;
    // Each is made by few threads for most of its time. Without a thread it waits for get().
    std::future<void> preview;
    if (!paths.png.empty())
        preview = std::async([&] { mir::write_png(paths.png, seen, preview_look(o, seen)); });
    mir::write_exr(paths.exr, r.beauty.extent(), layers_of(r, o), attributes_of(r, o));
    if (preview.valid()) preview.get();
    if (o.vpls_out.ends_with(".glb")) mir::write_vpls_glb(o.vpls_out, r.vpls, r.statistics.origin);
    if (o.vpls_out.ends_with(".ply")) mir::write_vpls_ply(o.vpls_out, r.vpls, r.statistics.origin);
}

}  // namespace mirtool
