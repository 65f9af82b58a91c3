// SPDX-License-Identifier: Apache-2.0
#include <tetralight/lppv/vdb/detail/memory_stream.h>

#include <algorithm>
#include <cstring>

namespace tetralight::detail {

std::streamsize MemoryStream::xsputn(const char* from, std::streamsize count) {
    const size_t end = position_ + static_cast<size_t>(count);
    if (end > bytes_.size()) {
        if (end > bytes_.capacity()) bytes_.reserve(std::max(end, 2 * bytes_.capacity()));
        bytes_.resize(end);
    }
    std::memcpy(bytes_.data() + position_, from, static_cast<size_t>(count));
    position_ = end;
    return count;
}

MemoryStream::int_type MemoryStream::overflow(int_type character) {
    if (traits_type::eq_int_type(character, traits_type::eof())) return traits_type::not_eof(0);
    const char byte = traits_type::to_char_type(character);
    xsputn(&byte, 1);
    return character;
}

MemoryStream::pos_type MemoryStream::seekoff(off_type offset, std::ios_base::seekdir from,
                                             std::ios_base::openmode) {
    off_type base = 0;
    if (from == std::ios_base::cur) base = static_cast<off_type>(position_);
    if (from == std::ios_base::end) base = static_cast<off_type>(bytes_.size());
    if (base + offset < 0) return pos_type(off_type(-1));
    position_ = static_cast<size_t>(base + offset);
    return pos_type(base + offset);
}

MemoryStream::pos_type MemoryStream::seekpos(pos_type position, std::ios_base::openmode mode) {
    return seekoff(off_type(position), std::ios_base::beg, mode);
}

}  // namespace tetralight::detail
