// SPDX-License-Identifier: Apache-2.0
#include "tests/lppv/vdb/read_vdb.h"

#include <nanovdb/util/GridHandle.h>
#include <nanovdb/util/IO.h>
#include <openvdb/openvdb.h>

namespace tetralight::test {
namespace {

glm::dvec3 from_vdb(const openvdb::Vec3d& v) {
    return {v.x(), v.y(), v.z()};
}

glm::vec3 value_of(const openvdb::Vec3s& v) {
    return {v.x(), v.y(), v.z()};
}

glm::vec3 value_of(float v) {
    return glm::vec3(v);
}

std::map<std::string, std::string> strings(const openvdb::MetaMap& map) {
    std::map<std::string, std::string> result;
    for (auto it = map.beginMeta(); it != map.endMeta(); ++it) {
        result[it->first] = it->second->str();
    }
    return result;
}

template <class Grid>
void read_voxels(Grid& grid, ReadGrid& result) {
    result.tile_count = grid.tree().activeTileCount();
    grid.tree().voxelizeActiveTiles();
    for (auto it = grid.cbeginValueOn(); it; ++it) {
        const openvdb::Coord at = it.getCoord();
        result.active.push_back({{at.x(), at.y(), at.z()}, value_of(it.getValue())});
    }
}

glm::vec3 value_of(const nanovdb::Vec3f& v) {
    return {v[0], v[1], v[2]};
}

template <class Grid>
void read_nano(const Grid& grid, ReadGrid& result) {
    const auto box = grid.indexBBox();
    const auto accessor = grid.getAccessor();
    for (auto it = box.begin(); it; ++it) {
        const auto at = *it;
        if (!accessor.isActive(at)) continue;
        result.active.push_back({{at.x(), at.y(), at.z()}, value_of(accessor.getValue(at))});
    }
    const auto origin = grid.indexToWorld(nanovdb::Vec3d(0.0));
    const auto place = grid.indexToWorld(nanovdb::Vec3d(1.0, 2.0, 3.0));
    result.origin = {origin[0], origin[1], origin[2]};
    result.place_of_123 = {place[0], place[1], place[2]};
}

}  // namespace

ReadGrids read_vdb(const std::string& path, std::map<std::string, std::string>& meta) {
    openvdb::initialize();
    openvdb::io::File file(path);
    file.open();
    meta = strings(*file.getMetadata());
    ReadGrids grids;
    const auto read = file.getGrids();
    for (const auto& base : *read) {
        ReadGrid& grid = grids[base->getName()];
        grid.is_saved_as_half = base->saveFloatAsHalf();
        grid.metadata = strings(*base);
        grid.origin = from_vdb(base->transform().indexToWorld(openvdb::Vec3d(0.0)));
        grid.place_of_123 = from_vdb(base->transform().indexToWorld(openvdb::Vec3d(1, 2, 3)));
        if (const auto vectors = openvdb::GridBase::grid<openvdb::Vec3SGrid>(base)) {
            grid.is_vector = true;
            read_voxels(*vectors, grid);
        } else {
            read_voxels(*openvdb::GridBase::grid<openvdb::FloatGrid>(base), grid);
        }
    }
    return grids;
}

ReadGrids read_nvdb(const std::string& path) {
    ReadGrids grids;
    const auto handles = nanovdb::io::readGrids(path);
    for (const auto& handle : handles) {
        ReadGrid& grid = grids[handle.gridMetaData()->shortGridName()];
        if (const auto* vectors = handle.grid<nanovdb::Vec3f>()) {
            grid.is_vector = true;
            read_nano(*vectors, grid);
        } else if (const auto* floats = handle.grid<float>()) {
            read_nano(*floats, grid);
        }
    }
    return grids;
}

}  // namespace tetralight::test
