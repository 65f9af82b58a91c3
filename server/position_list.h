// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tetralight::server {

/// Takes the positions out of a query in JSON, `{"positions": [[x, y, z], ...], ...}`, without a
/// value of a JSON library for each number. Returns the text with an empty list in their place, all
/// the rest of it unchecked; nothing if it is not written plainly, or a number does not fit in a
/// float: then a general parser reads it, or tells what is wrong. Numbers become the nearest
/// floats.
[[nodiscard]] std::optional<std::string> take_positions(std::string_view json,
                                                        std::vector<glm::vec3>& positions);

}  // namespace tetralight::server
