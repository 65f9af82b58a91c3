// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/query_position.h>

#include <cmath>
#include <glm/geometric.hpp>

#include <tetralight/base/str_cat.h>

namespace tetralight::cli {

Result<QueryPosition> make_query_position(std::span<const float> numbers) {
    QueryPosition result;
    result.position = {numbers[0], numbers[1], numbers[2]};
    if (numbers.size() < 6) return result;
    const glm::dvec3 normal(numbers[3], numbers[4], numbers[5]);
    const double length = glm::length(normal);
    if (!(length > 0.0 && std::isfinite(length))) {
        const std::string shown = str_cat(numbers[3], " ", numbers[4], " ", numbers[5]);
        return Error{ErrorCode::Corrupt, "normal", shown,
                     str_cat("the normal is zero or not finite (", shown, ")")};
    }
    result.normal = glm::vec3(normal / length);
    return result;
}

}  // namespace tetralight::cli
