// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include <tetralight/bake/lightmap/lightmap_layout.h>
#include <tetralight/bake/lightmap/mesh_shape.h>
#include <tetralight/bench/lightmap.h>
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

void bench_charts(const Scene& scene, const LightmapLayout& layout, const std::string& name) {
    size_t charts = 0, flipped = 0;
    std::vector<double> stretches;
    for (size_t i = 0; i < layout.packings.size(); ++i) {
        const LightmapPacking& packing = layout.packings[i];
        if (packing.triangle_charts.empty()) continue;
        charts += *std::ranges::max_element(packing.triangle_charts) + 1;
        const auto user = std::ranges::find_if(
            layout.places, [&](const auto& place) { return place.packing == i; });
        const auto instance = static_cast<size_t>(user - layout.places.begin());
        const Mesh& mesh = scene.meshes[packing.mesh];
        const auto positions =
            shaped_positions(mesh.positions, shape_of(scene.instances[instance]).shape);
        for (size_t k = 0; k < packing.triangle_charts.size(); ++k) {
            const double ratio = stretch(positions, mesh.indices.data() + 3 * k,
                                         packing.charts.corner_uvs.data() + 3 * k);
            flipped += ratio < 0.0;
            if (ratio != 0.0) stretches.push_back(std::abs(ratio));
        }
    }
    const auto p99 = stretches.begin() + static_cast<ptrdiff_t>(stretches.size() * 99 / 100);
    std::ranges::nth_element(stretches, p99);
    report("lightmap.charts." + name, static_cast<double>(charts), "charts");
    report("lightmap.stretch." + name, *p99, "ratio");
    report("lightmap.flipped." + name, static_cast<double>(flipped), "triangles");
}

}  // namespace

void bench_lightmap_layout(const Scene& scene, const std::string& name, const Options& options) {
    LightmapLayoutSettings settings;
    settings.thread_count = 1;
    settings.page_size = 2048;  // one mesh of Sponza needs more than 1024
    std::vector<double> times;
    Result<LightmapLayout> layout = LightmapLayout{};
    for (int i = 0; i < std::min(options.repetitions, 3); ++i) {
        times.push_back(cpu_seconds([&] { layout = make_lightmap_layout(scene, settings); }));
        require(bool(layout), "the scene has a layout");
    }
    report("lightmap.unwrap." + name, median(times), "CPU s");
    bench_charts(scene, *layout, name);
    bench_pages(*layout, name);
}

}  // namespace tetralight::bench
