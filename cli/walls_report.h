// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <tetralight/cli/common.h>
#include <tetralight/pipeline/bake_volume.h>

// What bakes find of walls, as `bake`, `merge`, `info` and `validate` report it.

namespace tetralight::cli {

/// null: of a volume without edges. Without "rays" if they are not known.
[[nodiscard]] Json to_json(const VisibilityReport& walls);

/// "walls block 12 of 345 edges; 6 cells with surfaces that edges do not show". Empty without
/// edges.
[[nodiscard]] std::string to_text(const VisibilityReport& walls);

/// null: no free place was looked at.
[[nodiscard]] Json to_json(const UnseenPlaces& unseen);

/// "1.2 % of free space sees no probe of its cell, for example at (1, 0.5, 2), (4, 0.5, 2)": three
/// positions at most.
[[nodiscard]] std::string to_text(const UnseenPlaces& unseen);

/// Both as lines of a bake's report, each after a line break, with the time that they took.
[[nodiscard]] std::string walls_text(const BakeReport& report);

/// "(1, 0.5, -2)", to a millimetre.
[[nodiscard]] std::string position_text(const glm::dvec3& position);

}  // namespace tetralight::cli
