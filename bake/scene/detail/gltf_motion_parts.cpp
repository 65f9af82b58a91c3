// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/gltf_motion_parts.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include <tetralight/bake/scene/detail/error_field.h>
#include <tetralight/bake/scene/detail/gltf_morph.h>
#include <tetralight/bake/scene/detail/gltf_skin.h>
#include <tetralight/base/str_cat.h>

namespace tetralight::detail {
namespace {

ScenePart animation_part(bool is_chosen, bool is_other_chosen) {
    ScenePart part;
    part.name = "animations";
    if (is_chosen) return part;
    part.use = PartUse::Ignored;
    part.note =
        is_other_chosen ? "another one is read" : "the scene is read as it stands without it";
    part.remedy = is_other_chosen ? "--animation NAME reads this one instead"
                                  : "--time SECONDS reads the scene at a time of an animation";
    return part;
}

/// Adds a channel that read_gltf() does not read.
void add_channel(const GltfChannel& channel, const std::string& place, PartList& parts) {
    constexpr std::string_view kRead[] = {"translation", "rotation", "scale", "weights"};
    ScenePart part;
    part.use = PartUse::Ignored;
    if (channel.path == "pointer") {
        part.name = "channels of KHR_animation_pointer";
        part.note = "what they animate stays as it is without the animation";
        part.changes_light = true;
    } else if (std::ranges::find(kRead, channel.path) == std::end(kRead)) {
        part.name = str_cat("animated \"", quoted_value(channel.path), "\"");
        part.note = "is no property that animations of glTF 2.0 have";
        part.changes_light = true;
    } else if (channel.node == kNoIndex) {
        part.name = "channels without a node";
        part.note = "animate nothing";
    } else {
        return;
    }
    parts.add(part, place);
}

}  // namespace

void add_motion_parts(const GltfDocument& document, std::span<const GltfWorldNode> nodes,
                      PartList& parts) {
    const std::optional<uint32_t> animation = document.animation;
    for (uint32_t i = 0; i < document.animations.size(); ++i) {
        const GltfAnimation& source = document.animations[i];
        const std::string place = gltf_place("animation", i, source.name);
        parts.add(animation_part(animation == i, animation.has_value()), place);
        if (animation != i) continue;
        for (size_t c = 0; c < source.channels.size(); ++c) {
            add_channel(source.channels[c], str_cat(place, ", channel ", c), parts);
        }
    }
    for (const GltfWorldNode& placed : nodes) {
        const GltfNode& node = document.nodes[placed.node];
        if (node.mesh == kNoIndex || !placed.is_visible) continue;
        const std::string place = gltf_place("node", placed.node, node.name);
        ScenePart part;
        part.name = "skins";
        const bool has_skin = is_skinned(document, node);
        if (has_skin) parts.add(part, place);
        if (has_skin && node.parent_from_node != glm::dmat4(1.0)) {
            parts.add_left_out("transforms of skinned nodes",
                               "have no effect on their meshes, which stand where the joints are",
                               false, place);
        }
        part.name = "morph targets";
        if (!morph_weights(document, placed.node).empty()) parts.add(part, place);
    }
}

}  // namespace tetralight::detail
