// SPDX-License-Identifier: Apache-2.0
#include <tetralight/charts/pack_charts.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>
#include <optional>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include <tetralight/base/contract.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/charts/detail/chart_shapes.h>

namespace tetralight {

namespace {

using detail::ChartShape;
using detail::MaskPacker;
using detail::QuarterTurn;

struct ChartPlace {
    MaskPacker::Place place;
    QuarterTurn turn = QuarterTurn::None;
};

/// Places of all charts in a rectangle.
struct Packing {
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<ChartPlace> places;
};

/// Shapes with larger keys are placed first.
using ChartOrderKey = std::pair<uint32_t, uint32_t> (*)(const ChartShape&);

std::pair<uint32_t, uint32_t> sides(const ChartShape& shape) {
    const auto& mask = shape.turned[0].mask;
    return std::minmax({mask.width, mask.height});
}

constexpr std::array<ChartOrderKey, 2> kChartOrders = {
    [](const ChartShape& shape) { return sides(shape); },
    [](const ChartShape& shape) { return std::pair(sides(shape).second, sides(shape).first); }};

/// The turn and the place that end lowest. `from_y` has the first row to search for each turn.
std::optional<ChartPlace> lowest_place(MaskPacker& packer, const ChartShape& shape,
                                       std::array<uint32_t, 2>& from_y) {
    std::optional<ChartPlace> best;
    uint32_t best_end = 0;
    for (size_t turn = 0; turn < shape.turned.size(); ++turn) {
        const auto place = packer.find_place(shape.turned[turn].shape, from_y[turn]);
        if (!place) continue;
        from_y[turn] = place->y;
        const uint32_t end = place->y + shape.turned[turn].mask.height;
        if (best && best_end <= end) continue;
        best = ChartPlace{*place, static_cast<QuarterTurn>(turn)};
        best_end = end;
    }
    return best;
}

std::optional<Packing> pack_into_width(std::span<const ChartShape> shapes,
                                       std::span<const uint32_t> order, uint32_t width,
                                       uint32_t max_height) {
    MaskPacker packer(width, max_height);
    Packing packing;
    packing.places.resize(shapes.size());
    std::array<uint32_t, 2> from_y{};
    for (size_t i = 0; i < order.size(); ++i) {
        const ChartShape& shape = shapes[order[i]];
        // A shape equal to the one before fits nowhere below that one's place.
        if (i > 0 && shape.turned[0].mask != shapes[order[i - 1]].turned[0].mask) from_y = {};
        const std::optional<ChartPlace> place = lowest_place(packer, shape, from_y);
        if (!place) return std::nullopt;
        packer.place(shape.turned[static_cast<size_t>(place->turn)].shape, place->place);
        packing.places[order[i]] = *place;
    }
    packing.width = packer.used_width();
    packing.height = packer.used_height();
    return packing;
}

/// Widths to try, from a narrow to a wide rectangle of the area that the shapes need.
std::set<uint32_t> candidate_widths(std::span<const ChartShape> shapes, uint32_t max_size) {
    constexpr size_t kManyShapes = 100;
    uint64_t texels = 0;
    uint32_t least = 1;
    for (const ChartShape& shape : shapes) {
        texels += shape.texels;
        const auto& mask = shape.turned[0].mask;
        const bool is_free = shape.turned.size() > 1;
        least = std::max(least, is_free ? std::min(mask.width, mask.height) : mask.width);
    }
    const double square = std::sqrt(static_cast<double>(texels));
    const bool are_few = shapes.size() < kManyShapes;
    // A few long shapes, such as the sides of a wall, pack best beside each other.
    const double narrowest = are_few ? 0.25 : 0.7, step = are_few ? 0.03 : 0.08;
    std::set<uint32_t> widths{least, max_size};
    for (double share = narrowest; share < 1.6; share += step) {
        widths.insert(std::clamp(static_cast<uint32_t>(share * square), least, max_size));
    }
    return widths;
}

/// Area of a packing, in texels, plus some for a long shape: pages have room for squares.
double cost(const Packing& packing) {
    constexpr double kCostOfLength = 0.04;
    const double width = packing.width;
    const double height = packing.height;
    const double length = std::max(width, height) / std::min(width, height);
    return width * height * (1.0 + kCostOfLength * (length - 1.0));
}

std::optional<Packing> best_packing(std::span<const ChartShape> shapes, uint32_t max_size) {
    std::vector<uint32_t> order(shapes.size());
    std::iota(order.begin(), order.end(), 0u);
    std::optional<Packing> best;
    for (const ChartOrderKey key : kChartOrders) {
        std::ranges::stable_sort(order, std::greater<>(),
                                 [&](uint32_t i) { return key(shapes[i]); });
        for (const uint32_t width : candidate_widths(shapes, max_size)) {
            std::optional<Packing> packing = pack_into_width(shapes, order, width, max_size);
            if (packing && (!best || cost(*packing) < cost(*best))) best = std::move(packing);
        }
    }
    return best;
}

void write_texels(const Unwrap& charts, std::span<const ChartShape> shapes, const Packing& packing,
                  double texels_per_meter, std::vector<glm::vec2>& uvs) {
    uvs.resize(charts.corner_uvs.size());
    for (size_t corner = 0; corner < uvs.size(); ++corner) {
        const uint32_t chart = charts.triangle_charts[corner / 3];
        const ChartPlace& place = packing.places[chart];
        const auto& turned = shapes[chart].turned[static_cast<size_t>(place.turn)];
        const glm::dvec2 at = turn_uv(charts.corner_uvs[corner], charts.chart_sizes[chart],
                                      place.turn, texels_per_meter);
        const glm::dvec2 origin(place.place.x, place.place.y);
        uvs[corner] = glm::vec2(origin + turned.offset + at);
    }
}

}  // namespace

Result<PackedCharts> pack_charts(const Unwrap& charts, const PackSettings& settings) {
    TETRALIGHT_ASSERT(settings.texels_per_meter > 0.0f && std::isfinite(settings.texels_per_meter),
                      "texels per meter are finite and above 0");
    TETRALIGHT_ASSERT(settings.max_size >= 4 && settings.max_size <= 16384,
                      "the largest size is in [4, 16384]");
    PackedCharts packed;
    if (charts.chart_sizes.empty()) return packed;
    const auto shapes = detail::make_chart_shapes(charts, settings);
    if (!shapes) return shapes.error();
    const std::optional<Packing> packing = best_packing(*shapes, settings.max_size);
    if (!packing) {
        uint64_t texels = 0;
        for (const ChartShape& shape : *shapes) texels += shape.texels;
        return Error(ErrorCode::InvalidArgument, "texels_per_meter",
                     str_cat(settings.texels_per_meter),
                     str_cat("the ", shapes->size(), " charts need at least ", texels,
                             " texels, more than fit into the page of ", settings.max_size));
    }
    packed.width = packing->width;
    packed.height = packing->height;
    write_texels(charts, *shapes, *packing, settings.texels_per_meter, packed.corner_uvs);
    return packed;
}

}  // namespace tetralight
