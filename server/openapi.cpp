// SPDX-License-Identifier: Apache-2.0
#include <tetralight/server/openapi.h>

#include <tetralight/base/str_cat.h>
#include <tetralight/server/order.h>
#include <tetralight/settings/json_schema.h>

namespace tetralight::server {
namespace {

/// Help with the members of orders instead of options: "target_error" for "--target-error".
std::string in_json_words(std::string_view help) {
    const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || c == '-'; };
    std::string words;
    while (!help.empty()) {
        const bool is_option = help.starts_with("--");
        if (is_option) help.remove_prefix(2);
        do {
            words += is_option && help.front() == '-' ? '_' : help.front();
            help.remove_prefix(1);
        } while (is_option && !help.empty() && is_letter(help.front()));
    }
    return words;
}

/// A setting as clients see it: stored files instead of paths.
Json property_of(const settings::Setting& setting, std::string_view heading) {
    Json schema = settings::json_schema(setting);
    const std::string help = in_json_words(setting.help);
    schema["description"] = help;
    if (setting.type == settings::Type::Path) {
        const char* kind = name_of(kind_of(setting));
        schema["x-stored"] = kind;
        schema["description"] = str_cat(setting.is_list ? "Ids or names" : "An id or name",
                                        " of stored ", kind, ": ", help);
    }
    if (!setting.without.empty()) schema["x-default"] = in_json_words(setting.without);
    schema["x-group"] = in_json_words(heading);
    return schema;
}

/// Adds the settings of a command to a schema. Properties that the schema has already stay. The
/// volume of a query is in the path.
void add_settings(const settings::Table& table, Json& schema) {
    Json properties = Json::object();
    Json required = Json::array();
    for (const settings::Group& group : table.groups) {
        for (const settings::Setting& setting : group.settings) {
            const bool is_in_path = &table == &settings::kQuery && setting.is_required;
            if (!is_for_clients(setting) || is_in_path) continue;
            properties[std::string(setting.name)] = property_of(setting, group.heading);
            if (setting.is_required) required.push_back(setting.name);
        }
    }
    properties.update(schema.value("properties", Json::object()));
    for (const Json& name : schema.value("required", Json::array())) required.push_back(name);
    schema["description"] = table.summary;
    schema["properties"] = std::move(properties);
    if (!required.empty()) schema["required"] = std::move(required);
}

}  // namespace

std::string openapi_document() {
    Json document = Json::parse(openapi_text());
    for (Json& schema : document["components"]["schemas"]) {
        if (!schema.contains("x-settings")) continue;
        const auto name = schema["x-settings"].get<std::string>();
        const auto* table =
            name == settings::kLimits.command ? &settings::kLimits : settings::find_table(name);
        if (table != nullptr) add_settings(*table, schema);
        schema.erase("x-settings");
    }
    return document.dump(2) + "\n";
}

}  // namespace tetralight::server
