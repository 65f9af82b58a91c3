// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/gltf_unknown_extras.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include <tetralight/bake/scene/detail/gltf_document.h>
#include <tetralight/bake/scene/detail/gltf_members.h>
#include <tetralight/bake/scene/detail/gltf_rules.h>
#include <tetralight/bake/scene/detail/gltf_schema.h>
#include <tetralight/bake/scene/detail/meant_name.h>
#include <tetralight/base/str_cat.h>

namespace tetralight::detail {
namespace {

using nlohmann::json;
using Names = std::vector<std::string>;

/// The extras that elements of a section have, or the members of one of these extras.
struct KnownExtras {
    /// As messages write them: "extras of nodes".
    const char* place;
    const char* section;
    /// The path of the object in the element.
    const char* path;
    Names names;
};

/// Words that many programs use: on another kind of element they are theirs.
constexpr std::string_view kCommonWords[] = {"mode",  "shape",  "radius", "angle",
                                             "width", "height", "sky",    "portal"};

const Names& light_extras() {
    static const Names kNames{"mode",   "falloff", "shape", "indirect_multiplier",
                              "radius", "angle",   "width", "height"};
    return kNames;
}

const std::vector<KnownExtras>& known_extras() {
    static const std::vector<KnownExtras> kKnown = [] {
        Names of_nodes{
            "contribute_gi",     "walkable",         "in_reflections",   "receive_gi",
            "lightmap_scale",    "stitch_seams",     "light_probes",     "probe_anchor",
            "light_probe_group", "dering",           "rendering_layers", "probe_adjustment",
            "probe_resolution",  "reflection_probe", "portal",           "lightmap_rectangle"};
        of_nodes.insert(of_nodes.end(), light_extras().begin(), light_extras().end());
        return std::vector<KnownExtras>{
            {"nodes", "nodes", "extras", of_nodes},
            {"lights", "lights", "extras", light_extras()},
            {"lights", "area lights", "extras", light_extras()},
            {"materials", "materials", "extras", {"bake_emission"}},
            {"scenes", "scenes", "extras", {"sky"}},
            {"image-based lights", "image-based lights", "extras", {"sky"}},
            {"extras.sky", "scenes", "extras/sky", {"radiance"}},
            {"extras.probe_adjustment",
             "nodes",
             "extras/probe_adjustment",
             {"shape", "size", "radius", "forbid", "spacing", "validity", "intensity",
              "rendering_layers"}},
            {"extras.reflection_probe",
             "nodes",
             "extras/reflection_probe",
             {"size", "center", "blend_distance", "importance", "near"}},
        };
    }();
    return kKnown;
}

bool contains(std::span<const std::string> names, std::string_view name) {
    return std::ranges::find(names, name) != names.end();
}

bool is_common_word(std::string_view word) {
    return std::ranges::find(kCommonWords, word) != std::end(kCommonWords);
}

/// The kind of elements that have extras of this name, if they are others than `section`.
const KnownExtras* other_place(std::string_view word, const json& value, std::string_view section) {
    const bool is_sky = word == "sky" && value.is_object() && value.contains("radiance");
    if (is_common_word(word) && !is_sky) return nullptr;
    for (const KnownExtras& known : known_extras()) {
        const bool is_whole = std::string_view(known.path) == "extras";
        if (is_whole && section != known.section && contains(known.names, word)) return &known;
    }
    return nullptr;
}

/// Extras of nodes that mean nothing without a light or a probe group.
struct OwnedExtras {
    const char* owner;
    Names names;
    bool (*has_owner)(const json& node);
};

bool has_light(const json& node) {
    return find_json(node, "extensions/KHR_lights_punctual/light") != nullptr ||
           find_json(node, "extensions/EXT_lights_area/light") != nullptr;
}

bool is_probe_group(const json& node) {
    return boolean_at(node, "extras/light_probe_group").value_or(false);
}

const std::vector<OwnedExtras>& owned_extras() {
    static const std::vector<OwnedExtras> kOwned{
        {"nodes with a light", light_extras(), has_light},
        {"probe groups", {"dering", "rendering_layers", "probe_resolution"}, is_probe_group}};
    return kOwned;
}

/// What a node lacks that its extras of this name are about; null if it has all.
const char* missing_owner(std::string_view word, const json& node) {
    for (const OwnedExtras& owned : owned_extras()) {
        if (contains(owned.names, word) && !owned.has_owner(node)) return owned.owner;
    }
    return nullptr;
}

/// The names of a node's extras that mean something.
Names without_owned(Names names, const json& node) {
    std::erase_if(names, [&](const std::string& name) { return missing_owner(name, node); });
    return names;
}

void add_misspelt(const std::string& name, const std::string& near, const std::string& element,
                  PartList& parts) {
    parts.add({PartUse::Ignored,
               str_cat("extras \"", name, "\""),
               0,
               {},
               "is no name that Tetralight reads",
               str_cat("did you mean \"", near, "\"?"),
               true},
              element);
}

void add_misplaced(const std::string& name, const char* place, const std::string& remedy,
                   const std::string& element, PartList& parts) {
    parts.add({PartUse::Ignored,
               str_cat("extras \"", name, "\""),
               0,
               {},
               str_cat("is read of ", place, " only"),
               remedy,
               true},
              element);
}

/// The names that extras of an element of a section may have.
Names names_of(std::string_view section, const json& element) {
    const auto known = std::ranges::find_if(known_extras(), [&](const KnownExtras& place) {
        return section == place.section && std::string_view(place.path) == "extras";
    });
    if (known == known_extras().end()) return {};
    return section == "nodes" ? without_owned(known->names, element) : known->names;
}

/// Extras of elements of any section; "" is the file itself.
void add_extras(std::string_view section, const json& element, const std::string& place,
                PartList& parts) {
    const json* extras = find_json(element, "extras");
    if (extras == nullptr || !extras->is_object()) return;
    const Names names = names_of(section, element);
    for (const auto& [name, value] : extras->items()) {
        if (contains(names, name)) continue;
        const char* owner = section == "nodes" ? missing_owner(name, element) : nullptr;
        if (owner != nullptr && !is_common_word(name)) {
            add_misplaced(name, owner, "", place, parts);
        } else if (const KnownExtras* other = other_place(name, value, section)) {
            add_misplaced(name, other->place, str_cat("move it to the extras of ", other->place),
                          place, parts);
        } else if (const std::string near = meant_name(name, names); !near.empty()) {
            add_misspelt(name, near, place, parts);
        } else {
            parts.add_left_out("other extras", "belong to the program that wrote the file", false,
                               str_cat(place, ": ", name));
        }
    }
}

/// Members of extras that Tetralight defines, none of which belong to another program.
void add_members(const KnownExtras& known, const json& object, const std::string& element,
                 PartList& parts) {
    for (const auto& [name, value] : object.items()) {
        if (contains(known.names, name)) continue;
        const std::string near = meant_name(name, known.names);
        parts.add({PartUse::Ignored,
                   str_cat(known.place, " \"", name, "\""),
                   0,
                   {},
                   "is no member that Tetralight reads",
                   near.empty() ? "docs/scenes.md lists the members"
                                : str_cat("did you mean \"", near, "\"?"),
                   true},
                  element);
    }
}

}  // namespace

void add_unknown_extras(const json& source, PartList& parts) {
    add_extras("", source, "the file", parts);
    for_each_element(
        source, [&](const GltfSection& section, const json& element, const std::string& place) {
            add_extras(section.name, element, place, parts);
            for (const KnownExtras& known : known_extras()) {
                if (std::string_view(known.section) != section.name) continue;
                if (std::string_view(known.path) == "extras") continue;
                const json* object = find_json(element, known.path);
                if (object != nullptr && object->is_object()) {
                    add_members(known, *object, place, parts);
                }
            }
        });
}

bool is_extras_name(std::string_view section, std::string_view name) {
    if (section == "nodes" && is_common_word(name)) return false;
    return std::ranges::any_of(known_extras(), [&](const KnownExtras& known) {
        const bool is_whole = std::string_view(known.path) == "extras";
        return is_whole && section == known.section && contains(known.names, name);
    });
}

}  // namespace tetralight::detail
