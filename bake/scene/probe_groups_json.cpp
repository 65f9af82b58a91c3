// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/probe_groups_json.h>

#include <charconv>
#include <exception>
#include <limits>
#include <new>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <system_error>

#include <tetralight/bake/scene/detail/error_field.h>
#include <tetralight/bake/scene/detail/json_members.h>
#include <tetralight/bake/scene/detail/probe_group_check.h>
#include <tetralight/base/file.h>
#include <tetralight/base/json/json_text.h>
#include <tetralight/base/json/json_visitor.h>
#include <tetralight/base/str_cat.h>

namespace tetralight {
namespace {

using detail::in_member;
using nlohmann::json;

/// Follows the parser, so that a syntax error names the group and the probe that it is in.
class ParsePlace : public JsonVisitor {
  public:
    bool start_object(size_t) override {
        if (depth_ == kGroupDepth) start_group();
        ++depth_;
        return true;
    }

    bool key(string_t& name) override {
        if (depth_ == kGroupDepth + 1) start_key(name);
        return true;
    }

    bool string(string_t& text) override {
        if (depth_ == kGroupDepth + 1 && key_ == "name") name_ = text;
        return true;
    }

    bool start_array(size_t) override {
        if (is_at_probe()) is_in_probe_ = true;
        ++depth_;
        return true;
    }

    bool end_array() override {
        --depth_;
        if (!is_at_probe()) return true;
        is_in_probe_ = false;
        ++probe_count_;
        return true;
    }

    bool end_object() override {
        --depth_;
        if (depth_ == kGroupDepth) is_in_group_ = false;
        return true;
    }

    /// The first key that a group has twice. The parser keeps the last value without an error.
    [[nodiscard]] const std::optional<Error>& duplicate_key() const { return duplicate_key_; }

    [[nodiscard]] Error located(Error error) const {
        if (!is_in_group_) return error;
        const size_t group = group_count_ - 1;
        if (is_in_probe_) {
            error = in_member(error.in(str_cat("probe ", probe_count_)),
                              str_cat(".positions[", probe_count_, "]"));
        }
        return in_member(error.in(detail::group_place(group, name_)),
                         str_cat("groups[", group, "]"));
    }

  private:
    /// The number of arrays and objects around a group.
    static constexpr int kGroupDepth = 2;

    [[nodiscard]] bool is_at_probe() const {
        return depth_ == kGroupDepth + 2 && key_ == "positions";
    }

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
        duplicate_key_ =
            located({ErrorCode::Corrupt, "." + key, "", str_cat("key \"", key, "\" stands twice")});
    }

    int depth_ = 0;
    std::optional<Error> duplicate_key_;
    std::set<std::string> keys_;
    bool is_in_group_ = false;
    bool is_in_probe_ = false;
    size_t group_count_ = 0;
    size_t probe_count_ = 0;
    std::string name_;
    std::string key_;
};

/// Returns corrupt: `NAME is not WANTED (VALUE)`. The field is that of the enclosing member.
Error not_wanted(const json& value, std::string_view name, std::string_view wanted) {
    Error error = detail::wrong_type(value, name, wanted);
    error.field.clear();
    return error;
}

Result<glm::dvec3> read_position(const json& value) {
    if (!value.is_array() || value.size() != 3) {
        return not_wanted(value, "position", "three numbers");
    }
    constexpr const char* kAxes[] = {"x", "y", "z"};
    glm::dvec3 position{};
    for (int axis = 0; axis < 3; ++axis) {
        const json& number = value[static_cast<size_t>(axis)];
        if (!number.is_number()) {
            return in_member(not_wanted(number, kAxes[axis], "a number").in("position"),
                             str_cat("[", axis, "]"));
        }
        position[axis] = number.get<double>();
    }
    return position;
}

Result<std::vector<glm::dvec3>> read_positions(const json& value) {
    if (!value.is_array()) return not_wanted(value, "positions", "an array");
    std::vector<glm::dvec3> positions;
    positions.reserve(value.size());
    for (const json& element : value) {
        const auto position = read_position(element);
        if (!position) {
            return in_member(position.error().in(str_cat("probe ", positions.size())),
                             str_cat("[", positions.size(), "]"));
        }
        positions.push_back(*position);
    }
    return positions;
}

Result<glm::dmat4> read_transform(const json& value) {
    if (!value.is_array() || value.size() != 16) {
        return not_wanted(value, "transform", "16 numbers");
    }
    glm::dmat4 transform{};
    for (int i = 0; i < 16; ++i) {
        const json& number = value[static_cast<size_t>(i)];
        if (!number.is_number()) {
            return in_member(not_wanted(number, str_cat("number ", i), "a number").in("transform"),
                             str_cat("[", i, "]"));
        }
        transform[i / 4][i % 4] = number.get<double>();
    }
    return transform;
}

Status read_optional_parts(const json& value, ProbeGroup& group) {
    if (const auto transform = value.find("transform"); transform != value.end()) {
        const auto world_from_group = read_transform(*transform);
        if (!world_from_group) return in_member(world_from_group.error(), ".transform");
        group.world_from_group = *world_from_group;
    }
    if (const auto dering = value.find("dering"); dering != value.end()) {
        if (!dering->is_boolean()) return detail::wrong_type(*dering, "dering", "a boolean");
        group.dering = dering->get<bool>();
    }
    if (const auto layers = value.find("rendering_layers"); layers != value.end()) {
        const auto mask = detail::read_rendering_layers(*layers, "rendering_layers");
        if (!mask) return mask.error();
        group.rendering_layers = *mask;
    }
    return Ok{};
}

Result<ProbeGroup> read_named_group(const json& value, std::string name) {
    const auto keys =
        detail::check_keys(value, {"name", "transform", "dering", "rendering_layers", "positions"});
    if (!keys) return keys.error();
    ProbeGroup group;
    group.name = std::move(name);
    const auto parts = read_optional_parts(value, group);
    if (!parts) return parts.error();
    const auto positions_value = value.find("positions");
    if (positions_value == value.end()) {
        return Error{ErrorCode::Corrupt, ".positions", "", "positions is missing"};
    }
    auto positions = read_positions(*positions_value);
    if (!positions) return in_member(positions.error(), ".positions");
    group.positions = std::move(*positions);
    return group;
}

Result<ProbeGroup> read_group(const json& value, size_t group_index) {
    const std::string place = str_cat("group ", group_index);
    if (!value.is_object()) return not_wanted(value, place + ":", "an object");
    const auto name = value.find("name");
    if (name == value.end()) {
        return Error{ErrorCode::Corrupt, ".name", "", place + ": name is missing"};
    }
    if (!name->is_string()) return detail::wrong_type(*name, "name", "a string").in(place);
    auto group = read_named_group(value, name->get<std::string>());
    if (!group) {
        return group.error().in(detail::group_place(group_index, name->get<std::string>()));
    }
    return group;
}

Result<std::vector<ProbeGroup>> read_groups(const json& document) {
    if (!document.is_object()) return Error{ErrorCode::Corrupt, "is not a JSON object"};
    const auto keys = detail::check_keys(document, {"groups"});
    if (!keys) return keys.error();
    const auto values = document.find("groups");
    if (values == document.end()) {
        return Error{ErrorCode::Corrupt, "groups", "", "groups is missing"};
    }
    if (!values->is_array()) return detail::wrong_type(*values, "groups", "an array");
    std::vector<ProbeGroup> groups;
    for (const json& value : *values) {
        auto group = read_group(value, groups.size());
        if (!group) return in_member(group.error(), str_cat("groups[", groups.size(), "]"));
        groups.push_back(std::move(*group));
    }
    const auto status = detail::check_probe_groups(groups);
    if (!status) return status.error();
    return groups;
}

/// Recognizes other files that are given by mistake.
Status check_first_bytes(std::string_view bytes) {
    if (bytes.starts_with("TETRAPV\n")) {
        return Error{ErrorCode::InvalidArgument, "is a probe volume, not a group file"};
    }
    if (bytes.starts_with("glTF")) {
        return Error{ErrorCode::InvalidArgument, "is a binary glTF scene; its extension is .glb"};
    }
    return Ok{};
}

Result<std::vector<ProbeGroup>> parse_groups(std::span<const std::byte> bytes) {
    if (bytes.size() > std::numeric_limits<uint32_t>::max()) {
        return Error{ErrorCode::Unsupported,
                     str_cat(bytes.size(), " bytes are too many for a group file")};
    }
    const std::string_view characters(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (auto status = check_first_bytes(characters); !status) return status.error();
    if (auto status = check_json_shape(characters); !status) return status.error();
    ParsePlace place;
    try {
        json::sax_parse(characters, &place);
        const json document = json::parse(characters);
        if (place.duplicate_key()) return *place.duplicate_key();
        return read_groups(document);
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const json::out_of_range& exception) {
        return place.located(
            {ErrorCode::Corrupt, "is not finite: " + json_error_reason(exception)});
    } catch (const std::exception& exception) {
        return place.located({ErrorCode::Corrupt, json_error_reason(exception)});
    }
}

}  // namespace

Result<std::vector<ProbeGroup>> read_probe_groups(const std::string& path) {
    const auto file = MappedFile::open(path);
    if (!file) return file.error();
    auto groups = parse_groups(file->bytes());
    if (!groups) return in_member(groups.error().in(path), "");
    for (ProbeGroup& group : *groups) {
        if (!group.positions.empty()) continue;
        group.empty_warning = str_cat(path, ": group \"", group.name, "\" has no probes");
    }
    return groups;
}

std::optional<size_t> probe_group_index(std::string_view field) {
    constexpr std::string_view kMember = "groups[";
    if (!field.starts_with(kMember)) return std::nullopt;
    size_t index = 0;
    const char* first = field.data() + kMember.size();
    const auto [end, error] = std::from_chars(first, field.data() + field.size(), index);
    if (error != std::errc() || end == first) return std::nullopt;
    return index;
}

}  // namespace tetralight
