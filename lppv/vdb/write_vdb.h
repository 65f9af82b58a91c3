// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include <tetralight/base/result.h>
#include <tetralight/lppv/lppv.h>
#include <tetralight/lppv/sparse_lppv.h>

// Proxy volumes as OpenVDB and NanoVDB files: nine vector grids `sh0` .. `sh8`, the RGB irradiance
// coefficients of `IrradianceSh`, a float grid `validity` (1 = free), and, if the volume has it,
// occlusion as four float grids `occlusion0` .. `occlusion3` (1 = lit). Each grid point is one
// active voxel with its index (i, j, k); along an axis without thickness, where all points
// coincide, there is one voxel. Blocks of one value are tiles. The transform maps to world space,
// in metres. The file and each grid have the metadata `sh:basis`, `sh:quantity` and `sh:axes`.

namespace tetralight {

enum class VdbPrecision : uint8_t {
    Float,
    Half,  ///< half floats in the file, up to ±65504; readers return floats
};

/// Writes an OpenVDB file, compressed by Blosc. The same values give the same bytes on any number
/// of threads (0 = all). Errors name the path. On failure an existing file is unchanged.
[[nodiscard]] Status write_vdb(const std::string& path, const Lppv& lppv, VdbPrecision precision,
                               uint32_t thread_count = 0);
[[nodiscard]] Status write_vdb(const std::string& path, const SparseLppv& lppv,
                               VdbPrecision precision, uint32_t thread_count = 0);

/// Writes a NanoVDB file in 32-bit floats, the only format of NanoVDB for vectors. It is not
/// compressed, so that it can be mapped. Otherwise as `write_vdb`.
[[nodiscard]] Status write_nvdb(const std::string& path, const Lppv& lppv,
                                uint32_t thread_count = 0);
[[nodiscard]] Status write_nvdb(const std::string& path, const SparseLppv& lppv,
                                uint32_t thread_count = 0);

}  // namespace tetralight
