// SPDX-License-Identifier: Apache-2.0
#include <tetralight/settings/values.h>

#include <tetralight/base/contract.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/settings/value_json.h>
#include <tetralight/settings/value_text.h>

namespace tetralight::settings {

Values::Values(const Table& table, Form form) : table_(&table), form_(form) {
    table.for_each([&](const Setting& setting) {
        if (setting.default_text.empty()) return;
        auto value = value_from_text(setting, setting.default_text);
        TETRALIGHT_ASSERT(value, "a default that its own setting refuses");
        defaults_[std::string(setting.name)] = std::move(*value);
    });
}

bool Values::is_given(std::string_view name) const {
    const auto found = given_.find(std::string(name));
    return found != given_.end() && *found != Json(false);
}

const Json* Values::find(std::string_view name) const {
    TETRALIGHT_ASSERT(table_->find(name) != nullptr, "the name of no setting");
    for (const Json* all : {&given_, &defaults_}) {
        const auto found = all->find(std::string(name));
        if (found != all->end()) return &*found;
    }
    return nullptr;
}

bool Values::flag(std::string_view name) const {
    const Json* value = find(name);
    return value != nullptr && value->get<bool>();
}

uint64_t Values::integer(std::string_view name) const {
    const Json* value = find(name);
    return value == nullptr ? 0 : value->get<uint64_t>();
}

uint32_t Values::integer32(std::string_view name) const {
    return static_cast<uint32_t>(integer(name));
}

double Values::number(std::string_view name) const {
    const Json* value = find(name);
    return value == nullptr ? 0.0 : value->get<double>();
}

float Values::number32(std::string_view name) const {
    return static_cast<float>(number(name));
}

std::string Values::text(std::string_view name) const {
    const Json* value = find(name);
    return value == nullptr ? "" : value->get<std::string>();
}

size_t Values::choice(std::string_view name) const {
    const std::string word = text(name);
    size_t index = 0, found = 0;
    for_each_word(table_->find(name)->choices, [&](std::string_view candidate) {
        if (candidate == word) found = index;
        ++index;
    });
    return found;
}

std::array<double, 3> Values::vector(std::string_view name) const {
    const Json* value = find(name);
    return value == nullptr ? std::array<double, 3>{} : value->get<std::array<double, 3>>();
}

std::vector<double> Values::numbers(std::string_view name) const {
    const Json* value = find(name);
    return value == nullptr ? std::vector<double>{} : value->get<std::vector<double>>();
}

uint32_t Values::bits(std::string_view name, uint32_t without) const {
    const Json* value = find(name);
    if (value == nullptr) return without;
    uint32_t bits = 0;
    for (const Json& element : *value) bits |= uint32_t{1} << element.get<uint32_t>();
    return bits;
}

std::vector<std::string> Values::texts(std::string_view name) const {
    const Json* value = find(name);
    return value == nullptr ? std::vector<std::string>{} : value->get<std::vector<std::string>>();
}

void Values::set(const Setting& setting, Json value) {
    given_[std::string(setting.name)] = std::move(value);
}

Error Values::error(std::string_view name, std::string_view message) const {
    const auto given = given_.find(std::string(name));
    const std::string value = given == given_.end() ? "" : shown_value(*given);
    return {ErrorCode::InvalidArgument, std::string(name), value,
            str_cat(shown(name), ": ", message)};
}

std::string Values::shown(std::string_view name) const {
    const Setting* setting = table_->find(name);
    TETRALIGHT_ASSERT(setting != nullptr, "the name of no setting");
    return shown_name(*setting, form_);
}

Json json_from_values(const Values& values) {
    Json json = Json::object();
    values.table().for_each([&](const Setting& setting) {
        const Json* value = values.find(setting.name);
        if (value != nullptr) json[std::string(setting.name)] = *value;
    });
    return json;
}

}  // namespace tetralight::settings
