// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tetralight/bake/bake_progress.h>
#include <tetralight/bake/radiance_cache.h>
#include <tetralight/bake/scene/scene.h>
#include <tetralight/base/result.h>
#include <tetralight/pipeline/bake_lightmaps.h>
#include <tetralight/pipeline/bake_store.h>

namespace tetralight {

/// The radiance cache of a bake of lightmaps: the one that the store has, else a new one, which the
/// store then keeps. Null: it is made and not kept. Returns the errors of `make_radiance_cache`,
/// and that of the store if it cannot be written.
[[nodiscard]] Result<RadianceCache> stored_radiance_cache(const Scene& scene,
                                                          const PreparedLightmaps& prepared,
                                                          BakeStore* store,
                                                          const BakeCallback& callback = {});

}  // namespace tetralight
