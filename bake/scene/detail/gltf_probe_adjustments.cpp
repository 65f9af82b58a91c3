// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/gltf_probe_adjustments.h>

#include <glm/gtc/matrix_transform.hpp>

#include <tetralight/bake/scene/detail/error_field.h>
#include <tetralight/base/str_cat.h>

namespace tetralight::detail {
namespace {

constexpr const char* kMember = ".extras.probe_adjustment";

std::optional<float> to_float(const std::optional<double>& number) {
    if (!number) return std::nullopt;
    return static_cast<float>(*number);
}

Result<ProbeAdjustment> converted(const GltfAdjustment& extras, const glm::dmat4& placed) {
    const bool is_box = extras.shape == "box";
    if (!is_box && extras.shape != "sphere") {
        return Error{ErrorCode::InvalidArgument, ".shape", quoted_value(extras.shape),
                     str_cat("extras.probe_adjustment.shape \"", extras.shape,
                             "\" is not \"box\" or \"sphere\"")};
    }
    if (is_box ? extras.radius.has_value() : extras.size.has_value()) {
        const char* other = is_box ? "radius" : "size";
        return Error{ErrorCode::InvalidArgument, str_cat(".", other), "",
                     str_cat("extras.probe_adjustment: ", other, " does not fit the shape")};
    }
    ProbeAdjustment adjustment;
    adjustment.shape = is_box ? AdjustmentShape::Box : AdjustmentShape::Sphere;
    const glm::dvec3 size =
        is_box ? extras.size.value_or(glm::dvec3(1.0)) : glm::dvec3(extras.radius.value_or(1.0));
    if (auto status = check_adjustment_size(adjustment.shape, size); !status) {
        Error error = status.error().in("extras.probe_adjustment");
        error.field.insert(0, ".");
        return error;
    }
    adjustment.world_from_volume = glm::scale(placed, size);
    adjustment.forbids_probes = extras.forbid;
    adjustment.spacing = extras.spacing;
    adjustment.validity = to_float(extras.validity);
    adjustment.intensity = to_float(extras.intensity);
    adjustment.rendering_layers = extras.rendering_layers;
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
        if (!adjustment) {
            const Error error = in_member(adjustment.error(), kMember);
            return in_element(error, "nodes", placed.node, node.name);
        }
        adjustment->name = node.name.empty() ? str_cat("node ", placed.node) : node.name;
        if (auto status = check_adjustment(*adjustment); !status) {
            Error error = status.error();
            error.field = str_cat("nodes[", placed.node, "]", kMember, ".", error.field);
            return error;
        }
        adjustments.push_back(std::move(*adjustment));
    }
    return adjustments;
}

}  // namespace tetralight::detail
