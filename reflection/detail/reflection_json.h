// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <tetralight/reflection/reflections.h>

namespace tetralight::detail {

/// Reflection probes without their texels as a JSON object, for other programs
/// (docs/file_format.md). Precondition: the probes pass `verify`, and there are as many names, or
/// none.
[[nodiscard]] std::string reflection_json(const Reflections& reflections);

}  // namespace tetralight::detail
