// SPDX-License-Identifier: Apache-2.0
#include <tetralight/runtime/shader_volume.h>

#include <algorithm>
#include <glm/common.hpp>

#include <tetralight/probes/compact_probes.h>
#include <tetralight/probes/interpolate.h>

namespace tetralight {
namespace {

/// A double as the sum of two floats. `volatile` because GCC 12 removes the conversions of a pair
/// of doubles to float and back, so that the difference becomes 0.
struct TwoFloats {
    float whole = 0.0f;
    float rest = 0.0f;

    explicit TwoFloats(double value) {
        const volatile float rounded = static_cast<float>(value);
        whole = rounded;
        rest = static_cast<float>(value - static_cast<double>(rounded));
    }
};

/// A regular grid over the bounding box of the probes, with about one voxel per probe.
struct SeedGrid {
    glm::vec3 min{0.0f};
    glm::vec3 voxel{0.0f};
    glm::uvec3 size{1};

    [[nodiscard]] size_t count() const { return size_t{size.x} * size.y * size.z; }

    [[nodiscard]] glm::vec3 center(size_t index) const {
        const glm::uvec3 place(index % size.x, index / size.x % size.y, index / size.x / size.y);
        return min + voxel * (glm::vec3(place) + 0.5f);
    }
};

SeedGrid make_seed_grid(std::span<const glm::vec3> positions) {
    SeedGrid grid;
    grid.min = positions[0];
    glm::vec3 high = positions[0];
    for (const glm::vec3& position : positions) {
        grid.min = glm::min(grid.min, position);
        high = glm::max(high, position);
    }
    const glm::vec3 box = high - grid.min;
    const float longest = std::max({box.x, box.y, box.z});
    if (!(longest > 0.0f) || !(longest < std::numeric_limits<float>::max())) return grid;
    constexpr float kFinest = 4096.0f;
    for (float along = 1.0f; along <= kFinest && grid.count() < positions.size(); along *= 1.25f) {
        grid.size = glm::uvec3(glm::max(glm::ceil(box * (along / longest)), 1.0f));
    }
    grid.voxel = box / glm::vec3(grid.size);
    return grid;
}

float voxels_a_metre(float voxel) {
    return voxel > 0.0f ? 1.0f / voxel : 0.0f;
}

void add_seeds(const ProbeVolumeView& volume, ShaderVolume& shader) {
    const SeedGrid grid = make_seed_grid(volume.positions);
    std::vector<glm::vec3> centers(grid.count());
    for (size_t i = 0; i < centers.size(); ++i) {
        centers[i] = glm::vec3(glm::dvec3(grid.center(i)) + volume.info.world_origin);
    }
    std::vector<CellLocation> locations(centers.size());
    locate(volume, centers, locations);
    shader.seeds.assign((centers.size() + 3) / 4, glm::uvec4(0));
    for (size_t i = 0; i < centers.size(); ++i) {
        const uint32_t cell = locations[i].cell;
        shader.seeds[i / 4][static_cast<int>(i % 4)] = cell < volume.cells.size() ? cell : 0;
    }
    shader.constants.seed_min = glm::vec4(grid.min, 0.0f);
    shader.constants.seed_scale =
        glm::vec4(voxels_a_metre(grid.voxel.x), voxels_a_metre(grid.voxel.y),
                  voxels_a_metre(grid.voxel.z), 0.0f);
    shader.constants.seed_size = glm::uvec4(grid.size, 0);
}

bool has_cells(const ProbeVolumeView& volume) {
    return !volume.positions.empty() && !volume.cells.empty() &&
           volume.info.dimension <= Dimension::Space;
}

size_t inner_cell_count(const ProbeVolumeView& volume) {
    return std::min<size_t>(volume.info.inner_cell_count, volume.cells.size());
}

ShaderCell make_cell(const ProbeVolumeView& volume, const Cell& cell) {
    ShaderCell made;
    for (int i = 0; i < 4; ++i) {
        const auto place = static_cast<size_t>(i);
        if (cell.vertices[place] < volume.positions.size()) {
            made.vertices[i] = cell.vertices[place];
        }
        if (cell.neighbors[place] < volume.cells.size()) {
            made.neighbors[i] = cell.neighbors[place];
        }
    }
    return made;
}

void add_cells(const ProbeVolumeView& volume, ShaderVolume& shader) {
    shader.cells.reserve(volume.cells.size());
    for (const Cell& cell : volume.cells) shader.cells.push_back(make_cell(volume, cell));
    const size_t hull_count = volume.cells.size() - shader.constants.counts.z;
    shader.hull_rays.assign(std::max<size_t>(1, 3 * hull_count), glm::vec4(0.0f));
    for (size_t i = 0; i < std::min(hull_count, volume.hull_rays.size()); ++i) {
        for (size_t k = 0; k < 3; ++k) {
            shader.hull_rays[3 * i + k] = glm::vec4(volume.hull_rays[i].rays[k], 0.0f);
        }
    }
}

void add_probes(const ProbeVolumeView& volume, ShaderVolume& shader) {
    const size_t count = volume.positions.size();
    const bool is_compact = volume.compact.size() == count;
    const bool has_light = volume.irradiance.size() == count;
    const bool has_occlusion = volume.occlusion.size() == count;
    shader.positions.reserve(count);
    shader.light.reserve(count);
    for (size_t i = 0; i < count; ++i) {
        shader.positions.emplace_back(volume.positions[i], 0.0f);
        PackedProbe probe{shader.constants.ambient, glm::vec4(1.0f)};
        if (is_compact) {
            probe.sh = pack_sh(compact_irradiance(volume.compact[i], volume.info.compact_scale));
            probe.occlusion = compact_occlusion(volume.compact[i]);
        } else {
            if (has_light) probe.sh = pack_sh(volume.irradiance[i]);
            if (has_occlusion) probe.occlusion = volume.occlusion[i];
        }
        shader.light.push_back(probe);
    }
}

}  // namespace

size_t shader_volume_memory(const ProbeVolumeView& volume) {
    if (!has_cells(volume)) return sizeof(ShaderVolume) + 256;
    const size_t probes = volume.positions.size(), cells = volume.cells.size();
    const size_t seeds = make_seed_grid(volume.positions).count();
    return sizeof(ShaderVolume) + probes * (sizeof(glm::vec4) + sizeof(PackedProbe)) +
           cells * sizeof(ShaderCell) +
           (3 * (cells - inner_cell_count(volume)) + 1) * sizeof(glm::vec4) +
           (seeds + 3) * sizeof(uint32_t) + seeds * (sizeof(glm::vec3) + sizeof(CellLocation));
}

ShaderVolume make_shader_volume(const ProbeVolumeView& volume) {
    ShaderVolume shader;
    const glm::dvec3& origin = volume.info.world_origin;
    const TwoFloats x(origin.x), y(origin.y), z(origin.z);
    shader.constants.origin = {x.whole, y.whole, z.whole, volume.info.extent};
    shader.constants.origin_rest = {x.rest, y.rest, z.rest, 0.0f};
    shader.constants.axis = glm::vec4(glm::vec3(volume.info.axis), 0.0f);
    shader.constants.ambient = pack_sh(volume.info.ambient);
    if (!has_cells(volume)) {
        shader.positions.resize(1);
        shader.light.resize(1, PackedProbe{shader.constants.ambient, glm::vec4(1.0f)});
        shader.cells.resize(1);
        shader.hull_rays.resize(1);
        shader.seeds.resize(1);
        return shader;
    }
    const auto cell_count = static_cast<uint32_t>(volume.cells.size());
    shader.constants.counts = {volume.probe_count(), cell_count,
                               static_cast<uint32_t>(inner_cell_count(volume)),
                               static_cast<uint32_t>(volume.info.dimension)};
    add_probes(volume, shader);
    add_cells(volume, shader);
    add_seeds(volume, shader);
    return shader;
}

}  // namespace tetralight
