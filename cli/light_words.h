// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tetralight/probes/light.h>

namespace tetralight::cli {

/// "directional", "point", "spot", "rectangle", "disc".
[[nodiscard]] const char* name_of(LightType type);

/// "mixed", "baked", "realtime".
[[nodiscard]] const char* name_of(LightMode mode);

}  // namespace tetralight::cli
