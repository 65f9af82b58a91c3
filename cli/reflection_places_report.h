// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

#include <tetralight/bake/scene/reflection_place.h>
#include <tetralight/cli/common.h>

namespace tetralight::cli {

/// The places of reflection probes as an array of objects.
[[nodiscard]] Json reflection_places_json(std::span<const ReflectionPlace> places);

/// The same as a table, for the file that they were written to.
[[nodiscard]] std::string reflection_places_text(const std::string& path,
                                                 std::span<const ReflectionPlace> places);

}  // namespace tetralight::cli
