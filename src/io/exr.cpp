// SPDX-License-Identifier: MIT
#include "mir/io/exr.hpp"

#include "io/detail/exr_attributes.hpp"
#include "io/detail/exr_check.hpp"
#include "mir/core/error.hpp"
#include "mir/io/atomic_file.hpp"
#include "mir/io/detail/shown_path.hpp"

#include <OpenEXR/Iex.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFloatAttribute.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStdIO.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <OpenEXR/ImfVecAttribute.h>
#include <OpenEXR/ImfVersion.h>
#include <half.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <exception>
#include <fstream>
#include <new>
#include <set>
#include <system_error>
#include <variant>

namespace mir {

namespace detail {
namespace {

/// @throws Error(invalid_argument) for a name that OpenEXR reserves or that comes twice.
void insert_attribute(Imf::Header& header, const ExrAttribute& attribute) {
    constexpr std::array reserved{"type",  "name", "version",           "chunkCount",
                                  "tiles", "view", "maxSamplesPerPixel"};
    const std::string& name = attribute.name;
    const bool taken = header.find(name.c_str()) != header.end() ||
                       std::find(reserved.begin(), reserved.end(), name) != reserved.end();
    if (taken || name.empty() || name.size() > 255)
        throw Error(ErrorCode::invalid_argument,
                    "attribute " + in_quotes(name) +
                        " cannot be stored (the name is reserved, given twice, empty or longer "
                        "than 255 bytes); prefix your own attributes with \"mir:\"");
    if (const auto* text = std::get_if<std::string>(&attribute.value))
        header.insert(name, Imf::StringAttribute(*text));
    else if (const auto* real = std::get_if<float>(&attribute.value))
        header.insert(name, Imf::FloatAttribute(*real));
    else if (const auto* v = std::get_if<DVec3>(&attribute.value))
        header.insert(name, Imf::V3dAttribute(Imath::V3d(v->x, v->y, v->z)));
    else
        header.insert(name, Imf::IntAttribute(std::get<int>(attribute.value)));
}

/// Header without date or host, so that equal input gives equal bytes.
Imf::Header exr_header(Extent extent, const std::vector<ExrChannel>& channels,
                       const ExrAttributes& attributes) {
    Imf::Header header(static_cast<int>(extent.width), static_cast<int>(extent.height));
    header.compression() = Imf::ZIP_COMPRESSION;
    Imf::addChromaticities(header, Imf::Chromaticities());  // the default is Rec. 709
    for (const ExrAttribute& attribute : attributes) insert_attribute(header, attribute);
    if (header.find("software") == header.end()) insert_attribute(header, {"software", "mir"});
    if (header.find("whiteLuminance") == header.end())
        Imf::addWhiteLuminance(header, white_efficacy);
    for (const ExrChannel& channel : channels)
        header.channels().insert(
            channel.name,
            Imf::Channel(channel.precision == ExrPrecision::half ? Imf::HALF : Imf::FLOAT));
    return header;
}

std::vector<half> to_half(const ExrChannel& channel) {
    std::vector<half> values(channel.count);
    for (std::size_t i = 0; i < channel.count; ++i)
        values[i] = half(channel.first[i * channel.stride]);
    return values;
}

void write_channels(Imf::OStream& stream, const Imf::Header& header,
                    const std::vector<ExrChannel>& channels) {
    const Imath::Box2i& window = header.dataWindow();
    const auto width = static_cast<std::size_t>(window.max.x) + 1;
    std::vector<std::vector<half>> halves;
    Imf::FrameBuffer buffer;
    for (const ExrChannel& channel : channels) {
        if (channel.precision == ExrPrecision::half) {
            halves.push_back(to_half(channel));
            buffer.insert(channel.name, Imf::Slice::Make(Imf::HALF, halves.back().data(), window));
            continue;
        }
        const std::size_t stride = channel.stride * sizeof(float);
        buffer.insert(channel.name,
                      Imf::Slice::Make(Imf::FLOAT, channel.first, window, stride, stride * width));
    }
    Imf::OutputFile file(stream, header);
    file.setFrameBuffer(buffer);
    file.writePixels(static_cast<int>(window.max.y) + 1);
}

[[noreturn]] void cannot_write(const std::filesystem::path& path, const std::string& reason) {
    throw Error(ErrorCode::io, shown_path(path) + ": the image cannot be written (" + reason +
                                   "); free space there or choose another folder");
}

/// Reads the header alone, because Imf::InputFile takes memory for whatever size a file declares.
Imf::Header checked_header(std::ifstream& stream, const std::filesystem::path& path,
                           std::uint64_t file_bytes, const Limits& limits) {
    std::array<unsigned char, 8> start{};
    stream.read(reinterpret_cast<char*>(start.data()), start.size());
    const std::array<unsigned char, 4> magic{0x76, 0x2f, 0x31, 0x01};
    if (!stream || !std::equal(magic.begin(), magic.end(), start.begin()))
        cannot_read(path, "it is no OpenEXR file", "convert it to OpenEXR");
    int version = start[4] | start[5] << 8 | start[6] << 16;
    if ((version & (Imf::MULTI_PART_FILE_FLAG | Imf::NON_IMAGE_FLAG)) != 0)
        throw Error(ErrorCode::unsupported,
                    shown_path(path) +
                        ": the image cannot be read (it has several parts or deep "
                        "pixels); store it as one flat part");
    ExrAttributeWalk(stream, path, file_bytes).check();
    Imf::StdIFStream exr_stream(stream, path.string().c_str());
    Imf::Header header;
    header.readFrom(exr_stream, version);
    const bool tiled = (version & Imf::TILED_FLAG) != 0;
    header.sanityCheck(tiled);
    const Imath::Box2i& window = header.dataWindow();
    const auto width = static_cast<std::uint64_t>(std::int64_t{window.max.x} - window.min.x + 1);
    const auto height = static_cast<std::uint64_t>(std::int64_t{window.max.y} - window.min.y + 1);
    check_limit(saturating_mul(width, height), limits.pixels, "pixels");
    check_exr_sizes(header, tiled, width, height, path, file_bytes);
    return header;
}

/// The three channels of a layer; a scalar comes three times.
std::array<std::string, 3> find_channels(const Imf::Header& header, const std::string& layer,
                                         const std::filesystem::path& path) {
    const std::string prefix = layer.empty() ? "" : layer + ".";
    for (const char* letters : {"RGB", "XYZ", "YYY", "ZZZ"}) {
        std::array<std::string, 3> names{prefix + letters[0], prefix + letters[1],
                                         prefix + letters[2]};
        const auto found = [&](const std::string& name) {
            return header.channels().findChannel(name) != nullptr;
        };
        if (std::all_of(names.begin(), names.end(), found)) return names;
    }
    std::string present;
    for (auto c = header.channels().begin(); c != header.channels().end(); ++c)
        present += (present.empty() ? "" : ", ") + std::string(c.name());
    cannot_read(path, "layer " + in_quotes(layer) + " is not in it",
                "name a layer of these channels: " + present);
}

std::vector<std::string> layers_of(const Imf::Header& header) {
    std::set<std::string> names;
    for (auto c = header.channels().begin(); c != header.channels().end(); ++c) {
        const std::string channel = c.name();
        const std::size_t dot = channel.rfind('.');
        names.insert(dot == std::string::npos ? "" : channel.substr(0, dot));
    }
    return {names.begin(), names.end()};
}

Image<Rgb> read_channels(std::ifstream& stream, const std::filesystem::path& path,
                         const Imf::Header& header, const std::string& layer) {
    const std::array<std::string, 3> names = find_channels(header, layer, path);
    const Imath::Box2i& window = header.dataWindow();
    const Extent extent{static_cast<std::uint32_t>(window.max.x - window.min.x + 1),
                        static_cast<std::uint32_t>(window.max.y - window.min.y + 1)};
    Image<Rgb> image(extent);
    Rgb& front = image.pixels().front();
    const std::array<float*, 3> first{&front.r, &front.g, &front.b};
    const bool scalar = names[0] == names[1];
    Imf::FrameBuffer buffer;
    for (std::size_t i = 0; i < (scalar ? 1u : 3u); ++i)
        buffer.insert(names[i], Imf::Slice::Make(Imf::FLOAT, first[i], window, sizeof(Rgb),
                                                 sizeof(Rgb) * extent.width));
    stream.seekg(0);
    Imf::StdIFStream exr_stream(stream, path.string().c_str());
    Imf::InputFile file(exr_stream);
    file.setFrameBuffer(buffer);
    file.readPixels(window.min.y, window.max.y);
    if (scalar)
        for (Rgb& pixel : image.pixels()) pixel = {pixel.r, pixel.r, pixel.r};
    return image;
}

}  // namespace
}  // namespace detail

void write_exr(const std::filesystem::path& path, Extent extent,
               const std::vector<ExrLayer>& layers, const ExrAttributes& attributes) {
    const std::vector<detail::ExrChannel> channels = detail::checked_channels(extent, layers);
    AtomicFile target(path);
    try {
        const Imf::Header header = detail::exr_header(extent, channels, attributes);
        errno = 0;
        std::ofstream stream(target.temporary(), std::ios::binary | std::ios::trunc);
        Imf::StdOFStream exr_stream(stream, target.temporary().string().c_str());
        detail::write_channels(exr_stream, header, channels);
        // OutputFile's destructor hides failures to write its last bytes.
        stream.close();
        if (!stream) detail::cannot_write(path, std::strerror(errno != 0 ? errno : EIO));
    } catch (const Iex::BaseExc& failure) {
        detail::cannot_write(path, failure.what());
    }
    target.commit();
}

ExrImage read_exr(const std::filesystem::path& path, const std::string& layer,
                  const Limits& limits) {
    std::error_code failure;
    const std::uintmax_t bytes = std::filesystem::file_size(path, failure);
    if (failure) detail::cannot_read(path, failure.message(), "check the name");
    check_limit(bytes, limits.file_bytes, "file_bytes");
    std::ifstream stream(path, std::ios::binary);
    if (!stream) detail::cannot_read(path, "it cannot be opened", "check its permissions");
    try {
        const Imf::Header header = detail::checked_header(stream, path, bytes, limits);
        ExrImage result;
        result.image = detail::read_channels(stream, path, header, layer);
        result.layers = detail::layers_of(header);
        for (auto a = header.begin(); a != header.end(); ++a)
            if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&a.attribute()))
                result.attributes.emplace_back(a.name(), text->value());
            else if (const auto* v = dynamic_cast<const Imf::V3dAttribute*>(&a.attribute()))
                result.vectors.emplace_back(a.name(),
                                            DVec3(v->value().x, v->value().y, v->value().z));
        return result;
    } catch (const Error&) {
        throw;
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& broken) {
        detail::cannot_read(path, broken.what(), "write it again");
    }
}

}  // namespace mir
