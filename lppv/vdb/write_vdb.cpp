// SPDX-License-Identifier: Apache-2.0
// The only file that includes OpenVDB and NanoVDB.
#include <tetralight/lppv/vdb/write_vdb.h>

#include <nanovdb/util/IO.h>
#include <nanovdb/util/OpenToNanoVDB.h>
#include <openvdb/io/Archive.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/Prune.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <exception>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <memory>
#include <new>
#include <ostream>
#include <span>

#include <tetralight/base/file.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/lppv/lppv_texture.h>
#include <tetralight/lppv/vdb/detail/memory_stream.h>
#include <tetralight/lppv/vdb/detail/vdb_uuid.h>

namespace tetralight {
namespace {

constexpr int kSide = kSparseBlockSide;

/// A block of voxels and its values: voxel (x, y, z) is point first + x + y · row + z · plane.
struct Block {
    glm::ivec3 min{0};        ///< index of its first voxel
    glm::ivec3 count{kSide};  ///< active voxels along each axis
    size_t first = 0;
    size_t row = 0;
    size_t plane = 0;
};

/// The values of a dense or sparse proxy volume as blocks of voxels.
struct VoxelBlocks {
    glm::dmat4 world_from_index{1.0};
    std::vector<Block> blocks;
    std::span<const IrradianceSh> irradiance;
    std::span<const float> validity;
    std::span<const glm::vec4> occlusion;
};

/// Voxels need a size along every axis. Along an axis without spacing it is the largest spacing of
/// the other axes, or a metre.
glm::dmat4 world_from_index(const LppvGrid& grid) {
    const glm::dvec3 spacing = grid.spacing();
    const double largest = std::max({spacing.x, spacing.y, spacing.z});
    glm::dmat4 transform(1.0);
    for (int i = 0; i < 3; ++i) {
        const glm::dvec4 axis = grid.world_from_local[i];
        const double size = largest > 0.0 ? largest : 1.0;
        transform[i] = grid.step[i] > 0.0 ? axis * grid.step[i] : axis * (size / glm::length(axis));
    }
    transform[3] = glm::dvec4(grid.world_position({0, 0, 0}), 1.0);
    return transform;
}

/// Voxels along each axis. Along an axis without thickness all points coincide: one voxel.
glm::ivec3 voxel_counts(const LppvGrid& grid) {
    glm::ivec3 counts(1);
    for (int i = 0; i < 3; ++i) {
        if (grid.step[i] > 0.0) counts[i] = static_cast<int>(grid.resolution[i]);
    }
    return counts;
}

VoxelBlocks voxel_blocks(const Lppv& lppv) {
    const glm::ivec3 size = voxel_counts(lppv.grid);
    const size_t row = lppv.grid.resolution.x, plane = row * lppv.grid.resolution.y;
    VoxelBlocks voxels{
        world_from_index(lppv.grid), {}, lppv.irradiance, lppv.validity, lppv.occlusion};
    for (glm::ivec3 min(0); min.z < size.z; min.z += kSide) {
        for (min.y = 0; min.y < size.y; min.y += kSide) {
            for (min.x = 0; min.x < size.x; min.x += kSide) {
                voxels.blocks.push_back({min, glm::min(size - min, glm::ivec3(kSide)),
                                         lppv.grid.point_index(glm::uvec3(min)), row, plane});
            }
        }
    }
    return voxels;
}

VoxelBlocks voxel_blocks(const SparseLppv& lppv) {
    VoxelBlocks voxels{glm::scale(glm::dmat4(1.0), glm::dvec3(lppv.spacing)),
                       {},
                       lppv.irradiance,
                       {},
                       lppv.occlusion};
    for (size_t i = 0; i < lppv.blocks.size(); ++i) {
        voxels.blocks.push_back({lppv.blocks[i] * kSide, glm::ivec3(kSide), i * kSparseBlockPoints,
                                 kSide, kSide * kSide});
    }
    return voxels;
}

/// OpenVDB multiplies row vectors, so that the rows of its matrices are our columns.
openvdb::math::Transform::Ptr make_transform(const glm::dmat4& m) {
    return openvdb::math::Transform::createLinearTransform(openvdb::Mat4d(&m[0][0]));
}

void add_metadata(openvdb::MetaMap& map) {
    map.insertMeta("sh:basis", openvdb::StringMetadata(
                                   "real orthonormal, all-positive polynomials, index l(l+1)+m: "
                                   "1, y, z, x, xy, yz, 3z^2-1, xz, x^2-y^2"));
    map.insertMeta("sh:quantity",
                   openvdb::StringMetadata("irradiance E(n) = sum E_i Y_i(n), not divided by pi; "
                                           "linear Rec.709 RGB"));
    map.insertMeta("sh:axes", openvdb::StringMetadata("right-handed, Y up, metres (glTF)"));
}

/// One block as a leaf of a tree; null if all its voxels have one value.
template <class Leaf, class Value>
std::unique_ptr<Leaf> make_leaf(const Block& block, Value value) {
    auto leaf = std::make_unique<Leaf>(openvdb::Coord(block.min.x, block.min.y, block.min.z));
    auto* voxels = leaf->buffer().data();
    for (int x = 0; x < block.count.x; ++x) {
        for (int y = 0; y < block.count.y; ++y) {
            for (int z = 0; z < block.count.z; ++z) {
                const auto offset = static_cast<openvdb::Index>((x * kSide + y) * kSide + z);
                const auto i = static_cast<size_t>(x) + static_cast<size_t>(y) * block.row +
                               static_cast<size_t>(z) * block.plane;
                voxels[offset] = value(block.first + i);
                leaf->setValueOn(offset);
            }
        }
    }
    typename Leaf::ValueType first;
    bool is_active = false;
    if (leaf->isConstant(first, is_active)) leaf.reset();
    return leaf;
}

/// A grid with `value(i)` at point i.
template <class Grid, class Value>
typename Grid::Ptr make_grid(const std::string& name, const VoxelBlocks& voxels, Value value) {
    using Leaf = typename Grid::TreeType::LeafNodeType;
    static_assert(Leaf::DIM == kSide);
    std::vector<std::unique_ptr<Leaf>> leaves(voxels.blocks.size());
    tbb::parallel_for(size_t{0}, leaves.size(),
                      [&](size_t i) { leaves[i] = make_leaf<Leaf>(voxels.blocks[i], value); });
    auto grid = Grid::create();
    for (size_t i = 0; i < leaves.size(); ++i) {
        const Block& block = voxels.blocks[i];
        if (leaves[i]) {
            grid->tree().addLeaf(leaves[i].release());
        } else {
            const openvdb::Coord at(block.min.x, block.min.y, block.min.z);
            grid->tree().addTile(/*level=*/1, at, value(block.first), /*active=*/true);
        }
    }
    openvdb::tools::pruneTiles(grid->tree());
    grid->setName(name);
    grid->setTransform(make_transform(voxels.world_from_index));
    add_metadata(*grid);
    return grid;
}

/// The grids of a file.
struct Grids {
    std::vector<openvdb::Vec3SGrid::Ptr> irradiance;
    std::vector<openvdb::FloatGrid::Ptr> scalars;  ///< validity and occlusion
};

Grids make_grids(const VoxelBlocks& voxels, VdbPrecision precision) {
    Grids grids;
    // OpenVDB would write infinity for values beyond the largest half.
    const float limit =
        precision == VdbPrecision::Half ? kLargestHalf : std::numeric_limits<float>::max();
    for (int k = 0; k < kShCoefficientCount; ++k) {
        const auto coefficient = [&](size_t i) {
            const glm::vec3 c = glm::clamp(
                voxels.irradiance[i].coefficients[static_cast<size_t>(k)], -limit, limit);
            return openvdb::Vec3s(c.x, c.y, c.z);
        };
        grids.irradiance.push_back(
            make_grid<openvdb::Vec3SGrid>(str_cat("sh", k), voxels, coefficient));
    }
    grids.scalars.push_back(make_grid<openvdb::FloatGrid>("validity", voxels, [&](size_t i) {
        return voxels.validity.empty() ? 1.0f : voxels.validity[i];
    }));
    for (int k = 0; k < 4 && !voxels.occlusion.empty(); ++k) {
        grids.scalars.push_back(make_grid<openvdb::FloatGrid>(
            str_cat("occlusion", k), voxels, [&](size_t i) { return voxels.occlusion[i][k]; }));
    }
    return grids;
}

/// Makes the writer of openvdb::io::File public: File itself writes only to a path.
struct Archive : openvdb::io::Archive {
    using openvdb::io::Archive::write;
};

void write_openvdb(std::ostream& stream, const VoxelBlocks& voxels, VdbPrecision precision) {
    const Grids grids = make_grids(voxels, precision);
    openvdb::GridPtrVec all(grids.irradiance.begin(), grids.irradiance.end());
    all.insert(all.end(), grids.scalars.begin(), grids.scalars.end());
    for (const auto& grid : all) grid->setSaveFloatAsHalf(precision == VdbPrecision::Half);
    openvdb::MetaMap metadata;
    add_metadata(metadata);
    Archive().write(stream, all, /*seekable=*/true, metadata);
}

void write_nanovdb(std::ostream& stream, const VoxelBlocks& voxels) {
    const Grids grids = make_grids(voxels, VdbPrecision::Float);
    std::vector<nanovdb::GridHandle<>> handles;
    // The function for grids of unknown type instantiates the converters of 13 types of values:
    // most of the time that this file takes to compile.
    for (const auto& grid : grids.irradiance) {
        handles.push_back(nanovdb::openToNanoVDB<nanovdb::HostBuffer>(*grid));
    }
    for (const auto& grid : grids.scalars) {
        handles.push_back(nanovdb::openToNanoVDB<nanovdb::HostBuffer>(*grid));
    }
    nanovdb::io::writeGrids(stream, handles);
}

/// Encodes in memory, because both libraries seek while they write, and then writes the file.
template <class Encode>
Status write_encoded(const std::string& path, uint32_t thread_count, Encode encode) {
    try {
        openvdb::initialize();
        detail::MemoryStream buffer;
        std::ostream stream(&buffer);
        stream.exceptions(std::ios::badbit | std::ios::failbit);
        const int threads =
            thread_count == 0 ? tbb::task_arena::automatic : static_cast<int>(thread_count);
        tbb::task_arena(threads).execute([&] { encode(stream); });
        detail::set_vdb_uuid(buffer.bytes());
        return write_file(path, std::as_bytes(buffer.bytes()));
    } catch (const std::bad_alloc&) {
        throw;
    } catch (const std::exception& exception) {
        return Error{ErrorCode::InvalidArgument,
                     str_cat(path, ": cannot encode the volume (", exception.what(), ")")};
    }
}

template <class Volume>
Status write_as_vdb(const std::string& path, const Volume& lppv, VdbPrecision precision,
                    uint32_t thread_count) {
    return write_encoded(path, thread_count, [&](std::ostream& stream) {
        write_openvdb(stream, voxel_blocks(lppv), precision);
    });
}

template <class Volume>
Status write_as_nvdb(const std::string& path, const Volume& lppv, uint32_t thread_count) {
    return write_encoded(path, thread_count,
                         [&](std::ostream& stream) { write_nanovdb(stream, voxel_blocks(lppv)); });
}

}  // namespace

Status write_vdb(const std::string& path, const Lppv& lppv, VdbPrecision precision,
                 uint32_t thread_count) {
    return write_as_vdb(path, lppv, precision, thread_count);
}

Status write_vdb(const std::string& path, const SparseLppv& lppv, VdbPrecision precision,
                 uint32_t thread_count) {
    return write_as_vdb(path, lppv, precision, thread_count);
}

Status write_nvdb(const std::string& path, const Lppv& lppv, uint32_t thread_count) {
    return write_as_nvdb(path, lppv, thread_count);
}

Status write_nvdb(const std::string& path, const SparseLppv& lppv, uint32_t thread_count) {
    return write_as_nvdb(path, lppv, thread_count);
}

}  // namespace tetralight
