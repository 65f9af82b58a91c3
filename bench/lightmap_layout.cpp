// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <utility>
#include <vector>

#include <tetralight/bake/lightmap/lightmap_layout.h>
#include <tetralight/bake/lightmap/mesh_shape.h>
#include <tetralight/bench/lightmap.h>
#include <tetralight/bench/watlas.h>
#include <tetralight/charts/rasterize_texels.h>

namespace tetralight::bench {
namespace {

/// Calls visit(texel, chart) for each texel that bilinear filtering reads at some point of a chart.
/// Charts of all instances are counted through.
template <class Visit>
void for_each_footprint(const LightmapLayout& layout, const Visit& visit) {
    const size_t size = layout.page_size;
    uint32_t first_chart = 0;
    for (const LightmapPlace& place : layout.places) {
        if (!place.has_lightmap()) continue;
        const LightmapPacking& packing = layout.packings[place.packing];
        uint32_t chart_count = 0;
        for (size_t i = 0; i < packing.triangle_charts.size(); ++i) {
            const glm::vec2* uv = packing.charts.corner_uvs.data() + 3 * i;
            const uint32_t chart = packing.triangle_charts[i];
            chart_count = std::max(chart_count, chart + 1);
            for_each_touched_texel({uv[0], uv[1], uv[2]}, 0.5f, [&](int32_t x, int32_t y) {
                require(x >= 0 && y >= 0 && x < int32_t(packing.charts.width) &&
                            y < int32_t(packing.charts.height),
                        "footprints lie in their rectangle");
                const size_t row = place.corner.page * size + place.corner.y + size_t(y);
                visit(row * size + place.corner.x + size_t(x), first_chart + chart);
            });
        }
        first_chart += chart_count;
    }
}

/// Texels that two charts read, and the share of the pages that footprints and one texel of padding
/// around them use. The last page counts to its last used row.
void bench_pages(const LightmapLayout& layout, const std::string& name) {
    const size_t size = layout.page_size;
    std::vector<uint32_t> owner(size * size * layout.page_count, kNoIndex);
    size_t overlap = 0;
    for_each_footprint(layout, [&](size_t texel, uint32_t chart) {
        overlap += owner[texel] != kNoIndex && owner[texel] != chart;
        owner[texel] = chart;
    });
    std::vector<bool> is_used(owner.size(), false);
    size_t last_row = 0;
    for (size_t i = 0; i < owner.size(); ++i) {
        if (owner[i] == kNoIndex) continue;
        last_row = i / size;
        for (int dy = -1; dy <= 1; ++dy) {
            for (int dx = -1; dx <= 1; ++dx) {
                const auto near = static_cast<int64_t>(i) + dy * static_cast<int64_t>(size) + dx;
                if (near >= 0 && near < static_cast<int64_t>(owner.size()))
                    is_used[static_cast<size_t>(near)] = true;
            }
        }
    }
    const auto used = static_cast<double>(std::ranges::count(is_used, true));
    report("lightmap.overlap." + name, static_cast<double>(overlap), "texels");
    report("lightmap.packing." + name, used / static_cast<double>((last_row + 2) * size), "share");
    report("lightmap.pages." + name, layout.page_count, "pages");
}

/// Ratio of the lengths that a triangle's map from the surface to the page gives to two directions;
/// negative if it is mirrored, 0 without area.
double stretch(const std::vector<glm::vec3>& positions, const uint32_t* indices,
               const glm::vec2* uv) {
    const glm::dvec3 a(positions[indices[0]]);
    const glm::dvec3 u = glm::dvec3(positions[indices[1]]) - a;
    const glm::dvec3 v = glm::dvec3(positions[indices[2]]) - a;
    const double length = glm::length(u), area = glm::length(glm::cross(u, v));
    if (!(area > 1e-12 * length * length)) return 0.0;
    // The triangle in its plane: (length, 0) and (x, y).
    const double x = glm::dot(u, v) / length, y = area / length;
    const glm::dvec2 p(uv[1] - uv[0]), q(uv[2] - uv[0]);
    const glm::dvec2 along = p / length, across = (q - x * along) / y;
    const double sum = glm::dot(along, along) + glm::dot(across, across);
    const double determinant = along.x * across.y - along.y * across.x;
    const double root = std::sqrt(std::max(0.0, sum * sum - 4.0 * determinant * determinant));
    if (determinant == 0.0) return 0.0;
    return std::copysign(std::sqrt((sum + root) / std::max(sum - root, 1e-300)), determinant);
}

/// What is unwrapped: the mesh of each packing, in the shape of the instances that share it and as
/// large as its texels at the density of the layout.
std::vector<UnwrapShape> shapes_of(const Scene& scene, const LightmapLayout& layout) {
    std::vector<UnwrapShape> shapes;
    for (size_t i = 0; i < layout.packings.size(); ++i) {
        const auto user = std::ranges::find_if(
            layout.places, [&](const auto& place) { return place.packing == i; });
        const MeshInstance& instance =
            scene.instances[static_cast<size_t>(user - layout.places.begin())];
        const ShapedTransform transform = shape_of(instance);
        const Mesh& mesh = scene.meshes[layout.packings[i].mesh];
        UnwrapShape shape{shaped_positions(mesh.positions, transform.shape), mesh.indices};
        const auto size = static_cast<float>(transform.size) * instance.lightmap.scale;
        for (glm::vec3& position : shape.positions) position *= size;
        shapes.push_back(std::move(shape));
    }
    return shapes;
}

/// Prints a figure, as a ratio to that of watlas if there is one.
void report_unwrap(const std::string& figure, double ours,
                   const std::optional<WatlasResult>& watlas, double WatlasResult::*baseline,
                   const std::string& unit) {
    if (!watlas) return report(figure, ours, unit);
    report_contest(figure, ours, (*watlas).*baseline, unit, "watlas 1.0.1 (xatlas), same meshes");
}

/// Returns the number of charts.
size_t bench_charts(const LightmapLayout& layout, const std::vector<UnwrapShape>& shapes,
                    const std::string& name) {
    size_t charts = 0, flipped = 0;
    std::vector<double> stretches;
    for (size_t i = 0; i < layout.packings.size(); ++i) {
        const LightmapPacking& packing = layout.packings[i];
        if (packing.triangle_charts.empty()) continue;
        charts += *std::ranges::max_element(packing.triangle_charts) + 1;
        for (size_t k = 0; k < packing.triangle_charts.size(); ++k) {
            const double ratio = stretch(shapes[i].positions, shapes[i].indices.data() + 3 * k,
                                         packing.charts.corner_uvs.data() + 3 * k);
            flipped += ratio < 0.0;
            if (ratio != 0.0) stretches.push_back(std::abs(ratio));
        }
    }
    const auto p99 = stretches.begin() + static_cast<ptrdiff_t>(stretches.size() * 99 / 100);
    std::ranges::nth_element(stretches, p99);
    report("lightmap.stretch." + name, *p99, "ratio");
    report("lightmap.flipped." + name, static_cast<double>(flipped), "triangles");
    return charts;
}

}  // namespace

void bench_lightmap_layout(const Scene& scene, const std::string& name, const Options& options) {
    LightmapLayoutSettings settings;
    settings.thread_count = 1;
    // One mesh of Sponza needs a larger page than usual.
    if (!make_lightmap_layout(scene, settings)) settings.page_size *= 2;
    const int runs = std::min(options.repetitions, 3);
    std::vector<double> times;
    Result<LightmapLayout> layout = LightmapLayout{};
    for (int i = 0; i < runs; ++i) {
        times.push_back(cpu_seconds([&] { layout = make_lightmap_layout(scene, settings); }));
        require(bool(layout), "the scene has a layout");
    }
    const auto shapes = shapes_of(scene, *layout);
    const auto charts = static_cast<double>(bench_charts(*layout, shapes, name));
    const auto watlas = unwrap_with_watlas(shapes, settings.texels_per_meter, runs);
    report_unwrap("lightmap.charts." + name, charts, watlas, &WatlasResult::charts, "charts");
    report_unwrap("lightmap.unwrap." + name, median(times), watlas, &WatlasResult::cpu_seconds,
                  "CPU s");
    bench_pages(*layout, name);
}

}  // namespace tetralight::bench
