// SPDX-License-Identifier: Apache-2.0
#include <tetralight/server/order.h>

#include <tetralight/base/str_cat.h>
#include <tetralight/server/problem.h>
#include <tetralight/settings/read_values.h>

namespace tetralight::server {
namespace {

using settings::Setting;
using settings::Table;
using settings::Type;

bool is_one_of(std::string_view words, std::string_view word) {
    bool found = false;
    settings::for_each_word(words, [&](std::string_view other) { found |= other == word; });
    return found;
}

/// Calls `use(setting, value)` for each member that is a setting and not null.
template <class Use>
void for_each_given(const Table& table, const Json& order, Use use) {
    for (const auto& [member, value] : order.items()) {
        const Setting* setting = table.find(member);
        if (setting != nullptr && is_for_clients(*setting) && !value.is_null()) {
            use(*setting, value);
        }
    }
}

/// Calls `use(reference, name)` for each file that a value refers to.
template <class Use>
void for_each_file(const Setting& setting, const Json& value, Use use) {
    if (!refers_to_files(setting, value)) return;
    const std::string member(setting.name);
    if (!setting.is_list) {
        use(value.get<std::string>(), member);
        return;
    }
    for (size_t i = 0; i < value.size(); ++i) {
        use(value[i].get<std::string>(), str_cat(member, "[", i, "]"));
    }
}

void check_members(const Table& table, const Json& order, std::string_view own_members) {
    for (const auto& [member, value] : order.items()) {
        const Setting* setting = table.find(member);
        if ((setting != nullptr && is_for_clients(*setting)) || is_one_of(own_members, member)) {
            continue;
        }
        throw Problem{400, "unknown_member", "\"" + member + "\" is not a member of this order",
                      member, shown(value)};
    }
    table.for_each([&](const Setting& setting) {
        if (!setting.is_required || !is_for_clients(setting)) return;
        const auto found = order.find(std::string(setting.name));
        if (found != order.end() && !found->is_null()) return;
        const std::string member(setting.name);
        throw Problem{400, "missing_value", member + ": is required", member};
    });
}

}  // namespace

bool is_for_clients(const Setting& setting) {
    return setting.access == settings::Access::Service;
}

bool refers_to_files(const Setting& setting, const Json& value) {
    return setting.type == Type::Path || (setting.type == Type::Sky && value.is_string());
}

Kind kind_of(const Setting& setting, Kind otherwise) {
    for (const Kind kind : kKinds) {
        if (kind != Kind::Volumes && setting.name == noun_of(kind)) return kind;
    }
    return otherwise;
}

settings::Values check_order(const Table& table, const Json& order, std::string_view own_members) {
    check_members(table, order, own_members);
    Json settings = Json::object();
    for_each_given(table, order, [&](const Setting& setting, const Json& value) {
        settings[std::string(setting.name)] = value;
    });
    // The server sets what only it may set, so that is not missing.
    table.for_each([&](const Setting& setting) {
        if (setting.is_required && !is_for_clients(setting)) {
            settings[std::string(setting.name)] = "result";
        }
    });
    auto values = settings::values_from_json(table, settings, settings::Access::Command);
    if (!values) throw setting_problem(values.error(), order);
    return std::move(*values);
}

std::vector<OrderFile> order_files(Store& store, const Table& table, const Json& order, Kind kind) {
    std::vector<OrderFile> files;
    for_each_given(table, order, [&](const Setting& setting, const Json& value) {
        for_each_file(setting, value, [&](const std::string& reference, const std::string& name) {
            try {
                files.push_back({store.get(kind_of(setting, kind), reference), name});
            } catch (Problem& problem) {
                problem.field = name;
                throw;
            }
        });
    });
    return files;
}

Json job_settings(const Table& table, const Json& order) {
    Json job = Json::object();
    for_each_given(table, order, [&](const Setting& setting, const Json& value) {
        const std::string member(setting.name);
        if (!refers_to_files(setting, value)) {
            job[member] = value;
            return;
        }
        if (setting.is_list) job[member] = Json::array();
        for_each_file(setting, value, [&](const std::string&, const std::string& name) {
            if (setting.is_list) {
                job[member].push_back(name);
            } else {
                job[member] = name;
            }
        });
    });
    return job;
}

}  // namespace tetralight::server
