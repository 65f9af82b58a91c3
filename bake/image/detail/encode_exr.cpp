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

Status write_encoded_exr(const std::string& path, const std::function<std::string()>& encode) {
    try {
        const std::string bytes = encode();
        return write_file(path, std::as_bytes(std::span(bytes)));
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& exception) {
        return Error{ErrorCode::InvalidArgument,
                     str_cat(path, ": cannot encode OpenEXR image (", exception.what(), ")")};
    }
}

}  // namespace tetralight::detail
