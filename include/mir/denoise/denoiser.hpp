// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/monitor.hpp"
#include "mir/data/image.hpp"
#include "mir/runtime/result.hpp"

#include <filesystem>
#include <memory>
#include <string>

namespace mir {

/// What a Denoiser is told of the surfaces behind pixels. The pictures are not owned.
struct DenoiseGuides {
    const Image<Rgb>* albedo = nullptr;   ///< reflectance, 0..1; null: not known
    const Image<Vec3>* normal = nullptr;  ///< shading normals; without an albedo they are not used
};

/// Open Image Denoise, loaded at run time by its C API. It runs on the processor, never changes
/// where threads run, and stays loaded until the program ends. Its pictures are outside of the
/// promise of equal bytes: they depend on its version and on the processor. One thread at a time.
class Denoiser {
 public:
    /// Loads `library`; where that is empty, what the environment variable MIR_OIDN_LIBRARY names;
    /// where that is not set, the system's. `threads`: 0 for all.
    /// @throws Error(no_device) when there is none that can be used; Error(device) when it fails.
    explicit Denoiser(const std::filesystem::path& library = {}, unsigned threads = 0);
    Denoiser(const Denoiser&) = delete;
    Denoiser& operator=(const Denoiser&) = delete;
    ~Denoiser();

    /// Name and version: "Open Image Denoise 2.5.1".
    [[nodiscard]] const std::string& name() const;

    /// A picture of linear radiance without its noise. `monitor` may be null; it can cancel.
    /// @throws Error(invalid_argument) for an empty picture and for guides of another size,
    ///         Error(device) when the library fails, Error(cancelled).
    [[nodiscard]] Image<Rgb> denoise(const Image<Rgb>& picture, const DenoiseGuides& guides = {},
                                     Monitor* monitor = nullptr) const;

 private:
    struct Parts;

    std::unique_ptr<Parts> parts_;
};

/// The beauty of a result without its noise. Direct and indirect light are denoised each by itself,
/// with the guides of the result; emission is added as it is. Render with the filter `box`: others
/// spread noise over neighbours, so that it looks like detail.
/// @throws Error as Denoiser::denoise().
[[nodiscard]] Image<Rgb> denoise(const RenderResult& result, const Denoiser& denoiser,
                                 Monitor* monitor = nullptr);

}  // namespace mir
