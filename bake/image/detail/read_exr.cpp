// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/image/detail/read_exr.h>

#include <ImathBox.h>
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <exception>
#include <new>

#include <tetralight/bake/image/detail/image_size.h>
#include <tetralight/base/str_cat.h>

namespace tetralight::detail {
namespace {

/// Names of the file's channels for red, green and blue.
using ChannelNames = std::array<const char*, 3>;

Result<ChannelNames> find_channels(const Imf::ChannelList& channels) {
    const bool has_color = channels.findChannel("R") != nullptr ||
                           channels.findChannel("G") != nullptr ||
                           channels.findChannel("B") != nullptr;
    const ChannelNames names = !has_color && channels.findChannel("Y") != nullptr
                                   ? ChannelNames{"Y", "Y", "Y"}
                                   : ChannelNames{"R", "G", "B"};
    for (const char* name : names) {
        const Imf::Channel* channel = channels.findChannel(name);
        if (channel == nullptr) {
            return Error{ErrorCode::Unsupported, str_cat("has no channel ", name)};
        }
        if (channel->xSampling != 1 || channel->ySampling != 1) {
            return Error{ErrorCode::Unsupported,
                         str_cat("channel ", name, " is subsampled, which is not supported")};
        }
    }
    return names;
}

Result<ImageF> make_image(const Imath::Box2i& window) {
    const int64_t width = int64_t{window.max.x} - window.min.x + 1;
    const int64_t height = int64_t{window.max.y} - window.min.y + 1;
    const auto size = checked_image_size(static_cast<uint64_t>(std::max<int64_t>(width, 0)),
                                         static_cast<uint64_t>(std::max<int64_t>(height, 0)));
    if (!size) return size.error();
    ImageF image{size->width, size->height, {}};
    image.pixels.resize(size_t{size->width} * size->height);
    return image;
}

Result<ImageF> read_pixels(Imf::InputFile& file) {
    const auto names = find_channels(file.header().channels());
    if (!names) return names.error();
    const Imath::Box2i window = file.header().dataWindow();
    auto image = make_image(window);
    if (!image) return image.error();

    const bool is_grey = (*names)[0][0] == 'Y';
    Imf::FrameBuffer target;
    for (int channel = 0; channel < (is_grey ? 1 : 3); ++channel) {
        target.insert((*names)[static_cast<size_t>(channel)],
                      Imf::Slice::Make(Imf::FLOAT, &image->pixels[0][channel], window,
                                       sizeof(glm::vec3), sizeof(glm::vec3) * image->width));
    }
    file.setFrameBuffer(target);
    file.readPixels(window.min.y, window.max.y);
    if (is_grey) {
        for (glm::vec3& pixel : image->pixels) pixel = glm::vec3(pixel.x);
    }
    return image;
}

}  // namespace

Result<ImageF> read_exr(const std::string& path) {
    try {
        Imf::InputFile file(path.c_str());
        auto image = read_pixels(file);
        if (!image) return image.error().in(path);
        return image;
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& exception) {
        return Error{ErrorCode::Corrupt,
                     str_cat(path, ": cannot read OpenEXR image (", exception.what(), ")")};
    }
}

}  // namespace tetralight::detail
