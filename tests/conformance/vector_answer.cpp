// SPDX-License-Identifier: Apache-2.0
#include "tests/conformance/vector_answer.h"

#include <array>

#include <tetralight/base/contract.h>
#include <tetralight/probes/recombine.h>

namespace tetralight::conformance {

std::span<const glm::vec3> vector_normals() {
    static constexpr std::array<glm::vec3, 2> kNormals{{{0.0f, 1.0f, 0.0f}, {0.48f, -0.6f, 0.64f}}};
    return kNormals;
}

ProbeVolume volume_with_options(const ProbeVolumeView& volume, const VectorOptions& options) {
    ProbeVolume copy = copy_volume(volume);
    if (!options.layer_weights.empty()) {
        const Status status = recombine(copy, options.layer_weights);
        TETRALIGHT_ASSERT(static_cast<bool>(status), "there is one weight a layer");
    }
    if (options.precision == Precision::Full) copy.compact.clear();
    return copy;
}

VectorAnswer answer_vector(const ProbeVolumeView& volume, const VectorOptions& options,
                           const VectorPosition& at) {
    VectorAnswer answer{at, {}, {}, {}, {}};
    glm::vec3 position = at.position;
    if (options.normal_offset) {
        position = push_off_surface(volume, position, at.normal, locate(volume, position),
                                    *options.normal_offset);
    }
    answer.location = locate(volume, position, kNoIndex, options.outside);
    answer.visible = visible_location(volume, answer.location, options.receiver);
    answer.light = interpolate(volume, answer.location, options.receiver);
    for (const glm::vec3& normal : vector_normals()) {
        answer.irradiance.push_back(evaluate_irradiance(answer.light.irradiance, normal));
    }
    return answer;
}

std::vector<uint32_t> probes_of(const ProbeVolumeView& volume, const CellLocation& location) {
    std::vector<uint32_t> probes;
    if (location.cell >= volume.cells.size()) return probes;
    for (const uint32_t probe : volume.cells[location.cell].vertices) {
        if (probe != kNoIndex) probes.push_back(probe);
    }
    return probes;
}

}  // namespace tetralight::conformance
