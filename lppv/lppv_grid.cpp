// SPDX-License-Identifier: Apache-2.0
#include <tetralight/lppv/lppv_grid.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>
#include <optional>
#include <string>

#include <tetralight/base/box.h>
#include <tetralight/base/str_cat.h>

namespace tetralight {
namespace {

constexpr const char* kAxes[] = {"x", "y", "z"};

/// A box along the axes of a local space.
struct OrientedBox {
    glm::dmat4 world_from_local{1.0};
    Box<glm::dvec3> local;
};

bool is_finite(const glm::dvec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

std::string shown(const glm::dvec3& v) {
    return str_cat("(", v.x, ", ", v.y, ", ", v.z, ")");
}

/// A setting that is wrong: the message and its value.
Error invalid(const char* field, const std::string& value, std::string_view message) {
    return {ErrorCode::InvalidArgument, field, value, str_cat(message, ": ", value)};
}

Status check_transform(const glm::dmat4& m) {
    for (int column = 0; column < 4; ++column) {
        if (!is_finite(glm::dvec3(m[column]))) {
            return invalid("transform", shown(glm::dvec3(m[column])),
                           str_cat("transform of the object is not finite in column ", column));
        }
    }
    if (m[0][3] == 0.0 && m[1][3] == 0.0 && m[2][3] == 0.0 && m[3][3] == 1.0) return Ok{};
    const std::string row = str_cat("(", m[0][3], ", ", m[1][3], ", ", m[2][3], ", ", m[3][3], ")");
    return Error{ErrorCode::InvalidArgument, "transform", row,
                 str_cat("transform of the object is not affine: its last row is ", row,
                         ", not (0, 0, 0, 1)")};
}

Error bounds_error(const char* problem, int axis, const glm::dvec3& min, const glm::dvec3& max) {
    return invalid("bounds", str_cat(min[axis], " to ", max[axis]),
                   str_cat("bounds are ", problem, " along ", kAxes[axis]));
}

Status check_bounds(const glm::dvec3& min, const glm::dvec3& max) {
    for (int axis = 0; axis < 3; ++axis) {
        if (!std::isfinite(min[axis]) || !std::isfinite(max[axis])) {
            return bounds_error("not finite", axis, min, max);
        }
        if (min[axis] > max[axis]) {
            return bounds_error("reversed", axis, min, max);
        }
    }
    return Ok{};
}

/// The bounding box of the corners of all parts, in local space.
Result<OrientedBox> automatic_bounds(const LppvObject& object, const glm::dmat4& world_from_local) {
    if (object.parts.empty()) return Error{ErrorCode::InvalidArgument, "the object has no mesh"};
    const glm::dmat4 local_from_world = glm::inverse(world_from_local);
    OrientedBox bounds{world_from_local, Box<glm::dvec3>::empty()};
    for (const LppvPart& part : object.parts) {
        if (auto status = check_bounds(part.min, part.max); !status) return status.error();
        if (auto status = check_transform(part.world_from_part); !status) return status.error();
        const glm::dmat4 local_from_part = local_from_world * part.world_from_part;
        for (int corner = 0; corner < 8; ++corner) {
            const glm::dvec4 p((corner & 1) != 0 ? part.max.x : part.min.x,
                               (corner & 2) != 0 ? part.max.y : part.min.y,
                               (corner & 4) != 0 ? part.max.z : part.min.z, 1.0);
            bounds.local = union_of(bounds.local, glm::dvec3(local_from_part * p));
        }
    }
    return bounds;
}

Result<OrientedBox> custom_bounds(const glm::dmat4& world_from_object, const LppvBox& box) {
    const double length = glm::length(box.orientation);
    if (!is_finite(box.center) || !std::isfinite(length) || length == 0.0) {
        return Error{ErrorCode::InvalidArgument,
                     str_cat("the box is not finite or its orientation is 0: center ",
                             shown(box.center), ", orientation of length ", length)};
    }
    const glm::dmat4 world_from_box = glm::translate(world_from_object, box.center) *
                                      glm::mat4_cast(glm::normalize(box.orientation));
    return OrientedBox{world_from_box, {-0.5 * box.size, 0.5 * box.size}};
}

/// A unit vector perpendicular to two vectors, which may be 0.
glm::dvec3 perpendicular(const glm::dvec3& a, const glm::dvec3& b) {
    const glm::dvec3 normal = glm::cross(a, b);
    if (glm::length(normal) > 0.0) return glm::normalize(normal);
    const glm::dvec3 along = glm::length(a) > 0.0 ? a : b;
    if (!(glm::length(along) > 0.0)) return {0.0, 0.0, 1.0};
    const bool is_along_x = std::abs(along.x) > 0.9 * glm::length(along);
    return glm::normalize(
        glm::cross(along, is_along_x ? glm::dvec3(0.0, 1.0, 0.0) : glm::dvec3(1.0, 0.0, 0.0)));
}

/// The transform with unit axes instead of the axes that it scales to 0, so that it is invertible.
/// None if it is singular in another direction.
std::optional<glm::dmat4> with_every_axis(glm::dmat4 world_from_local) {
    glm::dvec3 axes[3];
    double longest = 0.0;
    for (int i = 0; i < 3; ++i) {
        axes[i] = glm::dvec3(world_from_local[i]);
        longest = std::max(longest, glm::length(axes[i]));
    }
    for (int i = 0; i < 3; ++i) {
        if (glm::length(axes[i]) > 1e-12 * longest) continue;
        axes[i] = glm::dvec3(0.0);
        axes[i] = perpendicular(axes[(i + 1) % 3], axes[(i + 2) % 3]);
        world_from_local[i] = glm::dvec4(axes[i], 0.0);
    }
    const double volume = glm::dot(axes[0], glm::cross(axes[1], axes[2]));
    const double product = glm::length(axes[0]) * glm::length(axes[1]) * glm::length(axes[2]);
    if (!(std::abs(volume) > 1e-9 * product)) return std::nullopt;
    return world_from_local;
}

Result<OrientedBox> find_bounds(const LppvObject& object, const LppvSettings& settings) {
    if (auto status = check_transform(object.world_from_object); !status) return status.error();
    if (settings.bounds == LppvBounds::AutomaticWorld) {
        return automatic_bounds(object, glm::dmat4(1.0));
    }
    const auto world_from_object = with_every_axis(object.world_from_object);
    if (!world_from_object) {
        return Error{ErrorCode::InvalidArgument,
                     "transform of the object is singular and not along its axes; use bounds along "
                     "the world's axes"};
    }
    if (settings.bounds == LppvBounds::Custom) {
        return custom_bounds(*world_from_object, settings.custom_box);
    }
    return automatic_bounds(object, *world_from_object);
}

uint32_t nearest_power_of_two(double number) {
    uint32_t power = 1;
    while (power < kMaxUnityLppvResolution && number >= 1.5 * power) power *= 2;
    return power;
}

Result<glm::uvec3> find_resolution(const OrientedBox& bounds, const LppvSettings& settings) {
    glm::dvec3 wanted(settings.resolution);
    if (settings.resolution_mode == LppvResolution::Automatic) {
        if (!std::isfinite(settings.density) || settings.density <= 0.0) {
            return invalid("density", str_cat(settings.density),
                           "density is not a positive number");
        }
        for (int i = 0; i < 3; ++i) {
            const double metres =
                bounds.local.size()[i] * glm::length(glm::dvec3(bounds.world_from_local[i]));
            wanted[i] = std::max(1.0, std::round(settings.density * metres));
        }
    }
    const double smallest = std::min({wanted.x, wanted.y, wanted.z});
    const double largest = std::max({wanted.x, wanted.y, wanted.z});
    const std::string request = str_cat(wanted.x, " x ", wanted.y, " x ", wanted.z);
    if (smallest < 1.0) {
        return Error{ErrorCode::InvalidArgument, "resolution", request,
                     str_cat("a grid of ", request, " points is empty")};
    }
    if (settings.limits == LppvLimits::Unity) {
        return glm::uvec3(nearest_power_of_two(wanted.x), nearest_power_of_two(wanted.y),
                          nearest_power_of_two(wanted.z));
    }
    if (!(largest <= kMaxLppvResolution)) {
        return Error{ErrorCode::InvalidArgument, "resolution", request,
                     str_cat("a grid of ", request, " points (", wanted.x * wanted.y * wanted.z,
                             " in total) is too large: the limit is ", kMaxLppvResolution,
                             " along each axis")};
    }
    return glm::uvec3(wanted);
}

/// Sets the first point and the step along one axis.
void place_points(LppvGrid& grid, int axis, LppvPlacement placement) {
    const double size = grid.max[axis] - grid.min[axis];
    const uint32_t count = grid.resolution[axis];
    grid.first[axis] = 0.5 * grid.min[axis] + 0.5 * grid.max[axis];
    grid.step[axis] = 0.0;
    if (count == 1) return;
    if (placement == LppvPlacement::CellCorners) {
        grid.first[axis] = grid.min[axis];
        grid.step[axis] = size / (count - 1);
    } else {
        grid.step[axis] = size / count;
        grid.first[axis] = grid.min[axis] + 0.5 * grid.step[axis];
    }
}

}  // namespace

glm::dvec3 LppvGrid::world_position(glm::uvec3 point) const noexcept {
    return glm::dvec3(world_from_local * glm::dvec4(first + glm::dvec3(point) * step, 1.0));
}

glm::dvec3 LppvGrid::spacing() const noexcept {
    return {step.x * glm::length(glm::dvec3(world_from_local[0])),
            step.y * glm::length(glm::dvec3(world_from_local[1])),
            step.z * glm::length(glm::dvec3(world_from_local[2]))};
}

glm::dvec3 LppvGrid::point_coordinates(const glm::dvec3& position) const noexcept {
    const glm::dvec3 local(local_from_world * glm::dvec4(position, 1.0));
    glm::dvec3 coordinates(0.0);
    for (int i = 0; i < 3; ++i) {
        if (!(step[i] > 0.0)) continue;
        const double c = (local[i] - first[i]) / step[i];
        if (c > 0.0) coordinates[i] = std::min(c, resolution[i] - 1.0);
    }
    return coordinates;
}

Result<LppvGrid> make_lppv_grid(const LppvObject& object, const LppvSettings& settings) {
    const auto bounds = find_bounds(object, settings);
    if (!bounds) return bounds.error();
    if (auto status = check_bounds(bounds->local.min, bounds->local.max); !status)
        return status.error();
    const auto resolution = find_resolution(*bounds, settings);
    if (!resolution) return resolution.error();

    LppvGrid grid;
    grid.world_from_local = bounds->world_from_local;
    grid.local_from_world = glm::inverse(bounds->world_from_local);
    grid.min = bounds->local.min;
    grid.max = bounds->local.max;
    grid.resolution = *resolution;
    for (int axis = 0; axis < 3; ++axis) place_points(grid, axis, settings.placement);
    return grid;
}

}  // namespace tetralight
