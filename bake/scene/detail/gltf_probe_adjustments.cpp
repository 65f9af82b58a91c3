// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/gltf_probe_adjustments.h>

#include <glm/gtc/matrix_transform.hpp>

#include <tetralight/base/str_cat.h>

namespace tetralight::detail {
namespace {

std::optional<float> to_float(const std::optional<double>& number) {
    if (!number) return std::nullopt;
    return static_cast<float>(*number);
}

Result<ProbeAdjustment> converted(const GltfAdjustment& extras, const glm::dmat4& placed) {
    const bool is_box = extras.shape == "box";
    if (!is_box && extras.shape != "sphere") {
        return Error{str_cat("extras.probe_adjustment.shape \"", extras.shape,
                             "\" is not \"box\" or \"sphere\"")};
    }
    if (is_box ? extras.radius.has_value() : extras.size.has_value()) {
        return Error{str_cat("extras.probe_adjustment: ", is_box ? "radius" : "size",
                             " does not fit the shape")};
    }
    ProbeAdjustment adjustment;
    adjustment.shape = is_box ? AdjustmentShape::Box : AdjustmentShape::Sphere;
    const glm::dvec3 size =
        is_box ? extras.size.value_or(glm::dvec3(1.0)) : glm::dvec3(extras.radius.value_or(1.0));
    if (auto status = check_size(adjustment.shape, size); !status) {
        return status.error().in("extras.probe_adjustment");
    }
    adjustment.world_from_volume = glm::scale(placed, size);
    adjustment.forbids_probes = extras.forbid;
    adjustment.spacing = extras.spacing;
    adjustment.validity = to_float(extras.validity);
    adjustment.intensity = to_float(extras.intensity);
    return adjustment;
}

}  // namespace

Result<std::vector<ProbeAdjustment>> read_gltf_probe_adjustments(
    const GltfDocument& document, std::span<const GltfWorldNode> nodes) {
    std::vector<ProbeAdjustment> adjustments;
    for (const GltfWorldNode& placed : nodes) {
        const GltfNode& node = document.nodes[placed.node];
        if (!node.probe_adjustment) continue;
        auto adjustment = converted(*node.probe_adjustment, placed.world_from_node);
        if (!adjustment) return adjustment.error().in(gltf_place("node", placed.node, node.name));
        adjustment->name = node.name.empty() ? str_cat("node ", placed.node) : node.name;
        if (auto status = check(*adjustment); !status) return status.error();
        adjustments.push_back(std::move(*adjustment));
    }
    return adjustments;
}

}  // namespace tetralight::detail
