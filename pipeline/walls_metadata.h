// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include <tetralight/pipeline/bake_visibility.h>
#include <tetralight/pipeline/unseen_places.h>

namespace tetralight {

/// What a bake found of walls and its volume's sections do not have, or have only after a search.
/// The metadata of the volume keeps it, as the member "walls".
struct WallsMetadata {
    /// As in `VisibilityReport`. The first three are 0 in files of versions that did not keep them.
    uint64_t edge_count = 0;
    uint64_t blocked_edge_count = 0;
    uint64_t marked_cell_count = 0;
    uint64_t unclear_cell_count = 0;
    uint64_t left_out_count = 0;
    UnseenPlaces unseen;

    bool operator==(const WallsMetadata&) const = default;
};

/// The metadata with its member "walls". Precondition: the metadata is a JSON object.
[[nodiscard]] std::string add_walls(std::string_view metadata, const WallsMetadata& walls);

/// None if the metadata has no member "walls", or one that `add_walls` does not write.
[[nodiscard]] std::optional<WallsMetadata> read_walls(std::string_view metadata);

/// The visibility report of a baked volume from its metadata and its sections: without the rays and
/// the time that it took. Precondition: the volume passes `verify`.
[[nodiscard]] VisibilityReport stored_visibility(const ProbeVolumeView& volume);

}  // namespace tetralight
