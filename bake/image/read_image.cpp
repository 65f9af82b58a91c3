// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/image/read_image.h>

#include <algorithm>
#include <cmath>

#include <tetralight/bake/image/detail/decode_hdr.h>
#include <tetralight/bake/image/detail/decode_jpeg.h>
#include <tetralight/bake/image/detail/decode_png.h>
#include <tetralight/bake/image/detail/decode_webp.h>
#include <tetralight/bake/image/detail/exr_header.h>
#include <tetralight/bake/image/detail/read_exr.h>
#include <tetralight/bake/image/detail/starts_with.h>
#include <tetralight/base/file.h>
#include <tetralight/base/process/memory.h>
#include <tetralight/base/str_cat.h>

namespace tetralight {
namespace {

using Bytes = std::span<const std::byte>;

constexpr float kLargestHalf = 65504.0f;

/// So that sums over samples and bounces stay far below the largest float, 3e38.
constexpr float kLargestRadiance = 1e30f;

struct Format {
    bool (*is_format)(Bytes bytes);
    Result<ImageSize> (*read_size)(Bytes bytes);
    Result<Image8> (*decode)(Bytes bytes);
};

constexpr Format kFormats[] = {
    {detail::is_png, detail::read_png_size, detail::decode_png},
    {detail::is_jpeg, detail::read_jpeg_size, detail::decode_jpeg},
    {detail::is_webp, detail::read_webp_size, detail::decode_webp},
};

/// Calls a function of the format that the bytes have; its errors get the name.
template <class T>
Result<T> by_format(Bytes bytes, const std::string& name,
                    Result<T> (*Format::*function)(Bytes bytes)) {
    const auto format = std::ranges::find_if(
        kFormats, [&](const Format& candidate) { return candidate.is_format(bytes); });
    if (format == std::end(kFormats)) {
        return Error{ErrorCode::Unsupported,
                     name + ": is neither a PNG nor a JPEG nor a WebP image"};
    }
    auto result = (format->*function)(bytes);
    if (!result) return result.error().in(name);
    return result;
}

float mended(float value) {
    if (!(value >= 0.0f)) return 0.0f;  // NaN too
    return std::isinf(value) ? kLargestHalf : std::min(value, kLargestRadiance);
}

uint64_t mend(ImageF& image) {
    uint64_t mended_pixel_count = 0;
    for (glm::vec3& pixel : image.pixels) {
        const glm::vec3 good(mended(pixel.x), mended(pixel.y), mended(pixel.z));
        if (good == pixel) continue;
        pixel = good;
        ++mended_pixel_count;
    }
    return mended_pixel_count;
}

bool is_exr(Bytes bytes) {
    return detail::starts_with(bytes, "\x76\x2f\x31\x01");
}

Error unknown_hdr_error() {
    return {ErrorCode::Unsupported, "is neither a Radiance .hdr nor an OpenEXR image"};
}

Result<ImageSize> hdr_size(Bytes bytes) {
    if (is_exr(bytes)) return detail::read_exr_size(bytes);
    if (detail::is_hdr(bytes)) return detail::read_hdr_size(bytes);
    return unknown_hdr_error();
}

/// Returns out_of_resources if an image of this size needs more memory than is free.
Status check_memory(ImageSize size) {
    const uint64_t bytes = uint64_t{size.width} * size.height * sizeof(glm::vec3);
    const uint64_t free = free_memory();
    if (bytes <= free) return Ok{};
    return Error{ErrorCode::OutOfResources,
                 str_cat("its ", size.width, " x ", size.height, " pixels need about ",
                         gigabytes(bytes), " of memory, ", gigabytes(free), " are free")};
}

Result<ImageF> read_any_hdr(const std::string& path) {
    const auto file = MappedFile::open(path);
    if (!file) return file.error();
    const auto bytes = file->bytes();
    const auto size = hdr_size(bytes);
    if (!size) return size.error().in(path);
    if (auto status = check_memory(*size); !status) return status.error().in(path);
    if (is_exr(bytes)) return detail::read_exr(path);
    auto image = detail::decode_hdr(bytes);
    if (!image) return image.error().in(path);
    return image;
}

}  // namespace

Result<ImageSize> read_image_size(Bytes bytes, const std::string& name) {
    return by_format(bytes, name, &Format::read_size);
}

Result<Image8> decode_image8(Bytes bytes, const std::string& name) {
    return by_format(bytes, name, &Format::decode);
}

Result<ImageSize> read_hdr_image_size(const std::string& path) {
    const auto file = MappedFile::open(path);
    if (!file) return file.error();
    auto size = hdr_size(file->bytes());
    if (!size) return size.error().in(path);
    return size;
}

Result<HdrImage> read_hdr_image(const std::string& path) {
    auto image = read_any_hdr(path);
    if (!image) return image.error();
    HdrImage result{std::move(*image), 0};
    result.mended_pixel_count = mend(result.image);
    return result;
}

}  // namespace tetralight
