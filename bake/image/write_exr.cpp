// SPDX-License-Identifier: Apache-2.0
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>

#include <tetralight/bake/image/detail/encode_exr.h>
#include <tetralight/bake/image/detail/image_size.h>
#include <tetralight/bake/image/write_image.h>
#include <tetralight/base/contract.h>

namespace tetralight {
namespace {

constexpr const char* kChannelNames[] = {"R", "G", "B"};

std::string encode(const ImageF& image) {
    Imf::Header header(static_cast<int>(image.width), static_cast<int>(image.height));
    header.compression() = Imf::ZIP_COMPRESSION;
    Imf::FrameBuffer source;
    for (int channel = 0; channel < 3; ++channel) {
        header.channels().insert(kChannelNames[channel], Imf::Channel(Imf::FLOAT));
        // OpenEXR uses char* for reading and writing; an output file only reads.
        auto* first = const_cast<float*>(&image.pixels[0][channel]);
        source.insert(kChannelNames[channel],
                      Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(first), sizeof(glm::vec3),
                                 sizeof(glm::vec3) * image.width));
    }
    return detail::encode_exr(header, source);
}

}  // namespace

Status write_exr(const std::string& path, const ImageF& image) {
    TETRALIGHT_ASSERT(image.pixels.size() == uint64_t{image.width} * image.height,
                      "an image has width * height pixels");
    if (auto status = detail::check_writable_size(path, image.width, image.height); !status) {
        return status;
    }
    return detail::write_encoded_exr(path, [&image] { return encode(image); });
}

}  // namespace tetralight
