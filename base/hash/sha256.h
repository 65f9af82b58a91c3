// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>

// SHA-256 (FIPS 180-4): names for content that others may have made. Unlike xxHash, which finds
// damage, no two different contents with one hash can be made.

struct evp_md_ctx_st;

namespace tetralight {

using Sha256Digest = std::array<std::byte, 32>;

/// The hash of bytes that come in pieces. The same bytes give the same hash however they are split.
class Sha256 {
  public:
    Sha256();

    /// Appends bytes.
    void add(std::span<const std::byte> bytes);

    void add(std::string_view text) { add(std::as_bytes(std::span(text))); }

    /// The hash of all bytes so far. More bytes may follow.
    [[nodiscard]] Sha256Digest digest() const;

    /// The same as 64 lower-case hexadecimal digits.
    [[nodiscard]] std::string hex() const;

  private:
    struct Free {
        void operator()(evp_md_ctx_st* context) const noexcept;
    };

    std::unique_ptr<evp_md_ctx_st, Free> context_;
};

/// The hash of `bytes` as 64 lower-case hexadecimal digits.
[[nodiscard]] std::string sha256_hex(std::span<const std::byte> bytes);

}  // namespace tetralight
