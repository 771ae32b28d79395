// SPDX-License-Identifier: MIT
#pragma once

#include "mir/io/exr.hpp"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFloatAttribute.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfVecAttribute.h>

#include <filesystem>
#include <set>
#include <string>

namespace mirtest {

/// Names of all layers of an EXR file; "" for its picture.
inline std::set<std::string> layers_of(const std::filesystem::path& path) {
    const Imf::InputFile file(path.c_str());
    std::set<std::string> layers;
    const Imf::ChannelList& channels = file.header().channels();
    for (auto c = channels.begin(); c != channels.end(); ++c) {
        const std::string name = c.name();
        const std::size_t dot = name.rfind('.');
        layers.insert(dot == std::string::npos ? "" : name.substr(0, dot));
    }
    return layers;
}

/// Value of an attribute of type text, int or float, as text; "none" when there is none.
inline std::string attribute_of(const std::filesystem::path& path, const std::string& name) {
    const Imf::InputFile file(path.c_str());
    const Imf::Header& header = file.header();
    if (const auto* text = header.findTypedAttribute<Imf::StringAttribute>(name))
        return text->value();
    if (const auto* whole = header.findTypedAttribute<Imf::IntAttribute>(name))
        return std::to_string(whole->value());
    if (const auto* real = header.findTypedAttribute<Imf::FloatAttribute>(name))
        return std::to_string(real->value());
    return "none";
}

/// Largest difference of two pictures of one size, in any channel.
inline float largest_difference(const mir::Image<mir::Rgb>& a, const mir::Image<mir::Rgb>& b) {
    float largest = a.extent() == b.extent() ? 0.0f : std::numeric_limits<float>::infinity();
    for (std::size_t i = 0; i < std::min(a.pixels().size(), b.pixels().size()); ++i) {
        const mir::Rgb p = a.pixels()[i];
        const mir::Rgb q = b.pixels()[i];
        for (const float d : {p.r - q.r, p.g - q.g, p.b - q.b})
            largest = std::max(largest, std::fabs(d));
    }
    return largest;
}

/// Sum of the named layers.
inline mir::Image<mir::Rgb> sum_of_layers(const std::filesystem::path& path,
                                          const std::set<std::string>& layers) {
    mir::Image<mir::Rgb> sum(mir::read_exr(path).image.extent());
    for (const std::string& layer : layers) {
        const mir::Image<mir::Rgb> image = mir::read_exr(path, layer).image;
        for (std::size_t i = 0; i < sum.pixels().size(); ++i) sum.pixels()[i] += image.pixels()[i];
    }
    return sum;
}

}  // namespace mirtest
