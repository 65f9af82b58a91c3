// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

#include <tetralight/bake/image/read_image.h>

namespace tetralight::test {

/// A PNG that a command wrote.
[[nodiscard]] inline Result<Image8> decode_picture(const std::string& bytes) {
    return decode_image8(std::as_bytes(std::span(bytes)), "picture");
}

}  // namespace tetralight::test
