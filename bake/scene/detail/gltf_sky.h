// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <tetralight/base/result.h>

namespace tetralight::detail {

/// Writes `extras.sky` of each scene as an object with a radiance, where it is three numbers, one
/// number, or a string of JSON of these or of the object: dialogs for properties offer no more.
/// Returns corrupt for anything else.
[[nodiscard]] Status expand_skies(nlohmann::json& document);

}  // namespace tetralight::detail
