// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include <tetralight/bake/bake_progress.h>
#include <tetralight/bake/reflection/bake_cubes.h>
#include <tetralight/base/result.h>
#include <tetralight/pipeline/bake_store.h>
#include <tetralight/pipeline/stored_bake.h>

namespace tetralight {

struct StoredCubes {
    std::vector<BakedCube> cubes;  ///< one a position
    StoredBake stored;
};

/// Bakes cubes: takes those that stores know, bakes the rest, and saves them on the way. The cubes
/// are those of `bake_cubes`. `light`: hash of all that `sample` depends on. Progress counts what
/// stores know as done. Returns the errors of `bake_cubes`, and that of a save if saving is
/// required.
[[nodiscard]] Result<StoredCubes> bake_stored_cubes(std::span<const CubePosition> positions,
                                                    const CubeSampling& sampling,
                                                    const SampleCube& sample, const StoreKey& light,
                                                    const BakeStorage& storage,
                                                    const BakeCallback& callback = {});

}  // namespace tetralight
