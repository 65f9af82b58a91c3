// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "tests/support/random_probes.h"

namespace tetralight::test {

/// Positions as three groups, none of them empty unless there are too few.
inline std::vector<ProbeGroup> in_three_groups(const std::vector<glm::dvec3>& positions) {
    std::vector<ProbeGroup> groups(3);
    for (size_t g = 0; g < groups.size(); ++g) {
        groups[g].name = std::string(1, static_cast<char>('a' + g));
        const size_t begin = g * positions.size() / 3, end = (g + 1) * positions.size() / 3;
        groups[g].positions.assign(positions.begin() + static_cast<std::ptrdiff_t>(begin),
                                   positions.begin() + static_cast<std::ptrdiff_t>(end));
    }
    return groups;
}

/// Light between `low` and `high` that has nothing to do with the neighbors'.
inline IrradianceSh random_light(std::mt19937_64& engine, float low, float high) {
    std::uniform_real_distribution<float> value(low, high);
    IrradianceSh sh;
    for (glm::vec3& coefficient : sh.coefficients) {
        coefficient = {value(engine), value(engine), value(engine)};
    }
    return sh;
}

/// A volume over three groups whose probes are lit at random, each group brighter than the one
/// before.
inline ProbeVolume make_random_volume(const std::vector<glm::dvec3>& positions, uint64_t seed) {
    ProbeVolume volume = make_probe_volume(*merge(in_three_groups(positions)));
    std::mt19937_64 engine(seed);
    std::vector<float> brightness(volume.positions.size());
    for (const ProbeSource& source : volume.sources) {
        brightness[source.probe] = static_cast<float>(source.group);
    }
    for (const float low : brightness) {
        volume.irradiance.push_back(random_light(engine, 0.5f + low, 1.5f + low));
    }
    return volume;
}

}  // namespace tetralight::test
