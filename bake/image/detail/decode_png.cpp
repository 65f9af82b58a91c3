// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/image/detail/decode_png.h>

#include <spng.h>

#include <array>
#include <cstdint>
#include <memory>
#include <optional>

#include <tetralight/bake/image/detail/image_size.h>
#include <tetralight/bake/image/detail/starts_with.h>

namespace tetralight::detail {
namespace {

using Bytes = std::span<const std::byte>;

using Rgb = std::array<uint8_t, 3>;

/// Bytes of all chunks that are kept, texts and colour profiles above all, after decompression.
constexpr size_t kMaxChunkBytes = size_t{64} << 20;

struct FreePng {
    void operator()(spng_ctx* context) const noexcept { spng_ctx_free(context); }
};

using PngContext = std::unique_ptr<spng_ctx, FreePng>;

Error png_error(int code) {
    Error error = decode_error(spng_strerror(code));
    if (code == SPNG_EMEM) error.code = ErrorCode::OutOfResources;
    return error;
}

Result<ImageSize> read_size(spng_ctx* context, Bytes bytes) {
    if (context == nullptr) return png_error(SPNG_EMEM);
    int code = spng_set_chunk_limits(context, kMaxChunkBytes, kMaxChunkBytes);
    if (code == 0) code = spng_set_png_buffer(context, bytes.data(), bytes.size());
    spng_ihdr header{};
    if (code == 0) code = spng_get_ihdr(context, &header);
    if (code != 0) return png_error(code);
    return checked_image_size(header.width, header.height);
}

/// The colour of a PNG of 8 bits per channel that stands for transparent pixels, if it has one. Of
/// the 16 bits that a file has for each channel the lower 8 count; libspng compares all 16.
std::optional<Rgb> find_transparent_color(spng_ctx* context) {
    spng_ihdr header{};
    spng_trns transparent{};
    if (spng_get_ihdr(context, &header) != 0 || header.bit_depth != 8) return std::nullopt;
    if (spng_get_trns(context, &transparent) != 0) return std::nullopt;
    if (header.color_type == SPNG_COLOR_TYPE_GRAYSCALE) {
        const auto gray = static_cast<uint8_t>(transparent.gray);
        return Rgb{gray, gray, gray};
    }
    if (header.color_type != SPNG_COLOR_TYPE_TRUECOLOR) return std::nullopt;
    return Rgb{static_cast<uint8_t>(transparent.red), static_cast<uint8_t>(transparent.green),
               static_cast<uint8_t>(transparent.blue)};
}

void make_transparent(Image8& image, const Rgb& color) {
    for (auto& pixel : image.pixels) {
        if (pixel[0] == color[0] && pixel[1] == color[1] && pixel[2] == color[2]) pixel[3] = 0;
    }
}

}  // namespace

bool is_png(Bytes bytes) {
    return starts_with(bytes, "\x89PNG");
}

Result<ImageSize> read_png_size(Bytes bytes) {
    const PngContext context(spng_ctx_new(0));
    return read_size(context.get(), bytes);
}

Result<Image8> decode_png(Bytes bytes) {
    const PngContext context(spng_ctx_new(0));
    const auto size = read_size(context.get(), bytes);
    if (!size) return size.error();
    Image8 image{size->width, size->height, {}};
    image.pixels.resize(size_t{size->width} * size->height);
    int code = spng_decode_image(context.get(), image.pixels.data(), 4 * image.pixels.size(),
                                 SPNG_FMT_RGBA8, SPNG_DECODE_TRNS);
    if (code == 0)
        code = spng_decode_chunks(context.get());  // so that a file without its end fails
    if (code != 0) return png_error(code);
    if (const auto color = find_transparent_color(context.get())) make_transparent(image, *color);
    return image;
}

}  // namespace tetralight::detail
