// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/gltf_references.h>

#include <algorithm>
#include <string>
#include <string_view>

namespace tetralight::detail {
namespace {

using Value = nlohmann::ordered_json;
using Indices = std::set<uint32_t>;
using Places = std::set<std::pair<uint32_t, uint32_t>>;

constexpr std::string_view kAccessorMembers[] = {"input", "output", "indices", "accessor",
                                                 "inverseBindMatrices"};

void add_index(const Value& value, Indices& found) {
    if (value.is_number_unsigned()) found.insert(value.get<uint32_t>());
}

/// `attributes`, or one of `targets`: names with accessors.
void add_attributes(const Value& attributes, Indices& found) {
    if (!attributes.is_object()) return;
    for (const Value& accessor : attributes) add_index(accessor, found);
}

void add_accessors(const Value& value, Indices& found) {
    if (!value.is_structured()) return;
    if (value.is_array()) {
        for (const Value& child : value) add_accessors(child, found);
        return;
    }
    for (const auto& [name, child] : value.items()) {
        if (std::ranges::count(kAccessorMembers, name) > 0) add_index(child, found);
        if (name == "attributes") add_attributes(child, found);
        if (name == "targets" && child.is_array()) {
            for (const Value& target : child) add_attributes(target, found);
        }
        add_accessors(child, found);
    }
}

void add_views(const Value& value, Indices& found) {
    if (!value.is_structured()) return;
    if (value.is_object() && value.contains("bufferView")) add_index(value["bufferView"], found);
    for (const Value& child : value) add_views(child, found);
}

/// Calls `visit` with the place of each primitive, and with the primitive.
template <class Visit>
void for_each_primitive(const Value& document, Visit visit) {
    const auto meshes = document.find("meshes");
    if (meshes == document.end()) return;
    for (uint32_t mesh = 0; mesh < meshes->size(); ++mesh) {
        const Value& primitives = (*meshes)[mesh]["primitives"];
        for (uint32_t i = 0; i < primitives.size(); ++i) {
            visit(std::pair(mesh, i), primitives[i]);
        }
    }
}

}  // namespace

Indices used_accessors(const Value& document, const Places& places) {
    Indices found;
    for (const auto& [name, value] : document.items()) {
        if (name != "meshes" && name != "accessors") add_accessors(value, found);
    }
    for_each_primitive(document, [&](const auto& place, const Value& primitive) {
        if (!places.contains(place)) add_accessors(primitive, found);
    });
    return found;
}

Indices primitive_accessors(const Value& document, const Places& places) {
    Indices found;
    for_each_primitive(document, [&](const auto& place, const Value& primitive) {
        if (places.contains(place)) add_accessors(primitive, found);
    });
    return found;
}

Indices used_views(const Value& document, const Indices& accessors) {
    Indices found;
    for (const auto& [name, value] : document.items()) {
        if (name != "accessors") add_views(value, found);
    }
    const auto all = document.find("accessors");
    if (all == document.end()) return found;
    for (uint32_t i = 0; i < all->size(); ++i) {
        if (!accessors.contains(i)) add_views((*all)[i], found);
    }
    return found;
}

Indices accessor_views(const Value& document, const Indices& accessors) {
    Indices found;
    for (const uint32_t accessor : accessors) add_views(document["accessors"][accessor], found);
    return found;
}

}  // namespace tetralight::detail
