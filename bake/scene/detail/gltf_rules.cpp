// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/gltf_rules.h>

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <span>

#include <tetralight/bake/scene/detail/gltf_document.h>
#include <tetralight/bake/scene/detail/gltf_schema.h>
#include <tetralight/base/str_cat.h>

namespace tetralight::detail {
namespace {

using nlohmann::json;

/// Checks elements against rules; needs the document to know how many targets there are.
class Checker {
  public:
    explicit Checker(const json& document) : document_(document) {}

    [[nodiscard]] Status check_sections() const {
        for (const GltfSection& section : gltf_sections()) {
            const json* elements = find_json(document_, section.path);
            if (elements == nullptr) continue;
            if (!elements->is_array()) {
                return Error{
                    str_cat(section.name, " is not an array (", shown_json(*elements), ")")};
            }
            const auto status = check_elements(*elements, section.element, section.rules);
            if (!status) return status;
        }
        return Ok{};
    }

  private:
    [[nodiscard]] Status check_elements(const json& elements, const char* kind,
                                        std::span<const GltfRule> rules) const {
        for (size_t i = 0; i < elements.size(); ++i) {
            const auto status = check_element(elements[i], rules);
            if (status) continue;
            const json* name = find_json(elements[i], "name");
            const bool has_name = name != nullptr && name->is_string();
            return status.error().in(
                gltf_place(kind, i, has_name ? name->get<std::string>() : std::string()));
        }
        return Ok{};
    }

    [[nodiscard]] Status check_element(const json& element, std::span<const GltfRule> rules) const {
        if (!element.is_object())
            return Error{str_cat("is not an object (", shown_json(element), ")")};
        for (const GltfRule& rule : rules) {
            const auto status = check_rule(element, rule);
            if (!status) return status;
        }
        return Ok{};
    }

    [[nodiscard]] Status check_rule(const json& element, const GltfRule& rule) const {
        const std::string_view path = rule.path;
        const size_t slash = path.rfind('/');
        const bool is_nested = slash != std::string_view::npos;
        const json* parent = is_nested ? find_json(element, path.substr(0, slash)) : &element;
        if (parent == nullptr) return Ok{};
        if (!parent->is_object()) {
            if (path.substr(0, slash) == "extras") return Ok{};  // anything may stand there
            return Error{
                str_cat(path.substr(0, slash), " is not an object (", shown_json(*parent), ")")};
        }
        const std::string_view key = is_nested ? path.substr(slash + 1) : path;
        const auto value = parent->find(std::string(key));
        if (value != parent->end()) return check_value(*value, rule, str_cat(path));
        if (rule.need == GltfNeed::Optional) return Ok{};
        return Error{str_cat(path, " is missing")};
    }

    [[nodiscard]] Status check_value(const json& value, const GltfRule& rule,
                                     const std::string& name) const {
        switch (rule.kind) {
            case GltfKind::Index:
                return check_index(value, rule, name);
            case GltfKind::IndexList:
                return check_indices(value, value.is_array(), rule, name);
            case GltfKind::IndexMap:
                return check_indices(value, value.is_object(), rule, name);
            case GltfKind::Size:
                return check_size(value, name);
            case GltfKind::Numbers:
                return check_numbers(value, rule, name);
            case GltfKind::Number:
                return checked(value.is_number(), value, name, "a number");
            case GltfKind::Boolean:
                return checked(value.is_boolean(), value, name, "a boolean");
            case GltfKind::String:
                return checked(value.is_string(), value, name, "a string");
            case GltfKind::Object:
                return checked(value.is_object(), value, name, "an object");
            case GltfKind::PrimitiveList:
                return check_primitives(value, name);
        }
        return Ok{};
    }

    [[nodiscard]] Status check_primitives(const json& value, const std::string& name) const {
        if (!value.is_array()) return checked(false, value, name, "an array");
        return check_elements(value, "primitive", gltf_primitive_rules());
    }

    [[nodiscard]] static Status checked(bool is_right, const json& value, const std::string& name,
                                        const char* wanted) {
        if (is_right) return Ok{};
        return Error{str_cat(name, " is not ", wanted, " (", shown_json(value), ")")};
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
                                     const std::string& name) const {
        if (!value.is_number_integer()) return checked(false, value, name, "an index");
        const size_t count = target_count(rule.target);
        if (value.is_number_unsigned() && value.get<uint64_t>() < count) return Ok{};
        return Error{str_cat(name, " ", shown_json(value), " is out of range (", count, " ",
                             rule.target, ")")};
    }

    [[nodiscard]] Status check_indices(const json& values, bool is_right_container,
                                       const GltfRule& rule, const std::string& name) const {
        if (!is_right_container) return checked(false, values, name, "a list of indices");
        for (const auto& [key, value] : values.items()) {
            const auto status = check_index(value, rule, str_cat(name, " ", key));
            if (!status) return status;
        }
        return Ok{};
    }

    [[nodiscard]] static Status check_size(const json& value, const std::string& name) {
        constexpr uint64_t kLargest = std::numeric_limits<uint32_t>::max();
        const bool is_size = value.is_number_unsigned() && value.get<uint64_t>() <= kLargest;
        return checked(is_size, value, name, "an integer from 0 to 4294967295");
    }

    [[nodiscard]] static Status check_numbers(const json& value, const GltfRule& rule,
                                              const std::string& name) {
        const bool is_right = value.is_array() && value.size() == rule.length &&
                              std::all_of(value.begin(), value.end(),
                                          [](const json& number) { return number.is_number(); });
        return checked(is_right, value, name,
                       str_cat("an array of ", rule.length, " numbers").c_str());
    }

    const json& document_;
};

}  // namespace

std::string shown_json(const json& value) {
    constexpr size_t kLongest = 40;
    const std::string dumped = value.dump();
    return dumped.size() <= kLongest ? dumped : dumped.substr(0, kLongest) + "...";
}

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
