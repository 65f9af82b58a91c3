// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <tetralight/base/result.h>
#include <tetralight/pipeline/resumable_bake.h>

namespace tetralight {

/// Bakes all probes in chunks of some, and keeps each finished chunk as a file of a folder:
/// `BEGIN-END-of-COUNT.chunk`. It is whole and on the disk, name and all, when it is there. Goes on
/// with the chunks of the folder that are of this bake, whatever their sizes, and bakes anew what
/// is damaged. The same accumulators as a bake in one piece.
///
/// The folder is made when it is not there; it is the caller's to remove. Errors beside those of
/// `bake_accumulators`: a chunk cannot be written.
[[nodiscard]] Result<RangeBake> bake_in_chunks(const Scene& scene, const PreparedBake& prepared,
                                               const std::string& folder,
                                               const BakeCallback& callback = {});

}  // namespace tetralight
