// SPDX-License-Identifier: Apache-2.0
#include <tetralight/lightmap/detail/verify_rectangles.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include <tetralight/base/str_cat.h>
#include <tetralight/probes/section_error.h>

namespace tetralight::detail {
namespace {

/// How far scale and offset may be from those of the texels: a small part of the smallest texel.
constexpr float kTransformTolerance = 1e-6f;

bool is_inside(const LightmapRectangle& r, uint32_t page_size) {
    return r.width > 0 && r.height > 0 && uint64_t{r.x} + r.width <= page_size &&
           uint64_t{r.y} + r.height <= page_size;
}

bool is_near(const glm::vec2& a, const glm::vec2& b) {
    return std::abs(a.x - b.x) <= kTransformTolerance && std::abs(a.y - b.y) <= kTransformTolerance;
}

/// What is wrong with a rectangle by itself; empty if nothing is.
std::string rectangle_problem(const LightmapRectangle& r, const LightmapsView& v) {
    if (r.reserved != std::array<uint32_t, 2>{}) return "has a reserved word that is not zero";
    if (r.mesh != kNoIndex && r.mesh >= v.meshes.size()) {
        return str_cat("mesh ", r.mesh, " is out of range (", v.meshes.size(), ")");
    }
    if (r.page == kNoIndex) {
        LightmapRectangle none;
        none.mesh = r.mesh;
        return r == none ? "" : "has no page, but numbers that are not zero";
    }
    if (r.page >= v.info.page_count) {
        return str_cat("page ", r.page, " is out of range (", v.info.page_count, ")");
    }
    if (!is_inside(r, v.info.page_size)) {
        return str_cat("texels ", r.x, ", ", r.y, " and size ", r.width, " x ", r.height,
                       " are not inside a page of size ", v.info.page_size);
    }
    LightmapRectangle right = r;
    set_page_transform(right, v.info.page_size);
    if (is_near(r.scale, right.scale) && is_near(r.offset, right.offset)) return {};
    return str_cat("scale ", r.scale.x, ", ", r.scale.y, " and offset ", r.offset.x, ", ",
                   r.offset.y, " are not those of its texels");
}

/// One side of a rectangle along x. At the same x, rectangles end before others begin.
struct Side {
    uint32_t page = 0;
    uint32_t x = 0;
    bool begins = false;
    uint32_t rectangle = 0;
};

std::vector<Side> sorted_sides(std::span<const LightmapRectangle> rectangles) {
    std::vector<Side> sides;
    for (uint32_t i = 0; i < rectangles.size(); ++i) {
        const LightmapRectangle& r = rectangles[i];
        if (r.page == kNoIndex) continue;
        sides.push_back({r.page, r.x, true, i});
        sides.push_back({r.page, r.x + r.width, false, i});
    }
    std::ranges::sort(sides, {}, [](const Side& side) {
        return std::tuple(side.page, side.x, side.begins, side.rectangle);
    });
    return sides;
}

/// Sweeps over x. The rectangles that a sweep line crosses are disjoint along y, so that a new one
/// can overlap only those beside it.
Status check_overlaps(std::span<const LightmapRectangle> rectangles) {
    std::map<uint32_t, uint32_t> crossed;  // y → rectangle
    const auto overlap = [&](uint32_t a, uint32_t b) {
        return element_error(
            "rectangles", std::max(a, b),
            str_cat("overlaps rectangle ", std::min(a, b), " on page ", rectangles[a].page));
    };
    for (const Side& side : sorted_sides(rectangles)) {
        const LightmapRectangle& r = rectangles[side.rectangle];
        if (!side.begins) {
            crossed.erase(r.y);
            continue;
        }
        const auto above = crossed.lower_bound(r.y);
        if (above != crossed.end() && above->first < r.y + r.height) {
            return overlap(side.rectangle, above->second);
        }
        if (above != crossed.begin()) {
            const auto [y, below] = *std::prev(above);
            if (y + rectangles[below].height > r.y) return overlap(side.rectangle, below);
        }
        crossed.emplace_hint(above, r.y, side.rectangle);
    }
    return Ok{};
}

}  // namespace

Status check_rectangles(const LightmapsView& v) {
    for (size_t i = 0; i < v.rectangles.size(); ++i) {
        const std::string problem = rectangle_problem(v.rectangles[i], v);
        if (!problem.empty()) return element_error("rectangles", i, problem);
    }
    return check_overlaps(v.rectangles);
}

}  // namespace tetralight::detail
