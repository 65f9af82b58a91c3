// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/image/detail/decode_webp.h>

#include <webp/decode.h>

#include <tetralight/bake/image/detail/image_size.h>
#include <tetralight/bake/image/detail/starts_with.h>

namespace tetralight::detail {
namespace {

using Bytes = std::span<const std::byte>;

const uint8_t* data_of(Bytes bytes) {
    return reinterpret_cast<const uint8_t*>(bytes.data());
}

Error webp_error(VP8StatusCode code) {
    switch (code) {
        case VP8_STATUS_OUT_OF_MEMORY:
            return {ErrorCode::OutOfResources, "cannot decode image (out of memory)"};
        case VP8_STATUS_UNSUPPORTED_FEATURE:
            return decode_error("a feature of WebP is not supported");
        case VP8_STATUS_SUSPENDED:
        case VP8_STATUS_NOT_ENOUGH_DATA:
            return decode_error("the data is cut off");
        default:
            return decode_error("the data is damaged");
    }
}

}  // namespace

bool is_webp(Bytes bytes) {
    return bytes.size() >= 12 && starts_with(bytes, "RIFF") &&
           starts_with(bytes.subspan(8), "WEBP");
}

Result<ImageSize> read_webp_size(Bytes bytes) {
    WebPBitstreamFeatures features;
    const VP8StatusCode code = WebPGetFeatures(data_of(bytes), bytes.size(), &features);
    if (code != VP8_STATUS_OK) return webp_error(code);
    if (features.has_animation != 0) {
        return Error{ErrorCode::Unsupported, "animated WebP images are not supported"};
    }
    return checked_image_size(static_cast<uint64_t>(features.width),
                              static_cast<uint64_t>(features.height));
}

Result<Image8> decode_webp(Bytes bytes) {
    const auto size = read_webp_size(bytes);
    if (!size) return size.error();
    WebPDecoderConfig config;
    if (WebPInitDecoderConfig(&config) == 0) return decode_error("libwebp has another version");
    Image8 image{size->width, size->height, {}};
    image.pixels.resize(size_t{size->width} * size->height);
    config.output.colorspace = MODE_RGBA;
    config.output.is_external_memory = 1;
    config.output.u.RGBA = {image.pixels.data()->data(), static_cast<int>(4 * size->width),
                            4 * image.pixels.size()};
    const VP8StatusCode code = WebPDecode(data_of(bytes), bytes.size(), &config);
    WebPFreeDecBuffer(&config.output);
    if (code != VP8_STATUS_OK) return webp_error(code);
    return image;
}

}  // namespace tetralight::detail
