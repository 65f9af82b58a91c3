// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include <tetralight/base/result.h>
#include <tetralight/lppv/lppv.h>
#include <tetralight/lppv/sparse_lppv.h>

// Proxy volumes as OpenVDB and NanoVDB files: nine vector grids `sh0` .. `sh8`, the RGB irradiance
// coefficients of `IrradianceSh`, a float grid `validity` (1 = free), and, where the volume has it,
// occlusion as four float grids `occlusion0` .. `occlusion3` (1 = lit). One active voxel a grid
// point; index (i, j, k) is point (i, j, k) of the grid, and along an axis without thickness there
// is one, since its points are all at one place. Blocks of one value are tiles. The
// transform leads to the world, in metres. Metadata of the file and of each grid: `sh:basis`,
// `sh:quantity`, `sh:axes`.

namespace tetralight {

enum class VdbPrecision : uint8_t {
    Float,
    Half,  ///< half floats in the file, up to ±65504; readers get floats
};

/// Writes an OpenVDB file, compressed by Blosc. The same bytes for the same values, on any number
/// of threads (0 = all). Errors name the path; the old file stays whole on failure.
[[nodiscard]] Status write_vdb(const std::string& path, const Lppv& lppv, VdbPrecision precision,
                               uint32_t thread_count = 0);
[[nodiscard]] Status write_vdb(const std::string& path, const SparseLppv& lppv,
                               VdbPrecision precision, uint32_t thread_count = 0);

/// Writes a NanoVDB file, not compressed, so that it can be mapped: 32-bit floats, the form that
/// NanoVDB has for vectors. Otherwise as `write_vdb`.
[[nodiscard]] Status write_nvdb(const std::string& path, const Lppv& lppv,
                                uint32_t thread_count = 0);
[[nodiscard]] Status write_nvdb(const std::string& path, const SparseLppv& lppv,
                                uint32_t thread_count = 0);

}  // namespace tetralight
