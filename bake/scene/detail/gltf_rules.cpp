// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/gltf_rules.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <span>

#include <tetralight/bake/scene/detail/error_field.h>
#include <tetralight/bake/scene/detail/gltf_document.h>
#include <tetralight/bake/scene/detail/gltf_extension_table.h>
#include <tetralight/bake/scene/detail/gltf_schema.h>
#include <tetralight/bake/scene/detail/json_members.h>
#include <tetralight/base/str_cat.h>

namespace tetralight::detail {
namespace {

using nlohmann::json;

/// Checks elements against rules. It needs the document for the number of elements that an index
/// may name.
class Checker {
  public:
    explicit Checker(const json& document) : document_(document) {}

    [[nodiscard]] Status check_sections() const {
        if (auto status = check_extensions(document_, ""); !status)
            return in_member(status.error(), "");
        for (const GltfSection& section : gltf_sections()) {
            if (auto status = check_parent(section.path); !status) return status;
            const json* elements = find_json(document_, section.path);
            if (elements == nullptr) continue;
            if (!elements->is_array()) return type_error(*elements, section.path, "an array");
            const auto status = check_elements(*elements, section.element, section.rules);
            if (!status) return in_member(status.error(), member_path(section.path));
        }
        return Ok{};
    }

  private:
    /// `WANTED` is the type that the value at a path of the document should have.
    [[nodiscard]] static Error type_error(const json& value, std::string_view path,
                                          std::string_view wanted) {
        Error error = wrong_type(value, path.substr(path.rfind('/') + 1), wanted);
        error.field = member_path(path);
        return error;
    }

    /// The extension that a section lies in is an object, if the document has it.
    [[nodiscard]] Status check_parent(std::string_view path) const {
        const size_t slash = path.rfind('/');
        if (slash == std::string_view::npos) return Ok{};
        const std::string_view parent_path = path.substr(0, slash);
        const json* parent = find_json(document_, parent_path);
        if (parent == nullptr || parent->is_object()) return Ok{};
        return type_error(*parent, parent_path, "an object");
    }

    [[nodiscard]] Status check_elements(const json& elements, const char* kind,
                                        std::span<const GltfRule> rules) const {
        for (size_t i = 0; i < elements.size(); ++i) {
            const auto status = check_element(elements[i], rules);
            if (status) continue;
            const json* name = find_json(elements[i], "name");
            const bool has_name = name != nullptr && name->is_string();
            const std::string place =
                gltf_place(kind, i, has_name ? name->get<std::string>() : std::string());
            return in_member(status.error().in(place), str_cat("[", i, "]"));
        }
        return Ok{};
    }

    [[nodiscard]] Status check_element(const json& element, std::span<const GltfRule> rules) const {
        if (element.is_object()) return check_rules(element, rules, "");
        return Error{ErrorCode::Corrupt, "", shown_json(element),
                     str_cat("is not an object (", shown_json(element), ")")};
    }

    /// `prefix` is the path of the object in its element: "" or ends in '/'.
    [[nodiscard]] Status check_rules(const json& object, std::span<const GltfRule> rules,
                                     const std::string& prefix) const {
        if (auto status = check_extensions(object, prefix); !status) return status;
        for (const GltfRule& rule : rules) {
            const auto status = check_rule(object, rule, prefix);
            if (!status) return status;
        }
        return Ok{};
    }

    /// An object's extensions, and those of them that are known, are objects.
    [[nodiscard]] static Status check_extensions(const json& object, const std::string& prefix) {
        const auto extensions = object.find("extensions");
        if (extensions == object.end()) return Ok{};
        const std::string name = prefix + "extensions";
        if (!extensions->is_object()) return checked(false, *extensions, name, "an object");
        for (const auto& [key, value] : extensions->items()) {
            if (value.is_object() || find_gltf_extension(key) == nullptr) continue;
            return checked(false, value, str_cat(name, "/", key), "an object");
        }
        return Ok{};
    }

    [[nodiscard]] Status check_rule(const json& object, const GltfRule& rule,
                                    const std::string& prefix) const {
        const std::string_view path = rule.path;
        const size_t slash = path.rfind('/');
        const bool is_nested = slash != std::string_view::npos;
        const json* parent = is_nested ? find_json(object, path.substr(0, slash)) : &object;
        if (parent == nullptr) return Ok{};
        if (!parent->is_object()) {
            if (path.substr(0, slash) == "extras") return Ok{};  // extras may be any JSON
            if (rule.need == GltfNeed::InObject) return Ok{};
            return checked(false, *parent, str_cat(prefix, path.substr(0, slash)), "an object");
        }
        const std::string_view key = is_nested ? path.substr(slash + 1) : path;
        const std::string name = str_cat(prefix, path);
        const auto value = parent->find(std::string(key));
        if (value != parent->end()) return check_value(*value, rule, name);
        if (rule.need != GltfNeed::Required) return Ok{};
        return Error{ErrorCode::Corrupt, "." + member_path(name), "", str_cat(name, " is missing")};
    }

    /// `name` is the path of the value in its element, as messages show it.
    [[nodiscard]] Status check_value(const json& value, const GltfRule& rule,
                                     const std::string& name) const {
        switch (rule.kind) {
            case GltfKind::Index:
                return check_index(value, rule, name);
            case GltfKind::IndexList:
                return check_indices(value, value.is_array(), rule, name);
            case GltfKind::IndexLists:
                return check_index_lists(value, rule, name);
            case GltfKind::IndexMap:
                return check_indices(value, value.is_object(), rule, name);
            case GltfKind::IndexMapList:
                return check_each(value, name, [&](const json& map, const std::string& place) {
                    return check_indices(map, map.is_object(), rule, place);
                });
            case GltfKind::Size:
                return check_size(value, name);
            case GltfKind::SizeMap:
                return check_sizes(value, name);
            case GltfKind::Integer:
                return check_integer(value, name);
            case GltfKind::Numbers:
                return check_numbers(value, rule, name);
            case GltfKind::NumbersList:
                return check_each(value, name, [&](const json& numbers, const std::string& place) {
                    return check_numbers(numbers, rule, place);
                });
            case GltfKind::Number:
                return checked(value.is_number(), value, name, "a number");
            case GltfKind::Boolean:
                return checked(value.is_boolean(), value, name, "a boolean");
            case GltfKind::BooleanOrBit:
                return checked(is_boolean_or_bit(value), value, name, "a boolean");
            case GltfKind::String:
                return checked(value.is_string(), value, name, "a string");
            case GltfKind::Object:
                return checked(value.is_object(), value, name, "an object");
            case GltfKind::ObjectOrBoolean:
                return checked(value.is_object() || is_boolean_or_bit(value), value, name,
                               "an object or a boolean");
            case GltfKind::Part:
                return check_part(value, rule, name);
            case GltfKind::Parts:
                return check_parts(value, rule, name);
            case GltfKind::RenderingLayers:
                return check_rendering_layers(value, name);
        }
        return Ok{};
    }

    [[nodiscard]] static bool is_boolean_or_bit(const json& value) {
        return value.is_boolean() || value == 0 || value == 1;
    }

    /// Checks each element of an array; `check` takes the element and its name.
    template <class Check>
    [[nodiscard]] static Status check_each(const json& value, const std::string& name,
                                           Check check) {
        if (!value.is_array()) return checked(false, value, name, "an array");
        for (size_t i = 0; i < value.size(); ++i) {
            const Status status = check(value[i], str_cat(name, "[", i, "]"));
            if (!status) return status;
        }
        return Ok{};
    }

    [[nodiscard]] static Status check_rendering_layers(const json& value, std::string_view name) {
        const auto mask = read_rendering_layers(value, name);
        if (mask) return Ok{};
        Error error = mask.error();
        error.field = "." + member_path(name);
        return error;
    }

    [[nodiscard]] Status check_part(const json& value, const GltfRule& rule,
                                    const std::string& name) const {
        if (!value.is_object()) return checked(false, value, name, "an object");
        return check_rules(value, gltf_part(rule.target).rules, name + "/");
    }

    [[nodiscard]] Status check_parts(const json& value, const GltfRule& rule,
                                     std::string_view name) const {
        if (!value.is_array()) return checked(false, value, name, "an array");
        const GltfPart& part = gltf_part(rule.target);
        const auto status = check_elements(value, part.element, part.rules);
        if (status) return status;
        return in_member(status.error(), "." + member_path(name));
    }

    [[nodiscard]] static Status checked(bool is_right, const json& value, std::string_view name,
                                        std::string_view wanted) {
        if (is_right) return Ok{};
        Error error = wrong_type(value, name, wanted);
        error.field = "." + member_path(name);
        return error;
    }

    [[nodiscard]] size_t target_count(std::string_view target) const {
        for (const GltfSection& section : gltf_sections()) {
            if (target != section.name) continue;
            const json* elements = find_json(document_, section.path);
            return elements != nullptr && elements->is_array() ? elements->size() : 0;
        }
        return 0;
    }

    [[nodiscard]] Status check_index(const json& value, const GltfRule& rule,
                                     std::string_view name) const {
        if (!value.is_number_integer()) return checked(false, value, name, "an index");
        const size_t count = target_count(rule.target);
        if (value.is_number_unsigned() && value.get<uint64_t>() < count) return Ok{};
        return Error{ErrorCode::Corrupt, "." + member_path(name), shown_json(value),
                     str_cat(name, " ", shown_json(value), " is out of range (", count, " ",
                             rule.target, ")")};
    }

    [[nodiscard]] Status check_indices(const json& values, bool is_right_container,
                                       const GltfRule& rule, std::string_view name) const {
        if (!is_right_container) return checked(false, values, name, "a list of indices");
        for (const auto& [key, value] : values.items()) {
            const bool is_array = values.is_array();
            const auto status = check_index(
                value, rule, is_array ? str_cat(name, "[", key, "]") : str_cat(name, " ", key));
            if (status) continue;
            Error error = status.error();
            error.field = "." + member_path(name) + (is_array ? str_cat("[", key, "]") : "." + key);
            return error;
        }
        return Ok{};
    }

    [[nodiscard]] Status check_index_lists(const json& value, const GltfRule& rule,
                                           const std::string& name) const {
        return check_each(value, name, [&](const json& indices, const std::string& place) {
            if (indices.is_array() && indices.size() == rule.length) {
                return check_indices(indices, true, rule, place);
            }
            return checked(false, indices, place, str_cat("a list of ", rule.length, " indices"));
        });
    }

    [[nodiscard]] static Status check_size(const json& value, std::string_view name) {
        constexpr uint64_t kLargest = std::numeric_limits<uint32_t>::max();
        const bool is_size = value.is_number_unsigned() && value.get<uint64_t>() <= kLargest;
        return checked(is_size, value, name, "an integer from 0 to 4294967295");
    }

    [[nodiscard]] static Status check_sizes(const json& value, std::string_view name) {
        if (!value.is_object()) return checked(false, value, name, "an object");
        for (const auto& [key, size] : value.items()) {
            const auto status = check_size(size, str_cat(name, "/", key));
            if (!status) return status;
        }
        return Ok{};
    }

    [[nodiscard]] static Status check_integer(const json& value, std::string_view name) {
        return checked(read_int32(value).has_value(), value, name,
                       "an integer from -2147483648 to 2147483647");
    }

    [[nodiscard]] static Status check_numbers(const json& value, const GltfRule& rule,
                                              std::string_view name) {
        const bool is_right =
            value.is_array() && (rule.length == 0 || value.size() == rule.length) &&
            std::ranges::all_of(value, [](const json& number) { return number.is_number(); });
        const std::string count = rule.length == 0 ? "" : str_cat(rule.length, " ");
        return checked(is_right, value, name, str_cat("an array of ", count, "numbers"));
    }

    const json& document_;
};

}  // namespace

const json* find_json(const json& value, std::string_view path) {
    const json* found = &value;
    while (!path.empty()) {
        if (!found->is_object()) return nullptr;
        const size_t length = std::min(path.find('/'), path.size());
        const auto part = found->find(std::string(path.substr(0, length)));
        if (part == found->end()) return nullptr;
        found = &*part;
        path.remove_prefix(std::min(length + 1, path.size()));
    }
    return found;
}

Status check_gltf_sections(const json& document) {
    return Checker(document).check_sections();
}

}  // namespace tetralight::detail
