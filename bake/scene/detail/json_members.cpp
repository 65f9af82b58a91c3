// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/json_members.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include <tetralight/base/str_cat.h>

namespace tetralight::detail {

std::string shown_json(const nlohmann::json& value) {
    constexpr size_t kMaxLength = 40;
    const std::string dumped = value.dump();
    return dumped.size() <= kMaxLength ? dumped : dumped.substr(0, kMaxLength) + "...";
}

Error wrong_type(const nlohmann::json& value, std::string_view name, std::string_view wanted) {
    const std::string shown = shown_json(value);
    return {ErrorCode::Corrupt, str_cat(".", name), shown,
            str_cat(name, " is not ", wanted, " (", shown, ")")};
}

Status check_keys(const nlohmann::json& object, std::initializer_list<std::string_view> known) {
    for (const auto& [key, value] : object.items()) {
        if (std::ranges::find(known, key) != known.end()) continue;
        return Error{ErrorCode::Corrupt, "." + key, shown_json(value),
                     str_cat("unknown key \"", key, "\"")};
    }
    return Ok{};
}

}  // namespace tetralight::detail
