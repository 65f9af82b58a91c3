// SPDX-License-Identifier: Apache-2.0
// How much light leaks through walls: two rooms beside each other, one with a lamp, the other dark.
#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

#include <tetralight/bake/blocked_fraction.h>
#include <tetralight/bake/placement/probe_grid.h>
#include <tetralight/base/error_text.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/bench/harness.h>
#include <tetralight/bench/scene_parts.h>
#include <tetralight/pipeline/bake_volume.h>
#include <tetralight/probes/interpolate.h>

namespace tetralight::bench {
namespace {

constexpr float kWide = 4.0f, kHigh = 3.0f;
/// Positions are at least so far from all walls, metres.
constexpr float kMargin = 0.05f;
/// Positions of the lit room are near the wall up to this distance.
constexpr float kNear = 0.6f;
constexpr int kPositions = 2500;

Mesh quad(glm::vec3 corner, glm::vec3 u, glm::vec3 v) {
    Mesh mesh;
    append_quad(mesh, corner, u, v);
    return mesh;
}

Material grey(float albedo) {
    Material material;
    material.base_color = glm::vec4(glm::vec3(albedo), 1.0f);
    material.metallic = 0.0f;
    material.is_double_sided = true;
    return material;
}

/// The room x in [low, low + 4]; its sides have normals that point into it.
void add_room(Scene& scene, float low, bool has_wall_at_high_x) {
    const glm::vec3 x(kWide, 0, 0), y(0, kHigh, 0), z(0, 0, kWide), corner(low, 0, 0);
    Material material = grey(0.7f);
    material.is_double_sided = false;
    add_mesh(scene, quad(corner, z, x), material);
    add_mesh(scene, quad(corner + y, x, z), material);
    add_mesh(scene, quad(corner, x, y), material);
    add_mesh(scene, quad(corner + z, y, x), material);
    add_mesh(scene, quad(corner, y, z), material);
    if (has_wall_at_high_x) add_mesh(scene, quad(corner + x, z, y), material);
}

/// The lit room x < 0 and the dark one; without thickness both have one double-sided surface.
Scene two_rooms(float thickness) {
    Scene scene;
    const float half = 0.5f * thickness;
    add_room(scene, -kWide - half, thickness > 0.0f);
    add_room(scene, half, true);
    if (thickness == 0.0f) {
        scene.materials.back().is_double_sided = true;
        scene.materials[scene.meshes[scene.meshes.size() - 2].material].is_double_sided = true;
    }
    Material lamp = grey(0.0f);
    lamp.emission = glm::vec3(10.0f);
    lamp.is_double_sided = false;
    add_mesh(scene, quad({-2.5f - half, kHigh - 0.01f, 1.5f}, {1, 0, 0}, {0, 0, 1}), lamp);
    return scene;
}

/// The light of positions by plain weights, by weights that know walls, and by weights that know
/// which corners a ray reaches.
struct Light {
    double plain = 0.0, walls = 0.0, rays = 0.0;
};

class LeakMeasure {
  public:
    LeakMeasure(const Scene& scene, const ProbeVolumeView& volume, float thickness)
        : traced_(*TraceScene::make_static(scene)), volume_(volume), half_(0.5f * thickness) {
        std::mt19937_64 engine(1);
        std::uniform_real_distribution<float> across(kMargin, kWide - kMargin);
        std::uniform_real_distribution<float> up(kMargin, kHigh - kMargin);
        for (int i = 0; i < kPositions; ++i) {
            const float x = across(engine), y = up(engine), z = across(engine);
            add(dark_, {half_ + x, y, z});
            add(lit_, {-half_ - x, y, z});
            if (x < kNear) add(near_, {-half_ - x, y, z});
        }
    }

    /// Light in the dark room divided by light in the lit room, percent.
    [[nodiscard]] Light leak() const {
        return {100.0 * dark_.plain / lit_.plain, 100.0 * dark_.walls / lit_.walls,
                100.0 * dark_.rays / lit_.rays};
    }

    /// Light in the lit room near the wall, divided by the same with rays to the corners.
    [[nodiscard]] Light near() const {
        return {near_.plain / near_.rays, near_.walls / near_.rays, 1.0};
    }

  private:
    void add(Light& sum, const glm::vec3& position) const {
        const CellLocation location = locate(volume_, position);
        sum.plain += light_at(location, Walls::Ignore);
        sum.walls += light_at(location, Walls::HideProbes);
        sum.rays += light_at(by_rays(location, position), Walls::Ignore);
    }

    [[nodiscard]] double light_at(const CellLocation& location, Walls walls) const {
        return static_cast<double>(
            interpolate(volume_, location, walls).irradiance.coefficients[0].x);
    }

    [[nodiscard]] CellLocation by_rays(CellLocation location, const glm::vec3& position) const {
        glm::vec4 seen(0.0f);
        float sum = 0.0f;
        for (int i = 0; i < 4; ++i) {
            if (!(location.weights[i] > 0.0f)) continue;
            const uint32_t probe = volume_.cells[location.cell].vertices[i];
            const glm::vec3 from = traced_.render_from_world(volume_.exact_positions[probe]);
            const glm::vec3 to = traced_.render_from_world(glm::dvec3(position));
            if (!blocked_fraction(traced_, from, to)) seen[i] = location.weights[i];
            sum += seen[i];
        }
        if (sum > 0.0f) location.weights = seen / sum;
        return location;
    }

    TraceScene traced_;
    const ProbeVolumeView& volume_;
    float half_;
    Light lit_, dark_, near_;
};

ProbeGrid make_grid(const Scene& scene, float thickness, double spacing, uint64_t adaptive_count) {
    ProbeGridSettings settings;
    settings.spacing = glm::dvec3(spacing);
    const double x = 2.0 + 0.5 * double{thickness};
    settings.from = {{-x, 1.5, 2.0}, {x, 1.5, 2.0}};
    if (adaptive_count > 0) {
        settings.mode = PlacementMode::Adaptive;
        settings.max_probes = adaptive_count;
    }
    auto grid = make_probe_grid(scene, settings);
    require(static_cast<bool>(grid), grid ? "" : error_text(grid.error()));
    return std::move(*grid);
}

double visibility_bytes(const ProbeVolumeView& volume) {
    const auto bytes = volume.visibility_blocks.size_bytes() + volume.cell_visibility.size_bytes();
    return static_cast<double>(bytes) / static_cast<double>(volume.positions.size());
}

/// `adaptive_count` 0: a lattice.
void measure(float thickness, double spacing, uint64_t adaptive_count) {
    const Scene scene = two_rooms(thickness);
    const ProbeGrid grid = make_grid(scene, thickness, spacing, adaptive_count);
    BakeVolumeSettings settings;
    settings.bake.sample_count = 1024;
    const auto baked = bake_volume(scene, grid.groups, settings);
    require(static_cast<bool>(baked), baked ? "" : error_text(baked.error()));
    const ProbeVolumeView volume = baked->volume.view();
    const LeakMeasure measured(scene, volume, thickness);

    const std::string wall = str_cat(std::lround(100.0 * double{thickness}), "cm");
    const std::string probes = adaptive_count > 0 ? str_cat(adaptive_count) : str_cat(spacing, "m");
    const std::string name = str_cat(wall, ".", probes);
    const std::string kind = adaptive_count > 0 ? "leak.adaptive." : "leak.bright_into_dark.";
    const Light leak = measured.leak(), near = measured.near();
    report_contest(kind + name, leak.walls, leak.plain, "% of the lit room", "plain weights");
    report("leak.by_rays." + name, leak.rays, "% of the lit room");
    report_contest("leak.near_wall." + name, near.walls, near.plain, "of the light by rays",
                   "plain weights");
    report("leak.bytes." + name, visibility_bytes(volume),
           str_cat("bytes a probe of ", volume.positions.size()));
    report("leak.bake_cost." + name,
           100.0 * baked->report.visibility.seconds / baked->report.bake_seconds,
           "% of the time of a bake with 1024 samples");
}

}  // namespace

void bench_leaks(const Options& options) {
    for (const float thickness : {0.2f, 0.05f, 0.0f}) {
        for (const double spacing : {0.5, 1.0, 2.0}) measure(thickness, spacing, 0);
        for (const uint64_t count : {96, 750}) {
            if (!options.is_quick) measure(thickness, 1.0, count);
        }
    }
}

}  // namespace tetralight::bench
