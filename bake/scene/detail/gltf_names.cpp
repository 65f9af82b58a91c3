// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/gltf_names.h>

#include <nlohmann/json.hpp>

#include <tetralight/bake/scene/detail/gltf_document.h>
#include <tetralight/bake/scene/detail/gltf_schema.h>
#include <tetralight/bake/scene/detail/part_list.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/base/utf8.h>

namespace tetralight::detail {

using nlohmann::json;

std::vector<ScenePart> clean_names(json& document) {
    ScenePart part;
    part.use = PartUse::Approximated;
    part.name = "names";
    part.note = "have blanks here in place of line breaks and other control characters";
    PartList parts;
    for (const GltfSection& section : gltf_sections()) {
        const json::json_pointer path(str_cat("/", section.path));
        if (!document.contains(path)) continue;
        json& elements = document[path];
        for (size_t i = 0; i < elements.size(); ++i) {
            const auto name = elements[i].find("name");
            if (name == elements[i].end()) continue;
            const auto& text = name->get_ref<const std::string&>();
            if (!has_control_character(text)) continue;
            *name = with_blanks_for_controls(text);
            parts.add(part, gltf_place(section.element, i, name->get<std::string>()));
        }
    }
    return parts.parts();
}

}  // namespace tetralight::detail
