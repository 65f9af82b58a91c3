// SPDX-License-Identifier: Apache-2.0
#include <tetralight/charts/detail/chart_shapes.h>

#include <algorithm>
#include <cmath>
#include <span>

#include <tetralight/base/str_cat.h>
#include <tetralight/charts/rasterize_texels.h>

namespace tetralight::detail {

namespace {

/// UVs are rounded to float after charts have their places. Within the size limit of rectangles
/// that moves them by less than this, in texels.
constexpr double kRounding = 1.0 / 256;

/// Texels around a footprint that are its own: one to each side.
constexpr double kBorder = 1.0;

/// Texels that a length needs with its border. Filtering reads half a texel past each end, and the
/// length lies where it reads the fewest texels.
double needed_texels(double length) {
    return std::ceil(length + 1.0 + 4.0 * kRounding) + 2.0 * kBorder;
}

std::string as_text(double texels) {
    return texels < 1e15 ? str_cat(static_cast<uint64_t>(texels)) : str_cat(texels);
}

Error too_large(const PackSettings& settings, const std::string& what) {
    return {ErrorCode::InvalidArgument, "texels_per_meter", str_cat(settings.texels_per_meter),
            str_cat(what, ", more than the page of ", settings.max_size)};
}

/// Triangles of each chart: those of chart c are at [begins[c], begins[c + 1]).
struct ChartTriangles {
    std::vector<uint32_t> begins;
    std::vector<uint32_t> triangles;

    [[nodiscard]] std::span<const uint32_t> of(uint32_t chart) const {
        return std::span(triangles).subspan(begins[chart], begins[chart + 1] - begins[chart]);
    }
};

ChartTriangles group_by_chart(const Unwrap& charts) {
    ChartTriangles groups;
    groups.begins.resize(charts.chart_sizes.size() + 1);
    for (const uint32_t chart : charts.triangle_charts) ++groups.begins[chart + 1];
    for (size_t c = 1; c < groups.begins.size(); ++c) groups.begins[c] += groups.begins[c - 1];
    groups.triangles.resize(charts.triangle_charts.size());
    std::vector<uint32_t> next = groups.begins;
    for (uint32_t t = 0; t < charts.triangle_charts.size(); ++t) {
        groups.triangles[next[charts.triangle_charts[t]]++] = t;
    }
    return groups;
}

class ShapeMaker {
  public:
    ShapeMaker(const Unwrap& charts, const PackSettings& settings)
        : charts_(charts), settings_(settings), triangles_(group_by_chart(charts)) {}

    [[nodiscard]] Result<ChartShape> make(uint32_t chart) const {
        const glm::dvec2 size = glm::dvec2(charts_.chart_sizes[chart]) * density();
        const double width = needed_texels(size.x);
        const double height = needed_texels(size.y);
        if (!(std::max(width, height) <= settings_.max_size)) {
            return too_large(settings_, str_cat("chart ", chart, " needs ", as_text(width), " × ",
                                                as_text(height), " texels"));
        }
        ChartShape shape{chart, 0, {}};
        shape.turned.push_back(make_turned(chart, QuarterTurn::None));
        if (charts_.rotation == ChartRotation::Free) {
            shape.turned.push_back(make_turned(chart, QuarterTurn::Left));
        }
        shape.texels = texel_count(shape.turned[0].mask);
        return shape;
    }

  private:
    [[nodiscard]] double density() const { return settings_.texels_per_meter; }

    [[nodiscard]] ChartShape::Turned make_turned(uint32_t chart, QuarterTurn turn) const {
        glm::dvec2 size = glm::dvec2(charts_.chart_sizes[chart]) * density();
        if (turn == QuarterTurn::Left) std::swap(size.x, size.y);
        const glm::dvec2 texels(needed_texels(size.x), needed_texels(size.y));
        ChartShape::Turned turned;
        turned.offset = 0.5 * (texels - size);
        TexelMask footprint =
            make_texel_mask(static_cast<uint32_t>(texels.x), static_cast<uint32_t>(texels.y));
        for (const uint32_t triangle : triangles_.of(chart)) {
            add_triangle(triangle, turn, turned.offset, footprint);
        }
        turned.mask = dilate_mask(footprint);
        turned.shape = make_mask_shape(turned.mask);
        return turned;
    }

    void add_triangle(uint32_t triangle, QuarterTurn turn, glm::dvec2 offset,
                      TexelMask& footprint) const {
        constexpr auto kMargin = static_cast<float>(0.5 + kRounding);
        const glm::vec2 chart_size = charts_.chart_sizes[charts_.triangle_charts[triangle]];
        std::array<glm::vec2, 3> corners;
        for (size_t k = 0; k < 3; ++k) {
            const glm::vec2 uv = charts_.corner_uvs[3 * size_t{triangle} + k];
            corners[k] = glm::vec2(turn_uv(uv, chart_size, turn, density()) + offset);
        }
        for_each_touched_row(corners, kMargin, [&](int32_t y, int32_t x_begin, int32_t x_end) {
            add_span(footprint, static_cast<uint32_t>(y), static_cast<uint32_t>(x_begin),
                     static_cast<uint32_t>(x_end));
        });
    }

    const Unwrap& charts_;
    const PackSettings& settings_;
    ChartTriangles triangles_;
};

}  // namespace

glm::dvec2 turn_uv(glm::vec2 uv, glm::vec2 chart_size, QuarterTurn turn, double texels_per_meter) {
    const glm::dvec2 at(uv);
    if (turn == QuarterTurn::None) return texels_per_meter * at;
    return texels_per_meter * glm::dvec2(double{chart_size.y} - at.y, at.x);
}

Result<std::vector<ChartShape>> make_chart_shapes(const Unwrap& charts,
                                                  const PackSettings& settings) {
    const ShapeMaker maker(charts, settings);
    std::vector<ChartShape> shapes;
    uint64_t texels = 0;
    for (uint32_t chart = 0; chart < charts.chart_sizes.size(); ++chart) {
        Result<ChartShape> shape = maker.make(chart);
        if (!shape) return shape.error();
        texels += shape->texels;
        if (texels > uint64_t{settings.max_size} * settings.max_size) {
            return too_large(settings, str_cat("the charts need over ", texels - 1, " texels"));
        }
        shapes.push_back(std::move(*shape));
    }
    return shapes;
}

}  // namespace tetralight::detail
