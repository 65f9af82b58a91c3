// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/probe_groups_json.h>

#include <algorithm>
#include <exception>
#include <functional>
#include <initializer_list>
#include <new>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include <tetralight/bake/scene/detail/probe_group_check.h>
#include <tetralight/base/error_text.h>
#include <tetralight/base/file.h>
#include <tetralight/base/json/json_text.h>
#include <tetralight/base/str_cat.h>

namespace tetralight {
namespace {

using nlohmann::json;

/// Follows the parser, so that an error of syntax can name the group and the probe it is in.
class ParsePlace {
  public:
    bool operator()(int depth, json::parse_event_t event, const json& parsed) {
        using Event = json::parse_event_t;
        if (event == Event::object_start && depth == kGroupDepth) start_group();
        if (event == Event::key && depth == kGroupDepth + 1) start_key(parsed.get<std::string>());
        if (event == Event::value && depth == kGroupDepth + 1 && key_ == "name") {
            if (parsed.is_string()) name_ = parsed.get<std::string>();
        }
        if (event == Event::array_start && depth == kGroupDepth + 2 && key_ == "positions") {
            is_in_probe_ = true;
        }
        if (event == Event::array_end && depth == kGroupDepth + 2 && key_ == "positions") {
            is_in_probe_ = false;
            ++probe_count_;
        }
        if (event == Event::object_end && depth == kGroupDepth) is_in_group_ = false;
        return true;
    }

    /// The first key that a group has twice; the parser keeps only the last one and says nothing.
    [[nodiscard]] const std::optional<Error>& duplicate_key() const { return duplicate_key_; }

    [[nodiscard]] Error located(Error error) const {
        if (!is_in_group_) return error;
        if (is_in_probe_) error = error.in(str_cat("probe ", probe_count_));
        return error.in(detail::group_place(group_count_ - 1, name_));
    }

  private:
    static constexpr int kGroupDepth = 2;

    void start_group() {
        is_in_group_ = true;
        ++group_count_;
        name_.clear();
        key_.clear();
        probe_count_ = 0;
        keys_.clear();
    }

    void start_key(const std::string& key) {
        key_ = key;
        if (keys_.insert(key).second || duplicate_key_) return;
        duplicate_key_ = located(Error{str_cat("key \"", key, "\" stands twice")});
    }

    std::optional<Error> duplicate_key_;
    std::set<std::string> keys_;
    bool is_in_group_ = false;
    bool is_in_probe_ = false;
    size_t group_count_ = 0;
    size_t probe_count_ = 0;
    std::string name_;
    std::string key_;
};

/// A value as messages show it.
std::string shown(const json& value) {
    constexpr size_t kLongest = 40;
    const std::string dumped = value.dump();
    return dumped.size() <= kLongest ? dumped : dumped.substr(0, kLongest) + "...";
}

Result<double> read_number(const json& value) {
    if (!value.is_number()) return Error{str_cat("is not a number (", shown(value), ")")};
    return value.get<double>();
}

Result<glm::dvec3> read_position(const json& value) {
    if (!value.is_array() || value.size() != 3) {
        return Error{str_cat("position is not three numbers (", shown(value), ")")};
    }
    constexpr const char* kAxes[] = {"x", "y", "z"};
    glm::dvec3 position{};
    for (int axis = 0; axis < 3; ++axis) {
        const auto number = read_number(value[static_cast<size_t>(axis)]);
        if (!number)
            return Error{str_cat("position: ", kAxes[axis], " ", error_text(number.error()))};
        position[axis] = *number;
    }
    return position;
}

Result<std::vector<glm::dvec3>> read_positions(const json& value) {
    if (!value.is_array()) return Error{str_cat("positions is not an array (", shown(value), ")")};
    std::vector<glm::dvec3> positions;
    positions.reserve(value.size());
    for (const json& element : value) {
        const auto position = read_position(element);
        if (!position) return position.error().in(str_cat("probe ", positions.size()));
        positions.push_back(*position);
    }
    return positions;
}

Result<glm::dmat4> read_transform(const json& value) {
    if (!value.is_array() || value.size() != 16) {
        return Error{str_cat("transform is not 16 numbers (", shown(value), ")")};
    }
    glm::dmat4 transform{};
    for (int i = 0; i < 16; ++i) {
        const auto number = read_number(value[static_cast<size_t>(i)]);
        if (!number)
            return Error{str_cat("transform: number ", i, " ", error_text(number.error()))};
        transform[i / 4][i % 4] = *number;
    }
    return transform;
}

Status check_keys(const json& object, std::initializer_list<std::string_view> known) {
    for (const auto& [key, value] : object.items()) {
        if (std::find(known.begin(), known.end(), key) == known.end()) {
            return Error{str_cat("unknown key \"", key, "\"")};
        }
    }
    return Ok{};
}

Status read_optional_parts(const json& value, ProbeGroup& group) {
    if (const auto transform = value.find("transform"); transform != value.end()) {
        const auto world_from_group = read_transform(*transform);
        if (!world_from_group) return world_from_group.error();
        group.world_from_group = *world_from_group;
    }
    if (const auto dering = value.find("dering"); dering != value.end()) {
        if (!dering->is_boolean())
            return Error{str_cat("dering is not a boolean (", shown(*dering), ")")};
        group.dering = dering->get<bool>();
    }
    return Ok{};
}

Result<ProbeGroup> read_named_group(const json& value, std::string name) {
    const auto keys = check_keys(value, {"name", "transform", "dering", "positions"});
    if (!keys) return keys.error();
    ProbeGroup group;
    group.name = std::move(name);
    const auto parts = read_optional_parts(value, group);
    if (!parts) return parts.error();
    const auto positions_value = value.find("positions");
    if (positions_value == value.end()) return Error{"positions is missing"};
    auto positions = read_positions(*positions_value);
    if (!positions) return positions.error();
    group.positions = std::move(*positions);
    return group;
}

Result<ProbeGroup> read_group(const json& value, size_t group_index) {
    const std::string place = str_cat("group ", group_index);
    if (!value.is_object()) return Error{str_cat(place, ": is not an object (", shown(value), ")")};
    const auto name = value.find("name");
    if (name == value.end()) return Error{place + ": name is missing"};
    if (!name->is_string()) {
        return Error{str_cat(place, ": name is not a string (", shown(*name), ")")};
    }
    auto group = read_named_group(value, name->get<std::string>());
    if (!group) {
        return group.error().in(detail::group_place(group_index, name->get<std::string>()));
    }
    return group;
}

Result<std::vector<ProbeGroup>> read_document(const json& document) {
    if (!document.is_object()) return Error{"is not a JSON object"};
    const auto keys = check_keys(document, {"groups"});
    if (!keys) return keys.error();
    const auto values = document.find("groups");
    if (values == document.end()) return Error{"groups is missing"};
    if (!values->is_array()) return Error{str_cat("groups is not an array (", shown(*values), ")")};
    std::vector<ProbeGroup> groups;
    for (const json& value : *values) {
        auto group = read_group(value, groups.size());
        if (!group) return group.error();
        groups.push_back(std::move(*group));
    }
    const auto status = detail::check_probe_groups(groups);
    if (!status) return status.error();
    return groups;
}

/// Files of ours that were given for a group file by mistake.
Status check_first_bytes(std::string_view bytes) {
    if (bytes.starts_with("TETRAPV\n")) return Error{"is a probe volume, not a group file"};
    if (bytes.starts_with("glTF")) return Error{"is a binary glTF scene; its extension is .glb"};
    return Ok{};
}

Result<std::vector<ProbeGroup>> parse_groups(std::span<const std::byte> bytes) {
    const std::string_view characters(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (auto status = check_first_bytes(characters); !status) return status.error();
    if (auto status = check_json_depth(characters); !status) return status.error();
    ParsePlace place;
    try {
        const json document = json::parse(characters, std::ref(place));
        if (place.duplicate_key()) return *place.duplicate_key();
        return read_document(document);
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const json::out_of_range& exception) {
        return place.located(Error{"is not finite: " + json_error_reason(exception)});
    } catch (const std::exception& exception) {
        return place.located(Error{json_error_reason(exception)});
    }
}

}  // namespace

Result<std::vector<ProbeGroup>> read_probe_groups(const std::string& path) {
    const auto file = MappedFile::open(path);
    if (!file) return file.error();
    auto groups = parse_groups(file->bytes());
    if (!groups) return groups.error().in(path);
    return groups;
}

}  // namespace tetralight
