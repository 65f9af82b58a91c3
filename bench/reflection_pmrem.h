// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <tetralight/bake/reflection/cube_image.h>

namespace tetralight::bench {

/// For viewer/bench/pmrem.ts, which compares with three.js: NAME.halves has the texels of a cube in
/// halves, NAME.json the light of GGX lobes of several roughnesses around 2000 directions: by the
/// sum over the texels, and as our levels give it.
void write_pmrem_subject(const std::string& folder, const std::string& name, const CubeImage& cube);

/// The same of two cubes that any filter must leave as they are, but for factors: "constant" and
/// "gradient", whose light is linear in the direction and differs along each axis.
void write_pmrem_checks(const std::string& folder, uint32_t size);

}  // namespace tetralight::bench
