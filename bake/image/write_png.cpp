// SPDX-License-Identifier: Apache-2.0
#include <cstddef>
#include <vector>

#include <tetralight/bake/image/detail/image_size.h>
#include <tetralight/bake/image/write_image.h>
#include <tetralight/base/contract.h>
#include <tetralight/base/file.h>

#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#define STBI_WRITE_NO_STDIO
#include <stb_image_write.h>

namespace tetralight {
namespace {

void append_bytes(void* target, void* data, int size) {
    auto& bytes = *static_cast<std::vector<std::byte>*>(target);
    const auto* first = static_cast<const std::byte*>(data);
    bytes.insert(bytes.end(), first, first + size);
}

}  // namespace

Status write_png(const std::string& path, const Image8& image) {
    TETRALIGHT_ASSERT(image.pixels.size() == uint64_t{image.width} * image.height,
                      "an image has width * height pixels");
    if (auto status = detail::check_writable_size(path, image.width, image.height); !status) {
        return status;
    }
    std::vector<std::byte> bytes;
    const int width = static_cast<int>(image.width);
    if (stbi_write_png_to_func(append_bytes, &bytes, width, static_cast<int>(image.height), 4,
                               image.pixels.data(), width * 4) == 0) {
        return Error{ErrorCode::OutOfResources, path + ": cannot encode PNG image"};
    }
    return write_file(path, bytes);
}

}  // namespace tetralight
