// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/plan_order.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <string_view>

#include <tetralight/base/file.h>
#include <tetralight/base/json/json_text.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/base/suggest.h>
#include <tetralight/base/utf8.h>
#include <tetralight/batch/limits.h>
#include <tetralight/settings/read_values.h>

namespace tetralight::cli {
namespace {

namespace fs = std::filesystem;
using settings::Table;
using settings::Type;

/// A kind of light that an order asks for, and the command that bakes it.
struct Kind {
    const char* name;
    const Table* table;
    std::optional<Json> SceneOrder::*settings;
};

constexpr Kind kKinds[] = {{"probes", &settings::kBake, &SceneOrder::probes},
                           {"lightmaps", &settings::kLightmap, &SceneOrder::lightmaps},
                           {"reflections", &settings::kReflect, &SceneOrder::reflections}};

Error wrong(const std::string& place, const std::string& member, const std::string& message) {
    return Error{ErrorCode::InvalidArgument, member, "", str_cat(place, ": ", member, message)};
}

/// Commands have settings of these names, too: `bake --probes` is a range of them.
bool is_of_order(const std::string& member) {
    return member == "name" ||
           std::ranges::any_of(kKinds, [&](const Kind& kind) { return member == kind.name; });
}

/// Names files: no separators, and nothing that a terminal acts on.
bool is_name(const std::string& name) {
    constexpr size_t kLongest = 200;
    return !name.empty() && name.size() <= kLongest && name[0] != '.' && name[0] != '-' &&
           name.find('/') == std::string::npos && name.find('\\') == std::string::npos &&
           name == without_controls(name);
}

std::string absolute(const fs::path& folder, const std::string& path) {
    return (folder / path).lexically_normal().string();
}

/// Paths in orders are relative to the order.
void make_paths_absolute(const Table& table, const fs::path& folder, Json& values) {
    table.for_each([&](const settings::Setting& setting) {
        if (setting.type != Type::Path && setting.type != Type::Sky) return;
        const auto found = values.find(std::string(setting.name));
        if (found == values.end()) return;
        if (found->is_string()) *found = absolute(folder, found->get<std::string>());
        if (!found->is_array() || setting.type == Type::Sky) return;
        for (Json& path : *found)
            if (path.is_string()) path = absolute(folder, path.get<std::string>());
    });
}

/// A path that is empty is no path, and stays to be refused.
bool has_scene(const Json& scene) {
    const auto path = scene.find("scene");
    return path != scene.end() && path->is_string() && !path->get<std::string>().empty();
}

class OrderReader {
  public:
    explicit OrderReader(const std::string& path)
        : path_(path), folder_(fs::absolute(path).parent_path()) {}

    Result<std::vector<SceneOrder>> read() {
        const auto json = read_json();
        if (!json) return json.error();
        for (const auto& [member, value] : json->items())
            if (member != "scenes" && member != "limits")
                return wrong(path_, member, ": there is no such member");
        if (auto status = add_limits(*json, path_, limits_); !status) return status.error();
        const auto scenes = json->find("scenes");
        if (scenes == json->end() || !scenes->is_array() || scenes->empty())
            return wrong(path_, "scenes", ": expected an array with a scene or more");
        std::vector<SceneOrder> orders;
        std::set<std::string> names;
        for (const Json& scene : *scenes) {
            auto order = read_scene(scene, orders.size());
            if (!order) return order.error();
            if (!names.insert(order->name).second) {
                return wrong(order->place, "name",
                             str_cat(": \"", order->name,
                                     "\" is the name of an earlier scene; give each another one"));
            }
            orders.push_back(std::move(*order));
        }
        return orders;
    }

  private:
    [[nodiscard]] Result<Json> read_json() const {
        const auto bytes = read_file(path_);
        if (!bytes) return bytes.error();
        const std::string_view text(reinterpret_cast<const char*>(bytes->data()), bytes->size());
        if (const auto status = check_json_object(text); !status) return status.error().in(path_);
        if (const auto key = find_duplicate_key(text)) {
            return Error{ErrorCode::InvalidArgument, *key, "",
                         str_cat(path_, ": \"", *key, "\" is given twice in one object")};
        }
        return Json::parse(text);
    }

    [[nodiscard]] Result<SceneOrder> read_scene(const Json& scene, size_t index) const {
        SceneOrder order;
        order.place = str_cat(path_, ": scenes[", index, "]");
        if (!scene.is_object())
            return Error{ErrorCode::InvalidArgument, order.place + ": expected an object"};
        if (!has_scene(scene))
            return wrong(order.place, "scene", ": the path of a scene is required");
        order.name = fs::path(scene["scene"].get<std::string>()).stem().string();
        if (const auto name = scene.find("name"); name != scene.end()) {
            if (!name->is_string()) return wrong(order.place, "name", ": expected a text");
            order.name = name->get<std::string>();
        }
        if (!is_name(order.name)) {
            return wrong(order.place, "name",
                         str_cat(": \"", without_controls(order.name),
                                 "\" cannot begin the name of a file"));
        }
        for (const Kind& kind : kKinds) {
            if (!scene.contains(kind.name)) continue;
            auto values = settings_of(scene, kind, order.place);
            if (!values) return values.error();
            order.*kind.settings = std::move(*values);
        }
        if (auto status = check_members(scene, order); !status) return status.error();
        order.limits = limits_;
        if (auto status = add_limits(scene, order.place, order.limits); !status)
            return status.error();
        return order;
    }

    /// Those of a scene replace those of the order one by one.
    static Status add_limits(const Json& json, const std::string& place, Json& limits) {
        const auto found = json.find("limits");
        if (found == json.end()) return Ok{};
        const auto read = read_limits(*found);
        if (!read) return read.error().in(place);
        limits.update(*read);
        return Ok{};
    }

    /// The settings of one kind: its own, and those of the scene that its command has.
    [[nodiscard]] Result<Json> settings_of(const Json& scene, const Kind& kind,
                                           const std::string& place) const {
        const Json& own = scene[kind.name];
        if (!own.is_object()) return wrong(place, kind.name, ": expected an object of settings");
        Json values = Json::object();
        for (const auto& [member, value] : scene.items())
            if (kind.table->find(member) != nullptr && !is_of_order(member)) values[member] = value;
        values.update(own);
        make_paths_absolute(*kind.table, folder_, values);
        const auto checked =
            settings::values_from_json(*kind.table, values, settings::Access::Service);
        if (!checked) return checked.error().in(str_cat(place, ".", kind.name));
        return values;
    }

    /// Every member is of the order or a setting of what is baked.
    static Status check_members(const Json& scene, const SceneOrder& order) {
        std::vector<std::string> known{"scene",  "name",      "limits",
                                       "probes", "lightmaps", "reflections"};
        bool has_any = false;
        for (const Kind& kind : kKinds) {
            if (!(order.*kind.settings)) continue;
            has_any = true;
            kind.table->for_each([&](const settings::Setting& setting) {
                if (setting.access == settings::Access::Service) known.emplace_back(setting.name);
            });
        }
        if (!has_any) {
            return Error{ErrorCode::InvalidArgument,
                         order.place +
                             ": asks for nothing; add \"probes\", \"lightmaps\" or "
                             "\"reflections\" with an object of settings"};
        }
        for (const auto& [member, value] : scene.items()) {
            if (std::ranges::find(known, member) != known.end()) continue;
            return wrong(order.place, member,
                         str_cat(": there is no such member", did_you_mean(member, known)));
        }
        return Ok{};
    }

    std::string path_;
    fs::path folder_;
    Json limits_ = Json::object();  ///< of all scenes
};

}  // namespace

Result<std::vector<SceneOrder>> read_order(const std::string& path) {
    if (path.ends_with(".json")) return OrderReader(path).read();
    SceneOrder order{path, fs::path(path).stem().string()};
    if (!is_name(order.name)) {
        return wrong(
            path, "order",
            str_cat(": \"", without_controls(order.name), "\" cannot begin the name of a file"));
    }
    const Json values{{"scene", fs::absolute(path).lexically_normal().string()}};
    for (const Kind& kind : kKinds) order.*kind.settings = values;
    order.is_by_scene = true;
    return std::vector{order};
}

}  // namespace tetralight::cli
