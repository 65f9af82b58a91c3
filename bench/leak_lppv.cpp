// SPDX-License-Identifier: Apache-2.0
// A proxy volume over a lit room and a dark one.
#include <cmath>

#include <tetralight/bake/placement/light_difference.h>
#include <tetralight/base/error_text.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/bench/leak_scenes.h>
#include <tetralight/bench/leaks.h>
#include <tetralight/lppv/lppv.h>
#include <tetralight/render/with_walls.h>

namespace tetralight::bench {
namespace {

/// Both rooms with the wall between them.
LppvGrid grid_over_rooms(float thickness, uint32_t side) {
    LppvSettings settings;
    settings.bounds = LppvBounds::Custom;
    const double wide = double{kRoomWide}, high = double{kRoomHigh};
    settings.custom_box = {{0.0, 0.5 * high, 0.5 * wide},
                           {2.0 * wide + double{thickness}, high, wide}};
    settings.resolution_mode = LppvResolution::Custom;
    settings.resolution = glm::uvec3(side);
    settings.placement = LppvPlacement::CellCenters;
    const auto grid = make_lppv_grid({}, settings);
    require(bool(grid), grid ? "" : error_text(grid.error()));
    return *grid;
}

/// Sums of light in both rooms.
struct RoomLight {
    double lit = 0.0, dark = 0.0;
    size_t lit_count = 0, dark_count = 0;

    void add(bool is_dark, const IrradianceSh& light) {
        (is_dark ? dark : lit) += mean_irradiance(light);
        ++(is_dark ? dark_count : lit_count);
    }

    [[nodiscard]] double leak() const {
        require(lit_count > 0 && dark_count > 0, "points in both rooms");
        return 100.0 * (dark / static_cast<double>(dark_count)) /
               (lit / static_cast<double>(lit_count));
    }
};

/// Percent of the lit room's light in the dark one.
struct LppvLeak {
    double texels = 0.0;   ///< at the points of the grid that are kLeakMargin off the walls
    double between = 0.0;  ///< by trilinear lookups at the rooms' positions
};

bool is_off_walls(const glm::dvec3& p, double half) {
    const double x = std::abs(p.x) - half, margin = double{kLeakMargin};
    return x >= margin && x <= double{kRoomWide} - margin && p.y >= margin &&
           p.y <= double{kRoomHigh} - margin && p.z >= margin && p.z <= double{kRoomWide} - margin;
}

LppvLeak measure(const ProbeVolumeView& volume, const LppvGrid& grid,
                 const RoomPositions& positions, float thickness) {
    const auto lppv = make_lppv(volume, grid, {});
    require(bool(lppv), "fill");
    RoomLight texels, between;
    for (size_t i = 0; i < grid.point_count(); ++i) {
        const glm::dvec3 p = grid.world_position(grid.point(i));
        if (is_off_walls(p, 0.5 * double{thickness})) texels.add(p.x > 0.0, lppv->irradiance[i]);
    }
    for (const bool is_dark : {false, true}) {
        for (const glm::vec3& p : is_dark ? positions.dark : positions.lit) {
            between.add(is_dark, sample_lppv(*lppv, p).irradiance);
        }
    }
    return {texels.leak(), between.leak()};
}

}  // namespace

void bench_leak_lppv(const LeakVolume& volume, const RoomPositions& positions, float thickness,
                     const std::string& name) {
    for (const uint32_t side : {16u, 32u, 64u}) {
        const LppvGrid grid = grid_over_rooms(thickness, side);
        const LppvLeak walls = measure(volume.view(), grid, positions, thickness);
        const LppvLeak plain =
            measure(with_walls(volume.view(), Walls::Ignore), grid, positions, thickness);
        const auto contest = [&](const char* kind, double ours, double baseline) {
            report_contest(str_cat("leak.lppv.", kind, ".", name, ".", side), ours, baseline,
                           "% of the lit room", "plain weights");
        };
        contest("texels", walls.texels, plain.texels);
        contest("between", walls.between, plain.between);
    }
}

}  // namespace tetralight::bench
