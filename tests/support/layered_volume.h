// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <random>
#include <string>

#include <tetralight/probes/compact_probes.h>
#include <tetralight/probes/recombine.h>
#include "tests/support/random_light.h"
#include "tests/support/random_probes.h"

namespace tetralight::test {

/// Names of the first of these layers: a sun, a lamp and a material.
inline constexpr const char* kLayerNames[] = {"sun", "light:lamp", "material:neon", "sky", "rest"};

/// A volume whose light is the sum of `layer_count` random layers.
inline ProbeVolume make_layered_volume(size_t probe_count, size_t layer_count, uint64_t seed = 1) {
    ProbeVolume volume = make_lit_volume(random_positions(probe_count, seed));
    std::mt19937_64 engine(seed);
    for (size_t k = 0; k < layer_count; ++k) {
        Layer& layer = volume.layers.emplace_back();
        layer.ambient = ringing_light(engine);
        volume.layer_names += std::string(kLayerNames[k]) + "\n";
        std::vector<IrradianceSh> light;
        for (size_t i = 0; i < volume.positions.size(); ++i) light.push_back(ringing_light(engine));
        layer.largest = largest_coefficient(light);
        volume.layer_irradiance.insert(volume.layer_irradiance.end(), light.begin(), light.end());
    }
    return volume;
}

}  // namespace tetralight::test
