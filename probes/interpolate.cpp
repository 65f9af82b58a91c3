// SPDX-License-Identifier: Apache-2.0
#include "probes/interpolate.h"

#include "base/text.h"

namespace tetralight {
namespace {

IrradianceSh blend_irradiance(const ProbeVolumeView& volume, const Cell& cell, glm::vec4 weights) {
    IrradianceSh blend;
    for (int i = 0; i < 4; ++i) {
        const uint32_t probe = cell.vertices[i];
        if (weights[i] == 0.0f || probe >= volume.irradiance.size()) continue;
        const IrradianceSh& source = volume.irradiance[probe];
        for (int k = 0; k < kShCoefficientCount; ++k) {
            blend.coefficients[k] += weights[i] * source.coefficients[k];
        }
    }
    return blend;
}

glm::vec4 blend_occlusion(const ProbeVolumeView& volume, const Cell& cell, glm::vec4 weights) {
    glm::vec4 blend(0.0f);
    for (int i = 0; i < 4; ++i) {
        const uint32_t probe = cell.vertices[i];
        if (weights[i] == 0.0f || probe >= volume.occlusion.size()) continue;
        blend += weights[i] * volume.occlusion[probe];
    }
    return blend;
}

Status check_length(const char* name, size_t length, size_t needed) {
    if (length == 0 || length >= needed) return Ok{};
    return Error{text(name, " holds ", length, " elements, but there are ", needed, " positions")};
}

Status check(const InterpolationBatch& batch) {
    const size_t count = batch.positions.size();
    if (count > 0 && batch.irradiance.empty() && batch.occlusion.empty()) {
        return Error{"neither irradiance nor occlusion is asked for"};
    }
    if (auto status = check_length("hints", batch.hints.size(), count); !status) return status;
    if (auto status = check_length("irradiance", batch.irradiance.size(), count); !status) {
        return status;
    }
    return check_length("occlusion", batch.occlusion.size(), count);
}

}  // namespace

InterpolatedProbe interpolate(const ProbeVolumeView& volume,
                              const CellLocation& location) noexcept {
    InterpolatedProbe result{volume.info.ambient, glm::vec4(1.0f)};
    if (location.cell >= volume.cells.size()) return result;
    const Cell& cell = volume.cells[location.cell];
    if (!volume.irradiance.empty()) {
        result.irradiance = blend_irradiance(volume, cell, location.weights);
    }
    if (!volume.occlusion.empty()) {
        result.occlusion = blend_occlusion(volume, cell, location.weights);
    }
    return result;
}

Status interpolate(const ProbeVolumeView& volume, const InterpolationBatch& batch) {
    if (auto status = check(batch); !status) return status;
    uint32_t previous = kNoIndex;
    for (size_t i = 0; i < batch.positions.size(); ++i) {
        const uint32_t hint = batch.hints.empty() ? previous : batch.hints[i];
        const CellLocation location = locate(volume, batch.positions[i], hint);
        const InterpolatedProbe probe = interpolate(volume, location);
        if (!batch.hints.empty()) batch.hints[i] = location.cell;
        if (!batch.irradiance.empty()) batch.irradiance[i] = probe.irradiance;
        if (!batch.occlusion.empty()) batch.occlusion[i] = probe.occlusion;
        previous = location.cell;
    }
    return Ok{};
}

}  // namespace tetralight
