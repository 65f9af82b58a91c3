// SPDX-License-Identifier: Apache-2.0
#include <tetralight/runtime/detail/c_receivers.h>

#include <cmath>

namespace tetralight::detail {
namespace {

CallError check_optional(const char* name, const tetralight_const_array& array, size_t count,
                         size_t size) {
    if (!array.data) return {};
    return check_array(name, array, count, {size, 4}, Gaps::Refused);
}

bool is_length(float x) {
    return std::isfinite(x) && x >= 0.0f;
}

CallError not_length(const std::string& name, float value) {
    return {TETRALIGHT_BAD_VALUE,
            str_cat(name, " is ", value, "; it must be finite and not negative")};
}

}  // namespace

CallError check_walls(uint32_t walls) {
    if (walls <= TETRALIGHT_IGNORE_WALLS) return {};
    return {TETRALIGHT_BAD_VALUE, str_cat("walls is out of range: ", walls)};
}

CallError check_receivers(const tetralight_const_array& rendering_layers,
                          const tetralight_const_array& radii, size_t count) {
    if (auto wrong = check_optional("rendering_layers", rendering_layers, count, 4)) return wrong;
    if (auto wrong = check_optional("radii", radii, count, 4)) return wrong;
    const auto values = elements_of<float>(radii, 0, count);
    for (size_t i = 0; i < values.size(); ++i) {
        if (!is_length(values[i])) return not_length(str_cat("radii[", i, "]"), values[i]);
    }
    return {};
}

CallError check_normals(const tetralight_const_array& normals, float normal_offset, size_t count) {
    if (auto wrong = check_optional("normals", normals, count, 12)) return wrong;
    return is_length(normal_offset) ? CallError{} : not_length("normal_offset", normal_offset);
}

}  // namespace tetralight::detail
