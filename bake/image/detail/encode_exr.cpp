// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/image/detail/encode_exr.h>

#include <ImathBox.h>
#include <ImfOutputFile.h>
#include <ImfStdIO.h>

#include <exception>
#include <new>
#include <span>

#include <tetralight/base/file.h>
#include <tetralight/base/str_cat.h>

namespace tetralight::detail {

std::string encode_exr(const Imf::Header& header, const Imf::FrameBuffer& source) {
    Imf::StdOSStream stream;
    {
        Imf::OutputFile file(stream, header);
        file.setFrameBuffer(source);
        const Imath::Box2i& window = header.dataWindow();
        file.writePixels(window.max.y - window.min.y + 1);
    }
    return stream.str();
}

Result<std::string> encoded_exr(const std::function<std::string()>& encode) {
    try {
        return encode();
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& exception) {
        return Error{ErrorCode::InvalidArgument,
                     str_cat("cannot encode OpenEXR image (", exception.what(), ")")};
    }
}

Status write_encoded_exr(const std::string& path, const std::function<std::string()>& encode) {
    const auto bytes = encoded_exr(encode);
    if (!bytes) return bytes.error().in(path);
    return write_file(path, std::as_bytes(std::span(*bytes)));
}

}  // namespace tetralight::detail
