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

const std::vector<KnownExtras>& known_extras() {
    static const Names kOfLights{"mode",   "falloff", "shape", "indirect_multiplier",
                                 "radius", "angle",   "width", "height"};
    static const std::vector<KnownExtras> kKnown = [] {
        Names of_nodes{"contribute_gi",     "walkable",     "in_reflections",    "receive_gi",
                       "lightmap_scale",    "stitch_seams", "light_probes",      "probe_anchor",
                       "light_probe_group", "dering",       "rendering_layers",  "probe_adjustment",
                       "reflection_probe",  "portal",       "lightmap_rectangle"};
        of_nodes.insert(of_nodes.end(), kOfLights.begin(), kOfLights.end());
        return std::vector<KnownExtras>{
            {"nodes", "nodes", "extras", of_nodes},
            {"lights", "lights", "extras", kOfLights},
            {"lights", "area lights", "extras", kOfLights},
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

/// The kind of elements that have extras of this name, if they are others than `section`.
const KnownExtras* other_place(std::string_view word, std::string_view section) {
    if (std::ranges::find(kCommonWords, word) != std::end(kCommonWords)) return nullptr;
    for (const KnownExtras& known : known_extras()) {
        const bool is_whole = std::string_view(known.path) == "extras";
        if (is_whole && section != known.section && contains(known.names, word)) return &known;
    }
    return nullptr;
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

/// Extras of elements of any section.
void add_extras(const GltfSection& section, const json& extras, const std::string& element,
                PartList& parts) {
    const auto known = std::ranges::find_if(known_extras(), [&](const KnownExtras& place) {
        return std::string_view(place.section) == section.name &&
               std::string_view(place.path) == "extras";
    });
    static const Names kNone;
    const Names& names = known == known_extras().end() ? kNone : known->names;
    for (const auto& [name, value] : extras.items()) {
        if (contains(names, name)) continue;
        if (const KnownExtras* other = other_place(name, section.name)) {
            parts.add({PartUse::Ignored,
                       str_cat("extras \"", name, "\""),
                       0,
                       {},
                       str_cat("is read of ", other->place, " only"),
                       str_cat("move it to the extras of ", other->place),
                       true},
                      element);
        } else if (const std::string near = meant_name(name, names); !near.empty()) {
            add_misspelt(name, near, element, parts);
        } else {
            parts.add({PartUse::Ignored,
                       "other extras",
                       0,
                       {},
                       "belong to the program that wrote the file",
                       "",
                       false},
                      str_cat(element, ": ", name));
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
    for_each_element(
        source, [&](const GltfSection& section, const json& element, const std::string& place) {
            const json* extras = find_json(element, "extras");
            if (extras == nullptr || !extras->is_object()) return;
            add_extras(section, *extras, place, parts);
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
    if (std::ranges::find(kCommonWords, name) != std::end(kCommonWords)) return false;
    return std::ranges::any_of(known_extras(), [&](const KnownExtras& known) {
        const bool is_whole = std::string_view(known.path) == "extras";
        return is_whole && section == known.section && contains(known.names, name);
    });
}

}  // namespace tetralight::detail
