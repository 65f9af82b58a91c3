// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/image/detail/decode_jpeg.h>

#include <csetjmp>
#include <cstdio>  // jpeglib.h needs it

#include <jpeglib.h>

#include <jerror.h>

#include <tetralight/bake/image/detail/image_size.h>
#include <tetralight/bake/image/detail/starts_with.h>

namespace tetralight::detail {
namespace {

using Bytes = std::span<const std::byte>;

/// A hostile file can have so many scans that decoding takes hours.
constexpr int kMaxScans = 500;

/// libjpeg's decoder, which leaves by longjmp on errors.
struct JpegDecoder {
    jpeg_decompress_struct info{};
    jpeg_error_mgr errors{};
    jpeg_progress_mgr progress{};
    std::jmp_buf on_error{};
    char reason[JMSG_LENGTH_MAX] = {};

    JpegDecoder() = default;
    JpegDecoder(const JpegDecoder&) = delete;
    JpegDecoder& operator=(const JpegDecoder&) = delete;

    ~JpegDecoder() { jpeg_destroy_decompress(&info); }
};

/// True if a warning says nothing of missing or damaged pixels.
bool is_harmless(int warning) {
    return warning == JWRN_EXTRANEOUS_DATA || warning == JWRN_ADOBE_XFORM ||
           warning == JWRN_JFIF_MAJOR;
}

[[noreturn]] void fail(j_common_ptr info) {
    auto& decoder = *static_cast<JpegDecoder*>(info->client_data);
    decoder.errors.format_message(info, decoder.reason);
    std::longjmp(decoder.on_error, 1);
}

void take_message(j_common_ptr info, int level) {
    const bool is_warning = level < 0;
    if (is_warning && !is_harmless(info->err->msg_code)) fail(info);
}

void limit_scans(j_common_ptr info) {
    auto& decoder = *static_cast<JpegDecoder*>(info->client_data);
    if (decoder.info.input_scan_number <= kMaxScans) return;
    std::snprintf(decoder.reason, sizeof decoder.reason, "more than %d scans", kMaxScans);
    std::longjmp(decoder.on_error, 1);
}

/// Runs a step that calls libjpeg. Returns false if libjpeg left it with an error. No object that
/// has a destructor may live in the step.
template <class Step>
bool run(JpegDecoder& decoder, const Step& step) {
    if (setjmp(decoder.on_error) != 0) return false;
    step();
    return true;
}

/// Creates the decoder and reads all up to the first pixels.
bool read_header(JpegDecoder& decoder, Bytes bytes) {
    jpeg_decompress_struct& info = decoder.info;
    info.err = jpeg_std_error(&decoder.errors);
    decoder.errors.error_exit = fail;
    decoder.errors.emit_message = take_message;
    decoder.progress.progress_monitor = limit_scans;
    info.client_data = &decoder;
    return run(decoder, [&] {
        jpeg_create_decompress(&info);
        info.progress = &decoder.progress;
        jpeg_mem_src(&info, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
        jpeg_read_header(&info, TRUE);
    });
}

Result<ImageSize> read_size(JpegDecoder& decoder, Bytes bytes) {
    if (!read_header(decoder, bytes)) return decode_error(decoder.reason);
    return checked_image_size(decoder.info.image_width, decoder.info.image_height);
}

/// Chooses how pixels are written: 4 bytes each, RGBA or CMYK. Four channels without Adobe's marker
/// are taken as YCbCr and one that is not used. Returns true if that one is to be left out.
bool choose_output(jpeg_decompress_struct& info) {
    const bool is_cmyk = info.num_components == 4;
    const bool has_unused = is_cmyk && info.saw_Adobe_marker == FALSE;
    if (has_unused) info.jpeg_color_space = JCS_YCCK;
    info.out_color_space = is_cmyk ? JCS_CMYK : JCS_EXT_RGBA;
    info.dct_method = JDCT_ISLOW;
    info.do_fancy_upsampling = TRUE;
    return has_unused;
}

/// a · b / 255, rounded.
uint8_t product(uint32_t a, uint32_t b) {
    const uint32_t scaled = a * b + 128;
    return static_cast<uint8_t>((scaled + (scaled >> 8)) >> 8);
}

/// Turns inverted CMYK into RGBA.
void convert_cmyk(Image8& image, bool has_unused) {
    for (auto& pixel : image.pixels) {
        for (size_t channel = 0; channel < 3; ++channel) {
            pixel[channel] = has_unused ? static_cast<uint8_t>(255 - pixel[channel])
                                        : product(pixel[channel], pixel[3]);
        }
        pixel[3] = 255;
    }
}

}  // namespace

bool is_jpeg(Bytes bytes) {
    return starts_with(bytes, "\xff\xd8");
}

Result<ImageSize> read_jpeg_size(Bytes bytes) {
    JpegDecoder decoder;
    return read_size(decoder, bytes);
}

Result<Image8> decode_jpeg(Bytes bytes) {
    JpegDecoder decoder;
    const auto size = read_size(decoder, bytes);
    if (!size) return size.error();
    jpeg_decompress_struct& info = decoder.info;
    const bool is_cmyk = info.num_components == 4;
    const bool has_unused = choose_output(info);
    Image8 image{size->width, size->height, {}};
    image.pixels.resize(size_t{size->width} * size->height);
    const bool is_whole = run(decoder, [&] {
        jpeg_start_decompress(&info);
        while (info.output_scanline < info.output_height) {
            JSAMPROW row = image.pixels[size_t{info.output_scanline} * info.output_width].data();
            jpeg_read_scanlines(&info, &row, 1);
        }
        jpeg_finish_decompress(&info);
    });
    if (!is_whole) return decode_error(decoder.reason);
    if (is_cmyk) convert_cmyk(image, has_unused);
    return image;
}

}  // namespace tetralight::detail
