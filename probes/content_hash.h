// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

namespace tetralight {

/// A 64-bit hash (XXH3) of values one after the other: equal content, equal hash. Not for secrets.
class ContentHash {
  public:
    void add_bytes(std::span<const std::byte> bytes) noexcept;

    /// A value without padding, by its bytes.
    template <class T>
    requires std::is_trivially_copyable_v<T>

    void add(const T& value) noexcept { add_bytes(std::as_bytes(std::span(&value, 1))); }

    /// The number of elements, then each, so that what follows cannot be taken for them.
    template <class T>
    void add(const std::vector<T>& values) noexcept {
        static_assert(std::is_trivially_copyable_v<T>);
        add(static_cast<uint64_t>(values.size()));
        add_bytes(std::as_bytes(std::span(values)));
    }

    [[nodiscard]] uint64_t value() const noexcept { return value_; }

  private:
    uint64_t value_ = 0;
};

}  // namespace tetralight
