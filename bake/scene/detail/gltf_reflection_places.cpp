// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/detail/gltf_reflection_places.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <numbers>
#include <string_view>

#include <tetralight/bake/scene/detail/error_field.h>
#include <tetralight/base/str_cat.h>

namespace tetralight::detail {
namespace {

constexpr const char* kProbeMember = ".extras.reflection_probe";
constexpr const char* kProbeName = "extras.reflection_probe";

std::string shown(const glm::dvec3& v) {
    return str_cat("[", v.x, ", ", v.y, ", ", v.z, "]");
}

/// Returns invalid_argument: `extras.reflection_probe: REASON`.
Error node_error(std::string value, const std::string& reason) {
    return {ErrorCode::InvalidArgument, "", std::move(value), str_cat(kProbeName, ": ", reason)};
}

/// The axes of a node: of length 1, and the scales along them.
struct Frame {
    glm::dmat3 axes{1.0};
    glm::dvec3 scale{1.0};
};

Result<Frame> frame_of(const glm::dmat3& world_from_node) {
    constexpr const char* kAxisNames[] = {"X", "Y", "Z"};
    // Of the product of two axes: six digits of a matrix in a file are enough.
    constexpr double kSheared = 1e-4;
    Frame frame;
    for (int i = 0; i < 3; ++i) frame.scale[i] = glm::length(world_from_node[i]);
    if (!(std::min({frame.scale.x, frame.scale.y, frame.scale.z}) > 0.0)) {
        return node_error(shown(frame.scale),
                          str_cat("the scale of the node, ", shown(frame.scale), ", has a zero"));
    }
    for (int i = 0; i < 3; ++i) frame.axes[i] = world_from_node[i] / frame.scale[i];
    for (int i = 0; i < 3; ++i) {
        const int next = (i + 1) % 3;
        const double cosine = glm::dot(frame.axes[i], frame.axes[next]);
        if (std::abs(cosine) <= kSheared) continue;
        const double degrees = std::acos(std::clamp(cosine, -1.0, 1.0)) * 180.0 / std::numbers::pi;
        const std::string angle = str_cat(static_cast<float>(degrees));
        return node_error(
            angle, str_cat("the node is sheared: its axes ", kAxisNames[std::min(i, next)], " and ",
                           kAxisNames[std::max(i, next)], " are ", angle, " degrees apart"));
    }
    // Right-handed and exactly at right angles: a mirrored box is the same box.
    frame.axes[1] =
        glm::normalize(frame.axes[1] - frame.axes[0] * glm::dot(frame.axes[0], frame.axes[1]));
    frame.axes[2] = glm::cross(frame.axes[0], frame.axes[1]);
    return frame;
}

Status check_size(const glm::dvec3& size, const glm::dvec3& world_size) {
    constexpr double kLeast = 1e-6, kMost = 1e12;
    const std::string value = shown(size);
    const auto error = [&](const std::string& reason) {
        return Error{ErrorCode::InvalidArgument, ".size", value,
                     str_cat(kProbeName, ".size ", value, reason)};
    };
    for (int i = 0; i < 3; ++i) {
        if (!(size[i] > 0.0)) return error(" is not three lengths above 0");
    }
    for (int i = 0; i < 3; ++i) {
        if (world_size[i] >= kLeast && world_size[i] <= kMost) continue;
        return error(str_cat(" makes a box of ", shown(world_size),
                             " m with the scale of the node, not of 1e-06 to 1e+12 m"));
    }
    return Ok{};
}

Result<ReflectionPlace> converted(const GltfReflectionProbe& extras,
                                  const glm::dmat4& world_from_node) {
    const auto frame = frame_of(glm::dmat3(world_from_node));
    if (!frame) return frame.error();
    const glm::dvec3 world_size = extras.size * frame->scale;
    if (auto status = check_size(extras.size, world_size); !status) return status.error();
    ReflectionPlace place;
    place.position = glm::dvec3(world_from_node[3]);
    place.box_center = glm::vec3(glm::dmat3(world_from_node) * extras.center);
    place.half_size = glm::vec3(0.5 * world_size);
    place.axes = glm::mat3(frame->axes);
    place.blend_distance = static_cast<float>(extras.blend_distance);
    place.importance = extras.importance;
    place.near_distance = static_cast<float>(extras.near_distance);
    return place;
}

}  // namespace

Result<std::vector<ReflectionPlace>> read_gltf_reflection_places(
    const GltfDocument& document, std::span<const GltfWorldNode> nodes) {
    std::vector<ReflectionPlace> places;
    for (const GltfWorldNode& placed : nodes) {
        const GltfNode& node = document.nodes[placed.node];
        if (!node.reflection_probe) continue;
        auto place = converted(*node.reflection_probe, placed.world_from_node);
        if (place) {
            place->name = node.name.empty() ? str_cat("node ", placed.node) : node.name;
            if (auto status = check_reflection_place(*place); !status) {
                place = status.error().in(kProbeName);
            }
        }
        if (!place) {
            const Error error = in_member(place.error(), kProbeMember);
            return in_element(error, "nodes", placed.node, node.name);
        }
        places.push_back(std::move(*place));
    }
    return places;
}

}  // namespace tetralight::detail
