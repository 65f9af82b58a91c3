// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/gltf_unknown_members.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include <tetralight/bake/scene/detail/gltf_extension_table.h>
#include <tetralight/bake/scene/detail/gltf_member_table.h>
#include <tetralight/bake/scene/detail/gltf_members.h>
#include <tetralight/bake/scene/detail/gltf_rules.h>
#include <tetralight/bake/scene/detail/gltf_schema.h>
#include <tetralight/bake/scene/detail/gltf_unknown_extras.h>
#include <tetralight/bake/scene/detail/meant_name.h>
#include <tetralight/base/str_cat.h>

namespace tetralight::detail {
namespace {

using nlohmann::json;

bool defines(const GltfMembers& known, std::string_view name) {
    return std::ranges::find(known.names, name) != known.names.end();
}

/// True for members that change nothing that is read.
bool is_without_light(std::string_view name) {
    constexpr std::string_view kNames[] = {
        "name",   "copyright", "generator", "mimeType",    "max",         "min",
        "target", "skeleton",  "minFilter", "aspectRatio", "yfov",        "xmag",
        "ymag",   "zfar",      "znear",     "perspective", "orthographic"};
    return std::ranges::find(kNames, name) != std::end(kNames);
}

/// True for words that many programs use, and that say nothing about where they belong.
bool is_common(std::string_view name) {
    constexpr std::string_view kWords[] = {
        "name",    "type",     "index",  "indices", "count",  "mode",    "scale",    "source",
        "target",  "path",     "input",  "output",  "values", "min",     "max",      "weights",
        "uri",     "node",     "nodes",  "color",   "range",  "version", "strength", "buffer",
        "sampler", "samplers", "camera", "size",    "rect",   "aspect",  "offset",   "visible"};
    return std::ranges::find(kWords, name) != std::end(kWords);
}

/// The object that a member belongs to; null if there is none.
const GltfMembers* right_place(std::string_view name) {
    if (is_common(name)) return nullptr;
    for (const GltfMembers& known : gltf_member_table()) {
        if (!known.section.empty() && defines(known, name)) return &known;
    }
    return nullptr;
}

bool is_extension_name(std::string_view name) {
    return find_gltf_extension(name) != nullptr || name.starts_with("KHR_") ||
           name.starts_with("EXT_");
}

/// The member of an object that a name probably stands for; empty if there is none.
std::string meant_member(const GltfMembers& known, const std::string& name) {
    std::vector<std::string> names(known.names.begin(), known.names.end());
    names.insert(names.end(), {"extensions", "extras"});
    return meant_name(name, names);
}

/// What is wrong with a member that glTF does not define in this object; without a note if nothing
/// is known of it.
ScenePart wrong_member(const GltfMembers& known, const std::string& name) {
    ScenePart part;
    part.use = PartUse::Ignored;
    part.name = str_cat("member \"", name, "\" of ", known.object);
    part.changes_light = true;
    if (is_extension_name(name)) {
        part.note = "is an extension outside of \"extensions\"";
        part.remedy = "move it into \"extensions\"";
    } else if (known.path.empty() && is_extras_name(known.section, name)) {
        part.note = "is read of \"extras\" only";
        part.remedy = "move it into \"extras\"";
    } else if (const GltfMembers* place = right_place(name)) {
        part.note = str_cat("is a member of ", place->object);
        part.remedy = str_cat("move it to ", place->object);
    } else if (const std::string near = meant_member(known, name); !near.empty()) {
        part.note = "is not defined";
        part.remedy = str_cat("did you mean \"", near, "\"?");
        part.changes_light = !is_without_light(near);
    }
    return part;
}

void add_unknown(const GltfMembers& known, const std::string& name, const std::string& element,
                 PartList& parts) {
    const ScenePart part = wrong_member(known, name);
    if (!part.note.empty()) return parts.add(part, element);
    parts.add_left_out("other members", "are not defined by glTF 2.0", false,
                       str_cat(element, ": ", name));
}

/// Visits the object at a path of `value`, or all objects of the lists on the way.
template <class Visit>
void visit_objects(const json& value, std::string_view path, const Visit& visit) {
    if (value.is_array()) {
        for (const json& item : value) visit_objects(item, path, visit);
        return;
    }
    if (!value.is_object()) return;
    if (path.empty()) return visit(value);
    const size_t slash = std::min(path.find('/'), path.size());
    const auto member = value.find(std::string(path.substr(0, slash)));
    if (member == value.end()) return;
    visit_objects(*member, path.substr(std::min(slash + 1, path.size())), visit);
}

void add_unknown_of(const GltfMembers& known, const json& element, const std::string& place,
                    PartList& parts) {
    visit_objects(element, known.path, [&](const json& object) {
        for (const auto& [name, value] : object.items()) {
            if (name == "extensions" || name == "extras" || defines(known, name)) continue;
            add_unknown(known, name, place, parts);
        }
    });
}

}  // namespace

void add_unknown_members(const json& source, PartList& parts) {
    for (const GltfMembers& known : gltf_member_table()) {
        if (known.section.empty()) add_unknown_of(known, source, "the file", parts);
    }
    for_each_element(
        source, [&](const GltfSection& section, const json& element, const std::string& place) {
            for (const GltfMembers& known : gltf_member_table()) {
                if (known.section == section.name) add_unknown_of(known, element, place, parts);
            }
        });
}

}  // namespace tetralight::detail
