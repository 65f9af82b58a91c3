// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <tetralight/base/result.h>

namespace tetralight {

/// One channel of an image: the float of pixel i is at `first` + i · `stride` bytes.
struct ExrChannel {
    std::string name;  ///< "layer.R": viewers group channels by the part before the dot
    const float* first = nullptr;
    size_t stride = 0;
};

struct LayeredImage {
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<ExrChannel> channels;
    /// Text attributes of the header.
    std::vector<std::pair<std::string, std::string>> attributes;
};

enum class ExrPrecision : uint8_t { Float, Half };

/// Writes an OpenEXR file of any channels with ZIP compression, top row first; the old file stays
/// whole on failure. Precondition: each channel has width · height floats.
[[nodiscard]] Status write_layered_exr(const std::string& path, const LayeredImage& image,
                                       ExrPrecision precision);

/// The bytes of the same file. Returns invalid_argument if OpenEXR cannot encode the image.
[[nodiscard]] Result<std::string> encode_layered_exr(const LayeredImage& image,
                                                     ExrPrecision precision);

}  // namespace tetralight
