// SPDX-License-Identifier: Apache-2.0
#include <spng.h>

#include <cstddef>
#include <cstdlib>
#include <memory>
#include <vector>

#include <tetralight/bake/image/detail/image_size.h>
#include <tetralight/bake/image/write_image.h>
#include <tetralight/base/contract.h>
#include <tetralight/base/file.h>
#include <tetralight/base/str_cat.h>

namespace tetralight {
namespace {

/// The default of zlib, 6, takes half as long again and makes files 1 percent smaller.
constexpr int kCompressionLevel = 4;

struct FreeEncoder {
    void operator()(spng_ctx* context) const noexcept { spng_ctx_free(context); }
};

struct FreeBytes {
    void operator()(void* bytes) const noexcept { std::free(bytes); }
};

std::vector<spng_text> png_texts(PngTexts& texts) {
    std::vector<spng_text> chunks;
    for (auto& [keyword, text] : texts) {
        TETRALIGHT_ASSERT(!keyword.empty() && keyword.size() < sizeof(spng_text::keyword),
                          "a keyword has 1 to 79 letters");
        spng_text chunk{};
        keyword.copy(chunk.keyword, keyword.size());
        chunk.type = SPNG_TEXT;
        chunk.length = text.size();
        chunk.text = text.data();
        chunks.push_back(chunk);
    }
    return chunks;
}

/// Encodes into a buffer of the context; returns libspng's code.
int encode(spng_ctx* context, const Image8& image, PngTexts texts) {
    spng_ihdr header{};
    header.width = image.width;
    header.height = image.height;
    header.bit_depth = 8;
    header.color_type = SPNG_COLOR_TYPE_TRUECOLOR_ALPHA;
    int code = spng_set_ihdr(context, &header);
    if (code == 0) code = spng_set_option(context, SPNG_ENCODE_TO_BUFFER, 1);
    if (code == 0) {
        code = spng_set_option(context, SPNG_IMG_COMPRESSION_LEVEL, kCompressionLevel);
    }
    std::vector<spng_text> chunks = png_texts(texts);
    if (code == 0 && !chunks.empty()) {
        code = spng_set_text(context, chunks.data(), static_cast<uint32_t>(chunks.size()));
    }
    if (code != 0) return code;
    return spng_encode_image(context, image.pixels.data(), 4 * image.pixels.size(), SPNG_FMT_PNG,
                             SPNG_ENCODE_FINALIZE);
}

}  // namespace

Result<std::vector<std::byte>> encode_png(const Image8& image, const PngTexts& texts) {
    TETRALIGHT_ASSERT(image.pixels.size() == uint64_t{image.width} * image.height,
                      "an image has width * height pixels");
    if (auto status = detail::check_writable_size("image", image.width, image.height); !status) {
        return status.error();
    }
    const std::unique_ptr<spng_ctx, FreeEncoder> context(spng_ctx_new(SPNG_CTX_ENCODER));
    int code = context ? encode(context.get(), image, texts) : SPNG_EMEM;
    size_t size = 0;
    std::unique_ptr<void, FreeBytes> buffer;
    if (code == 0) buffer.reset(spng_get_png_buffer(context.get(), &size, &code));
    if (code != 0) {
        return Error{ErrorCode::OutOfResources,
                     str_cat("cannot encode PNG image (", spng_strerror(code), ")")};
    }
    const auto* first = static_cast<const std::byte*>(buffer.get());
    return std::vector<std::byte>(first, first + size);
}

Status write_png(const std::string& path, const Image8& image) {
    if (auto status = detail::check_writable_size(path, image.width, image.height); !status) {
        return status;
    }
    const auto bytes = encode_png(image);
    if (!bytes) return bytes.error().in(path);
    return write_file(path, *bytes);
}

}  // namespace tetralight
