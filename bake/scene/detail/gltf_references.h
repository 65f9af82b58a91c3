// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

// What a glTF document refers to. References are found by the names of their members, also in
// extensions and extras: too many may be found, so that nothing is dropped that is in use.

namespace tetralight::detail {

/// Accessors that the document refers to, but for these primitives (mesh, primitive).
[[nodiscard]] std::set<uint32_t> used_accessors(
    const nlohmann::ordered_json& document, const std::set<std::pair<uint32_t, uint32_t>>& places);

/// Accessors that these primitives refer to.
[[nodiscard]] std::set<uint32_t> primitive_accessors(
    const nlohmann::ordered_json& document, const std::set<std::pair<uint32_t, uint32_t>>& places);

/// Buffer views that the document refers to, but for these accessors.
[[nodiscard]] std::set<uint32_t> used_views(const nlohmann::ordered_json& document,
                                            const std::set<uint32_t>& accessors);

/// Buffer views that these accessors refer to.
[[nodiscard]] std::set<uint32_t> accessor_views(const nlohmann::ordered_json& document,
                                                const std::set<uint32_t>& accessors);

}  // namespace tetralight::detail
