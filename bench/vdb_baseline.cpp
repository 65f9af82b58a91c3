// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bench/vdb_baseline.h>

#include <openvdb/openvdb.h>
#include <openvdb/tools/Dense.h>

namespace tetralight::bench {
namespace {

/// A dense array in OpenVDB's order (z fastest) as a grid. All voxels are active, because no voxel
/// has the background value.
template <class Grid, class Value>
typename Grid::Ptr copy_from_dense(const Lppv& lppv, const std::string& name,
                                   typename Grid::ValueType background, Value value) {
    const glm::uvec3 size = lppv.grid.resolution;
    const openvdb::CoordBBox box(openvdb::Coord(0), openvdb::Coord(static_cast<int>(size.x) - 1,
                                                                   static_cast<int>(size.y) - 1,
                                                                   static_cast<int>(size.z) - 1));
    openvdb::tools::Dense<typename Grid::ValueType, openvdb::tools::LayoutXYZ> dense(box);
    auto* values = dense.data();
    for (size_t i = 0; i < lppv.irradiance.size(); ++i) values[i] = value(i);
    auto grid = Grid::create(background);
    openvdb::tools::copyFromDense(dense, *grid, openvdb::zeroVal<typename Grid::ValueType>());
    grid->setName(name);
    return grid;
}

}  // namespace

void write_vdb_by_openvdb(const std::string& path, const Lppv& lppv) {
    openvdb::initialize();
    openvdb::GridPtrVec grids;
    for (size_t k = 0; k < kShCoefficientCount; ++k) {
        grids.push_back(copy_from_dense<openvdb::Vec3SGrid>(
            lppv, "sh" + std::to_string(k), openvdb::Vec3s(-1e30f), [&](size_t i) {
                const glm::vec3& c = lppv.irradiance[i].coefficients[k];
                return openvdb::Vec3s(c.x, c.y, c.z);
            }));
    }
    grids.push_back(
        copy_from_dense<openvdb::FloatGrid>(lppv, "validity", -1e30f, [](size_t) { return 1.0f; }));
    openvdb::io::File(path).write(grids);
}

}  // namespace tetralight::bench
