// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/gltf_portals.h>

#include <glm/geometric.hpp>

#include <tetralight/bake/scene/detail/error_field.h>
#include <tetralight/base/str_cat.h>

namespace tetralight::detail {
namespace {

/// Metres, as for vertices.
constexpr double kMaxDistance = 1e12;

constexpr const char* kPortalMember = ".extras.portal";

Result<Portal> converted(const glm::dvec2& size, const glm::dmat4& world_from_node) {
    Portal portal;
    portal.center = glm::dvec3(world_from_node[3]);
    portal.along = size.x * glm::dvec3(world_from_node[0]);
    portal.across = size.y * glm::dvec3(world_from_node[1]);
    // A sheared node makes a parallelogram of it.
    const double length2 = glm::dot(portal.along, portal.along);
    if (length2 > 0.0) {
        portal.across -= portal.along * (glm::dot(portal.along, portal.across) / length2);
    }
    const std::string value = str_cat("[", size.x, ", ", size.y, "]");
    const auto error = [&value](const char* what) {
        return Error{ErrorCode::InvalidArgument, "", value, str_cat("extras.portal ", value, what)};
    };
    const double width = glm::length(portal.along), height = glm::length(portal.across);
    if (!(size.x > 0.0 && size.y > 0.0)) return error(" is not a width and a height above 0");
    if (!(width * height > 0.0)) return error(" has no area: see the scale of the node");
    if (!(glm::length(portal.center) + width + height <= kMaxDistance))
        return error(" reaches farther than 1e+12 m from the origin");
    return portal;
}

}  // namespace

Result<std::vector<Portal>> read_gltf_portals(const GltfDocument& document,
                                              std::span<const GltfWorldNode> nodes) {
    std::vector<Portal> portals;
    for (const GltfWorldNode& placed : nodes) {
        const GltfNode& node = document.nodes[placed.node];
        if (!node.portal) continue;
        auto portal = converted(*node.portal, placed.world_from_node);
        if (!portal) {
            const Error error = in_member(portal.error(), kPortalMember);
            return in_element(error, "nodes", placed.node, node.name);
        }
        portal->name = node.name;
        portals.push_back(std::move(*portal));
    }
    return portals;
}

}  // namespace tetralight::detail
