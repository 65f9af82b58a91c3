// SPDX-License-Identifier: Apache-2.0
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <ImfStdIO.h>

#include <exception>
#include <new>

#include <tetralight/bake/image/read_image.h>
#include <tetralight/bake/image/write_image.h>
#include <tetralight/base/file.h>
#include <tetralight/base/str_cat.h>

namespace tetralight {
namespace {

constexpr const char* kChannelNames[] = {"R", "G", "B"};

std::string encode_exr(const ImageF& image) {
    Imf::Header header(static_cast<int>(image.width), static_cast<int>(image.height));
    header.compression() = Imf::ZIP_COMPRESSION;
    Imf::FrameBuffer source;
    for (int channel = 0; channel < 3; ++channel) {
        header.channels().insert(kChannelNames[channel], Imf::Channel(Imf::FLOAT));
        // OpenEXR takes char* for reading and writing alike; an output file only reads.
        auto* first = const_cast<float*>(&image.pixels[0][channel]);
        source.insert(kChannelNames[channel],
                      Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(first), sizeof(glm::vec3),
                                 sizeof(glm::vec3) * image.width));
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

Status write_exr(const std::string& path, const ImageF& image) {
    const uint64_t pixel_count = uint64_t{image.width} * image.height;
    TETRALIGHT_ASSERT(image.pixels.size() == pixel_count, "an image has width * height pixels");
    if (pixel_count == 0 || pixel_count > kMaxImagePixels) {
        return Error{str_cat(path, ": cannot write an image of ", image.width, " x ", image.height,
                             " pixels")};
    }
    try {
        const std::string bytes = encode_exr(image);
        return write_file(path, std::as_bytes(std::span(bytes)));
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& exception) {
        return Error{str_cat(path, ": cannot encode OpenEXR image (", exception.what(), ")")};
    }
}

}  // namespace tetralight
