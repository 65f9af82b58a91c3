// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/json_members.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include <tetralight/base/str_cat.h>
#include <tetralight/probes/rendering_layers.h>

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

Result<uint32_t> read_rendering_layers(const nlohmann::json& value, std::string_view name) {
    const auto is_layer = [](const nlohmann::json& layer) {
        if (!layer.is_number()) return false;
        const auto number = layer.get<double>();  // exporters write 3.0, too
        return number >= 0.0 && number < kRenderingLayerCount && number == std::floor(number);
    };
    if (!value.is_array() || value.empty() || !std::ranges::all_of(value, is_layer)) {
        return wrong_type(value, name, "a list of rendering layers, 0 to 31");
    }
    uint32_t mask = 0;
    for (const nlohmann::json& layer : value) {
        mask |= uint32_t{1} << static_cast<uint32_t>(layer.get<double>());
    }
    return mask;
}

std::vector<uint32_t> rendering_layer_list(uint32_t mask) {
    std::vector<uint32_t> layers;
    for (uint32_t i = 0; i < kRenderingLayerCount; ++i) {
        if ((mask >> i & 1) != 0) layers.push_back(i);
    }
    return layers;
}

}  // namespace tetralight::detail
