// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/image/read_image.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <string_view>

#include <tetralight/bake/image/detail/image_size.h>
#include <tetralight/bake/image/detail/radiance_length.h>
#include <tetralight/bake/image/detail/read_exr.h>
#include <tetralight/base/file.h>
#include <tetralight/base/str_cat.h>

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_NO_STDIO
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_ONLY_HDR
#include <stb_image.h>

namespace tetralight {
namespace {

constexpr float kLargestHalf = 65504.0f;

/// So that sums over samples and bounces stay far below the largest float, 3e38.
constexpr float kLargestRadiance = 1e30f;

struct FreeStb {
    void operator()(void* memory) const noexcept { stbi_image_free(memory); }
};

struct ImageSize {
    int width = 0;
    int height = 0;
};

bool starts_with(std::span<const std::byte> bytes, std::string_view magic) {
    return bytes.size() >= magic.size() &&
           std::memcmp(bytes.data(), magic.data(), magic.size()) == 0;
}

const stbi_uc* stb_data(std::span<const std::byte> bytes) {
    return reinterpret_cast<const stbi_uc*>(bytes.data());
}

Error stb_error(const std::string& name) {
    const char* reason = stbi_failure_reason();
    return {ErrorCode::Corrupt,
            str_cat(name, ": cannot decode image (", reason != nullptr ? reason : "unknown", ")")};
}

Status check_size(const std::string& name, uint64_t width, uint64_t height) {
    if (!detail::is_too_large(width, height)) return Ok{};
    return detail::image_size_error(width, height).in(name);
}

uint32_t big_endian_at(std::span<const std::byte> bytes, size_t offset) {
    uint32_t value = 0;
    for (size_t i = 0; i < 4; ++i) {
        value = value << 8 | std::to_integer<uint32_t>(bytes[offset + i]);
    }
    return value;
}

/// Checks the size of a PNG: stb_image reports one that is too large for it as an unknown image.
Status check_png_size(std::span<const std::byte> bytes, const std::string& name) {
    constexpr size_t kWidthOffset = 16;
    constexpr size_t kHeightOffset = 20;
    if (!starts_with(bytes, "\x89PNG") || bytes.size() < kHeightOffset + 4) return Ok{};
    return check_size(name, big_endian_at(bytes, kWidthOffset),
                      big_endian_at(bytes, kHeightOffset));
}

/// Reads the size from the header, so that nothing is allocated for an image that is too large.
Result<ImageSize> read_size(std::span<const std::byte> bytes, const std::string& name) {
    if (bytes.size() > static_cast<size_t>(std::numeric_limits<int>::max())) {
        return Error{ErrorCode::Unsupported,
                     str_cat(name, ": ", bytes.size(), " bytes are too many for an image file")};
    }
    const auto png = check_png_size(bytes, name);
    if (!png) return png.error();
    ImageSize size;
    int channel_count = 0;
    if (stbi_info_from_memory(stb_data(bytes), static_cast<int>(bytes.size()), &size.width,
                              &size.height, &channel_count) == 0) {
        return stb_error(name);
    }
    if (size.width <= 0 || size.height <= 0) {
        return Error{ErrorCode::Corrupt, name + ": image is empty"};
    }
    const auto checked =
        check_size(name, static_cast<uint64_t>(size.width), static_cast<uint64_t>(size.height));
    if (!checked) return checked.error();
    return size;
}

Result<ImageF> decode_radiance_hdr(std::span<const std::byte> bytes, const std::string& path) {
    const auto size = read_size(bytes, path);
    if (!size) return size.error();
    if (!detail::has_all_scan_lines(bytes, static_cast<uint32_t>(size->width),
                                    static_cast<uint32_t>(size->height))) {
        return Error{ErrorCode::Corrupt, str_cat(path, ": is cut off or corrupt (", size->width,
                                                 " x ", size->height, " pixels)")};
    }
    int width = 0;
    int height = 0;
    int channel_count = 0;
    const std::unique_ptr<float, FreeStb> values(stbi_loadf_from_memory(
        stb_data(bytes), static_cast<int>(bytes.size()), &width, &height, &channel_count, 3));
    if (!values) return stb_error(path);
    ImageF image{static_cast<uint32_t>(width), static_cast<uint32_t>(height), {}};
    image.pixels.resize(size_t{image.width} * image.height);
    static_assert(sizeof(glm::vec3) == 3 * sizeof(float));
    std::memcpy(image.pixels.data(), values.get(), image.pixels.size() * sizeof(glm::vec3));
    return image;
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

Result<ImageF> read_any_hdr(const std::string& path) {
    const auto file = MappedFile::open(path);
    if (!file) return file.error();
    const auto bytes = file->bytes();
    if (starts_with(bytes, "\x76\x2f\x31\x01")) return detail::read_exr(path);
    if (starts_with(bytes, "#?")) return decode_radiance_hdr(bytes, path);
    return Error{ErrorCode::Unsupported,
                 path + ": is neither a Radiance .hdr nor an OpenEXR image"};
}

}  // namespace

Result<Image8> decode_image8(std::span<const std::byte> bytes, const std::string& name) {
    if (!starts_with(bytes, "\x89PNG") && !starts_with(bytes, "\xff\xd8")) {
        return Error{ErrorCode::Unsupported, name + ": is neither a PNG nor a JPEG image"};
    }
    const auto size = read_size(bytes, name);
    if (!size) return size.error();
    int width = 0;
    int height = 0;
    int channel_count = 0;
    const std::unique_ptr<stbi_uc, FreeStb> values(stbi_load_from_memory(
        stb_data(bytes), static_cast<int>(bytes.size()), &width, &height, &channel_count, 4));
    if (!values) return stb_error(name);
    Image8 image{static_cast<uint32_t>(width), static_cast<uint32_t>(height), {}};
    image.pixels.resize(size_t{image.width} * image.height);
    std::memcpy(image.pixels.data(), values.get(), image.pixels.size() * 4);
    return image;
}

Result<HdrImage> read_hdr_image(const std::string& path) {
    auto image = read_any_hdr(path);
    if (!image) return image.error();
    HdrImage result{std::move(*image), 0};
    result.mended_pixel_count = mend(result.image);
    return result;
}

}  // namespace tetralight
