// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/json_members.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <new>
#include <nlohmann/json.hpp>

#include <tetralight/base/json/json_text.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/probes/rendering_layers.h>

namespace tetralight::detail {
namespace {

template <class Number>
Status read_number_as(const nlohmann::json& object, const char* key,
                      std::optional<Number>& number) {
    const auto value = object.find(key);
    if (value == object.end()) return Ok{};
    if (!value->is_number()) return wrong_type(*value, key, "a number");
    number = value->get<Number>();
    return Ok{};
}

}  // namespace

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

std::optional<int32_t> read_int32(const nlohmann::json& value) {
    using Limits = std::numeric_limits<int32_t>;
    if (!value.is_number()) return std::nullopt;
    const auto number = value.get<double>();
    const bool is_int32 =
        number >= Limits::min() && number <= Limits::max() && number == std::floor(number);
    return is_int32 ? std::optional(static_cast<int32_t>(number)) : std::nullopt;
}

Status read_number(const nlohmann::json& object, const char* key, std::optional<double>& number) {
    return read_number_as(object, key, number);
}

Status read_number(const nlohmann::json& object, const char* key, std::optional<float>& number) {
    return read_number_as(object, key, number);
}

std::optional<glm::dvec3> read_vec3(const nlohmann::json& value) {
    const auto is_number = [](const nlohmann::json& number) { return number.is_number(); };
    if (!value.is_array() || value.size() != 3 || !std::ranges::all_of(value, is_number)) {
        return std::nullopt;
    }
    return glm::dvec3(value[0].get<double>(), value[1].get<double>(), value[2].get<double>());
}

Status read_vec3(const nlohmann::json& object, const char* key, glm::dvec3& v) {
    const auto value = object.find(key);
    if (value == object.end()) return Ok{};
    const auto read = read_vec3(*value);
    if (!read) return wrong_type(*value, key, "three numbers");
    v = *read;
    return Ok{};
}

Result<nlohmann::json> parse_json(std::span<const std::byte> bytes) {
    const std::string_view characters(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (auto status = check_json_shape(characters); !status) return status.error();
    try {
        if (const auto key = find_duplicate_key(characters)) {
            return Error{ErrorCode::Corrupt, *key, "",
                         str_cat("\"", *key, "\" is given twice in one object")};
        }
        return nlohmann::json::parse(characters);
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& exception) {
        return Error{ErrorCode::Corrupt, json_error_reason(exception)};
    }
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
