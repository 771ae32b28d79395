// SPDX-License-Identifier: MIT
#pragma once

#include "mir/core/error.hpp"
#include "mir/core/rgb.hpp"
#include "mir/data/image.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace mir {

/// How the numbers of a layer are stored. `half` keeps 11 bits and ends at 65504: good for albedo
/// and normals, too small for radiance, positions and depths.
enum class ExrPrecision { half, single };

/// Channel letter of a layer with one number per pixel.
enum class ExrScalar {
    depth,      ///< Z
    luminance,  ///< Y, also for counts and errors
    alpha       ///< A, 0..1; colours of its layer are multiplied with it
};

/// One image of an OpenEXR file. The type of the image names the channels: Rgb gives R G B, Vec3
/// gives X Y Z, float gives Z, Y or A. `image` is not owned and must outlive the call that writes
/// it.
struct ExrLayer {
    std::string name;  ///< "albedo" gives albedo.R and so on; empty for the beauty
    /// Not null; every layer of a file has the same size.
    std::variant<const Image<Rgb>*, const Image<Vec3>*, const Image<float>*> image;
    ExrPrecision precision = ExrPrecision::single;  ///< NaN and infinities are refused in either
    ExrScalar scalar = ExrScalar::depth;            ///< only for float
};

/// A named value in the header of an OpenEXR file. The project's own names start with "mir:".
struct ExrAttribute {
    std::string name;  ///< 1 to 255 bytes, given once, none that OpenEXR reserves
    /// Stored as attribute of type string, float, int or v3d.
    std::variant<std::string, float, int, DVec3> value;
};
using ExrAttributes = std::vector<ExrAttribute>;  ///< of one file

namespace detail {

/// One number per pixel of a layer: `count` of them, `stride` floats apart.
struct ExrChannel {
    std::string name;
    const float* first = nullptr;
    std::size_t stride = 1;
    std::size_t count = 0;
    ExrPrecision precision = ExrPrecision::single;
};

template <class T>
const Image<T>& checked_image(const Image<T>* image, Extent extent, const std::string& layer) {
    if (image != nullptr && image->extent() == extent) return *image;
    throw Error(ErrorCode::invalid_argument,
                "layer '" + layer + "' cannot be stored (it has no image of " +
                    std::to_string(extent.width) + "x" + std::to_string(extent.height) +
                    " pixels); give every layer of a file the same size");
}

inline const char* letter_of(ExrScalar scalar) {
    if (scalar == ExrScalar::alpha) return "A";
    return scalar == ExrScalar::depth ? "Z" : "Y";
}

/// Adds the channels of `layer` to `channels`.
/// @throws Error(invalid_argument) when its image is missing or has another size.
inline void append_channels(std::vector<ExrChannel>& channels, const ExrLayer& layer,
                            Extent extent) {
    const std::string prefix = layer.name.empty() ? "" : layer.name + ".";
    const auto add = [&](const char* letter, const float* first, std::size_t stride) {
        channels.push_back({prefix + letter, first, stride, static_cast<std::size_t>(extent.area()),
                            layer.precision});
    };
    if (const auto* rgb = std::get_if<const Image<Rgb>*>(&layer.image)) {
        const Rgb& front = checked_image(*rgb, extent, layer.name).pixels().front();
        add("R", &front.r, 3);
        add("G", &front.g, 3);
        add("B", &front.b, 3);
    } else if (const auto* xyz = std::get_if<const Image<Vec3>*>(&layer.image)) {
        const Vec3& front = checked_image(*xyz, extent, layer.name).pixels().front();
        add("X", &front.x, 3);
        add("Y", &front.y, 3);
        add("Z", &front.z, 3);
    } else {
        const auto* scalar = std::get<const Image<float>*>(layer.image);
        const float& front = checked_image(scalar, extent, layer.name).pixels().front();
        add(letter_of(layer.scalar), &front, 1);
    }
}

/// Refuses numbers that the file could not give back.
/// @throws Error(internal) for NaN and infinities, Error(invalid_argument) for what half cannot
///         hold; both name the channel and how many there are.
inline void check_values(const ExrChannel& channel) {
    constexpr float largest_half = 65504.0f;
    std::size_t not_finite = 0;
    std::size_t too_large = 0;
    for (std::size_t i = 0; i < channel.count; ++i) {
        const float value = channel.first[i * channel.stride];
        if (!std::isfinite(value)) ++not_finite;
        if (std::fabs(value) > largest_half) ++too_large;
    }
    const std::string of =
        " of the " + std::to_string(channel.count) + " values of channel " + channel.name;
    if (not_finite > 0)
        throw Error(ErrorCode::internal,
                    std::to_string(not_finite) + of +
                        " are NaN or infinite (an earlier stage failed, no file was written); "
                        "please report it with the scene and the seed");
    if (too_large > 0 && channel.precision == ExrPrecision::half)
        throw Error(ErrorCode::invalid_argument,
                    std::to_string(too_large) + of +
                        " do not fit into 16 bits (half ends at 65504); store the layer with "
                        "ExrPrecision::single");
}

/// All channels of a file, checked.
/// @throws Error as append_channels() and check_values(); Error(invalid_argument) also for an empty
///         image, no layers and two layers of one name.
inline std::vector<ExrChannel> checked_channels(Extent extent,
                                                const std::vector<ExrLayer>& layers) {
    constexpr std::uint32_t most = 0x7fffffff;
    expects(extent.area() > 0 && extent.width <= most && extent.height <= most && !layers.empty(),
            "an OpenEXR file without pixels was asked for (it needs a width, a height and a "
            "layer); render an image first");
    std::vector<ExrChannel> channels;
    for (const ExrLayer& layer : layers) append_channels(channels, layer, extent);
    std::vector<std::string> names;
    for (const ExrChannel& channel : channels) {
        check_values(channel);
        names.push_back(channel.name);
    }
    std::sort(names.begin(), names.end());
    const auto twin = std::adjacent_find(names.begin(), names.end());
    if (twin != names.end())
        throw Error(ErrorCode::invalid_argument,
                    "channel " + *twin +
                        " would be stored twice (two layers have the same name); rename one");
    return channels;
}

}  // namespace detail

}  // namespace mir
