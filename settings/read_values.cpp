// SPDX-License-Identifier: Apache-2.0
#include <tetralight/settings/read_values.h>

#include <algorithm>

#include <tetralight/base/str_cat.h>
#include <tetralight/base/suggest.h>
#include <tetralight/settings/value_json.h>
#include <tetralight/settings/value_text.h>

namespace tetralight::settings {
namespace {

Error named(const Setting& setting, Form form, const Error& error) {
    Error whole = error.in(shown_name(setting, form));
    whole.field = setting.name;
    return whole;
}

/// Settings whose option collects: a second one adds to the first.
bool collects(const Setting& setting) {
    return setting.is_list || setting.type == Type::Words || setting.type == Type::Weights ||
           ((setting.type == Type::Numbers || setting.type == Type::Integers) &&
            setting.count == 0);
}

/// Adds a value to those that were given before.
void add(Values& values, const Setting& setting, Json value) {
    Json all = setting.type == Type::Weights ? Json::object() : Json::array();
    if (values.is_given(setting.name)) all = *values.find(setting.name);
    if (setting.is_list) {
        all.push_back(std::move(value));
    } else {
        for (const auto& [name, element] : value.items()) {
            all.is_object() ? void(all[name] = element) : all.push_back(element);
        }
    }
    values.set(setting, std::move(all));
}

Status check_required(const Values& values, const Setting& setting) {
    if (!setting.is_required || values.is_given(setting.name)) return Ok{};
    return Error{ErrorCode::InvalidArgument, std::string(setting.name), "",
                 values.shown(setting.name) + " is required"};
}

/// What only several settings together can tell.
Status check_together(const Values& values) {
    Status status = Ok{};
    const auto check = [&](const Setting& setting) {
        if (status) status = check_required(values, setting);
        if (!values.is_given(setting.name)) return;
        for_each_word(setting.needs, [&](std::string_view other) {
            if (!status || values.is_given(other)) return;
            status = values.error(setting.name, "needs " + values.shown(other));
        });
        for_each_word(setting.excludes, [&](std::string_view other) {
            if (!status || !values.is_given(other)) return;
            status = values.error(setting.name, "does not go with " + values.shown(other));
        });
    };
    values.table().for_each(check);
    return status;
}

Status read_list(Values& values, const Setting& setting, const Json& json) {
    if (!json.is_array()) {
        return named(setting, Form::Json,
                     {ErrorCode::InvalidArgument, "", shown_value(json),
                      str_cat("\"", shown_value(json), "\" is not an array")});
    }
    for (size_t i = 0; i < json.size(); ++i) {
        auto value = value_from_json(setting, json[i]);
        if (!value) {
            Error error = value.error().in(str_cat(setting.name, "[", i, "]"));
            error.field = str_cat(setting.name, "[", i, "]");
            return error;
        }
        add(values, setting, std::move(*value));
    }
    return Ok{};
}

Error unknown_member(const Table& table, std::string_view member, const Json& value,
                     Access caller) {
    std::vector<std::string> names;
    table.for_each([&](const Setting& setting) {
        if (caller == Access::Command || setting.access == Access::Service) {
            names.emplace_back(setting.name);
        }
    });
    return {ErrorCode::InvalidArgument, std::string(member), shown_value(value),
            str_cat(member, ": there is no such setting", did_you_mean(member, names))};
}

}  // namespace

Result<Values> values_from_arguments(const Table& table, std::span<const Argument> arguments) {
    Values values(table, Form::Options);
    for (const auto& [setting, text] : arguments) {
        auto value = value_from_text(*setting, text);
        if (!value) return named(*setting, Form::Options, value.error());
        if (collects(*setting)) {
            add(values, *setting, std::move(*value));
        } else if (values.is_given(setting->name) && setting->type != Type::Flag) {
            return Error{ErrorCode::InvalidArgument, std::string(setting->name), text,
                         shown_name(*setting, Form::Options) + " is given more than once"};
        } else {
            values.set(*setting, std::move(*value));
        }
    }
    if (auto status = check_together(values); !status) return status.error();
    return values;
}

Result<Values> values_from_json(const Table& table, const Json& json, Access caller,
                                std::string_view others) {
    if (!json.is_object()) {
        return Error{ErrorCode::InvalidArgument, "the settings are not a JSON object"};
    }
    Values values(table, Form::Json);
    for (const auto& [member, value] : json.items()) {
        bool is_other = value.is_null();
        for_each_word(others, [&](std::string_view other) { is_other |= other == member; });
        if (is_other) continue;
        const Setting* setting = table.find(member);
        if (setting == nullptr || (caller == Access::Service && setting->access != caller)) {
            return unknown_member(table, member, value, caller);
        }
        if (setting->is_list) {
            if (auto status = read_list(values, *setting, value); !status) return status.error();
            continue;
        }
        auto checked = value_from_json(*setting, value);
        if (!checked) return named(*setting, Form::Json, checked.error());
        values.set(*setting, std::move(*checked));
    }
    if (auto status = check_together(values); !status) return status.error();
    return values;
}

}  // namespace tetralight::settings
