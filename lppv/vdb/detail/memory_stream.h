// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <streambuf>
#include <vector>

namespace tetralight::detail {

/// A seekable stream buffer that writes to memory.
class MemoryStream : public std::streambuf {
  public:
    [[nodiscard]] std::span<char> bytes() { return bytes_; }

  protected:
    std::streamsize xsputn(const char* from, std::streamsize count) override;
    int_type overflow(int_type character) override;
    pos_type seekoff(off_type offset, std::ios_base::seekdir from,
                     std::ios_base::openmode mode) override;
    pos_type seekpos(pos_type position, std::ios_base::openmode mode) override;

  private:
    std::vector<char> bytes_;
    size_t position_ = 0;
};

}  // namespace tetralight::detail
