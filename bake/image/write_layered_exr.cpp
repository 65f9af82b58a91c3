// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/image/write_layered_exr.h>

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfStringAttribute.h>

#include <half.h>
#include <algorithm>

#include <tetralight/bake/image/detail/encode_exr.h>
#include <tetralight/bake/image/detail/image_size.h>

namespace tetralight {
namespace {

float value_of(const ExrChannel& channel, size_t pixel) {
    const auto* bytes = reinterpret_cast<const std::byte*>(channel.first);
    return *reinterpret_cast<const float*>(bytes + pixel * channel.stride);
}

/// The channels as halves, as OpenEXR requires. Larger values become the largest half.
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

/// OpenEXR uses char* for reading and writing; an output file only reads.
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
    return detail::encode_exr(header, source);
}

}  // namespace

Status write_layered_exr(const std::string& path, const LayeredImage& image,
                         ExrPrecision precision) {
    if (auto status = detail::check_writable_size(path, image.width, image.height); !status) {
        return status;
    }
    return detail::write_encoded_exr(path, [&] { return encode(image, precision); });
}

Result<std::string> encode_layered_exr(const LayeredImage& image, ExrPrecision precision) {
    return detail::encoded_exr([&] { return encode(image, precision); });
}

}  // namespace tetralight
