// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/image/write_layered_exr.h>

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <ImfStdIO.h>
#include <ImfStringAttribute.h>

#include <half.h>
#include <algorithm>
#include <exception>
#include <new>
#include <span>

#include <tetralight/bake/image/read_image.h>
#include <tetralight/base/file.h>
#include <tetralight/base/str_cat.h>

namespace tetralight {
namespace {

float value_of(const ExrChannel& channel, size_t pixel) {
    const auto* bytes = reinterpret_cast<const std::byte*>(channel.first);
    return *reinterpret_cast<const float*>(bytes + pixel * channel.stride);
}

/// OpenEXR writes halves from halves. What is too large becomes the largest.
std::vector<std::vector<half>> halves_of(const LayeredImage& image) {
    std::vector<std::vector<half>> halves(image.channels.size());
    for (size_t c = 0; c < halves.size(); ++c) {
        halves[c].resize(size_t{image.width} * image.height);
        for (size_t i = 0; i < halves[c].size(); ++i) {
            halves[c][i] = half(std::clamp(value_of(image.channels[c], i), -65504.0f, 65504.0f));
        }
    }
    return halves;
}

/// OpenEXR takes char* for reading and writing alike; an output file only reads.
Imf::Slice slice_of(Imf::PixelType type, const void* first, size_t stride, uint32_t width) {
    return {type, static_cast<char*>(const_cast<void*>(first)), stride, stride * width};
}

std::string encode(const LayeredImage& image, ExrPrecision precision) {
    Imf::Header header(static_cast<int>(image.width), static_cast<int>(image.height));
    header.compression() = Imf::ZIP_COMPRESSION;
    for (const auto& [name, value] : image.attributes) {
        header.insert(name, Imf::StringAttribute(value));
    }
    const bool is_half = precision == ExrPrecision::Half;
    const auto halves = is_half ? halves_of(image) : std::vector<std::vector<half>>();
    Imf::FrameBuffer source;
    for (size_t c = 0; c < image.channels.size(); ++c) {
        const ExrChannel& channel = image.channels[c];
        header.channels().insert(channel.name, Imf::Channel(is_half ? Imf::HALF : Imf::FLOAT));
        source.insert(channel.name,
                      is_half ? slice_of(Imf::HALF, halves[c].data(), sizeof(half), image.width)
                              : slice_of(Imf::FLOAT, channel.first, channel.stride, image.width));
    }
    Imf::StdOSStream stream;
    {
        Imf::OutputFile file(stream, header);
        file.setFrameBuffer(source);
        file.writePixels(static_cast<int>(image.height));
    }
    return stream.str();
}

}  // namespace

Status write_layered_exr(const std::string& path, const LayeredImage& image,
                         ExrPrecision precision) {
    const uint64_t pixel_count = uint64_t{image.width} * image.height;
    if (pixel_count == 0 || pixel_count > kMaxImagePixels) {
        return Error{str_cat(path, ": cannot write an image of ", image.width, " x ", image.height,
                             " pixels")};
    }
    try {
        const std::string bytes = encode(image, precision);
        return write_file(path, std::as_bytes(std::span(bytes)));
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& exception) {
        return Error{str_cat(path, ": cannot encode OpenEXR image (", exception.what(), ")")};
    }
}

}  // namespace tetralight
