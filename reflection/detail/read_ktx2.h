// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

#include <tetralight/base/ktx2.h>
#include <tetralight/base/result.h>
#include <tetralight/reflection/reflections.h>

namespace tetralight::detail {

/// A cube array of RGBA halves in the bytes of a KTX 2.0 file.
struct Ktx2Cubes {
    Ktx2Header header;
    std::array<std::span<const std::byte>, kMaxReflectionLevels> levels;
    std::string_view pairs;  ///< the key/value data
};

/// A value that is wanted of the key/value data.
struct Ktx2Wanted {
    std::string_view key;
    std::optional<std::string_view> value = {};
};

/// Reads the header, the descriptor's size and the level index, and checks every offset and size.
/// Returns corrupt if they are wrong, unsupported if the file has a texture of another kind.
[[nodiscard]] Result<Ktx2Cubes> read_ktx2_cubes(std::span<const std::byte> bytes);

/// Finds values by their keys. Returns corrupt if a pair does not fit, or a key occurs twice.
[[nodiscard]] Status find_ktx2_values(std::string_view pairs, std::span<Ktx2Wanted> wanted);

}  // namespace tetralight::detail
