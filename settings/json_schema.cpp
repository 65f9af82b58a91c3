// SPDX-License-Identifier: Apache-2.0
#include <tetralight/settings/json_schema.h>

#include <cmath>

#include <tetralight/base/str_cat.h>
#include <tetralight/settings/value_text.h>

namespace tetralight::settings {
namespace {

Json number_schema(const Setting& setting, const char* type) {
    Json schema{{"type", type}};
    const Range& range = setting.range;
    const bool is_integer = schema["type"] == "integer";
    const double min = is_integer ? std::max(range.min, 0.0) : range.min;
    const auto limit = [&](double value) {
        return is_integer ? Json(static_cast<uint64_t>(value)) : Json(value);
    };
    if (std::isfinite(min))
        schema[range.excludes_min ? "exclusiveMinimum" : "minimum"] = limit(min);
    if (std::isfinite(range.max)) {
        schema["maximum"] = range.max == 0x1p64 ? Json(UINT64_MAX) : limit(range.max);
    }
    return schema;
}

Json array_schema(Json items, uint32_t count) {
    Json schema{
        {"type", "array"}, {"items", std::move(items)}, {"minItems", count > 0 ? count : 1}};
    if (count > 0) schema["maxItems"] = count;
    return schema;
}

Json fraction_schema() {
    return {{"type", "number"}, {"exclusiveMinimum", 0}, {"maximum", 1}};
}

Json choice_schema(const Setting& setting) {
    Json words = Json::array();
    for_each_word(setting.choices, [&](std::string_view word) { words.push_back(word); });
    return {{"type", "string"}, {"enum", words}};
}

/// One value, or one element of a list.
Json value_schema(const Setting& setting) {
    const Json number = number_schema(setting, "number");
    switch (setting.type) {
        case Type::Flag:
            return {{"type", "boolean"}};
        case Type::Integer:
            return number_schema(setting, "integer");
        case Type::Number:
            return number;
        case Type::Fraction:
            return fraction_schema();
        case Type::Seconds:
            return {{"type", "number"}, {"exclusiveMinimum", 0}};
        case Type::Choice:
            return choice_schema(setting);
        case Type::Range:
        case Type::Text:
        case Type::Path:
            return {{"type", "string"}, {"minLength", 1}};
        case Type::Vector:
        case Type::Direction:
            return array_schema(number, 3);
        case Type::Scale:
            return {{"oneOf", {number, array_schema(number, 3)}}};
        case Type::Sky:
            return {{"oneOf", {number, array_schema(number, 3), {{"type", "string"}}}}};
        case Type::Numbers:
            return array_schema(number, setting.count);
        case Type::Integers:
            return array_schema(number_schema(setting, "integer"), setting.count);
        case Type::Words:
            return array_schema({{"type", "string"}}, 0);
        case Type::Weights:
            return {{"type", "object"}, {"additionalProperties", {{"type", "number"}}}};
    }
    return {};
}

}  // namespace

Json json_schema(const Setting& setting) {
    Json schema = setting.is_list ? array_schema(value_schema(setting), 0) : value_schema(setting);
    schema["description"] = setting.help;
    if (!setting.unit.empty()) schema["x-unit"] = setting.unit;
    if (!setting.without.empty()) schema["x-default"] = setting.without;
    if (!setting.default_text.empty()) {
        auto value = value_from_text(setting, setting.default_text);
        if (value) schema["default"] = std::move(*value);
    }
    return schema;
}

Json json_schema(const Table& table, Access caller) {
    Json properties = Json::object();
    Json required = Json::array();
    table.for_each([&](const Setting& setting) {
        if (caller == Access::Service && setting.access != Access::Service) return;
        properties[std::string(setting.name)] = json_schema(setting);
        if (setting.is_required) required.push_back(setting.name);
    });
    Json schema{{"type", "object"},
                {"description", table.summary},
                {"properties", std::move(properties)},
                {"additionalProperties", false}};
    if (!required.empty()) schema["required"] = std::move(required);
    return schema;
}

}  // namespace tetralight::settings
