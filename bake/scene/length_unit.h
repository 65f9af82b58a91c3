// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <tetralight/bake/scene/scene.h>

namespace tetralight {

/// What an error about too many probes or texels adds if the scene is so large that its unit may be
/// a centimetre: `the scene is 2000 m wide; ...`. Empty if it is smaller than 500 m.
[[nodiscard]] std::string length_unit_hint(const Scene& scene);

}  // namespace tetralight
