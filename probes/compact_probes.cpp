// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/compact_probes.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/packing.hpp>

namespace tetralight {
namespace {

/// Halves have 11 bits, and below 2^-14 a step of 2^-24.
bool is_rounded(uint16_t half, float value) {
    const float step = std::max(std::abs(value) * 0x1p-10f, 0x1p-24f);
    return std::isfinite(value) && std::abs(glm::unpackHalf1x16(half) - value) <= step;
}

bool is_rounded(const CompactProbe& compact, const ProbeVolumeView& volume, size_t probe) {
    for (size_t k = 0; k < compact.irradiance.size(); ++k) {
        const auto& coefficient = volume.irradiance[probe].coefficients[k / 3];
        const float value = coefficient[static_cast<int>(k % 3)] / volume.info.compact_scale;
        if (!is_rounded(compact.irradiance[k], value)) return false;
    }
    const glm::vec4 occlusion =
        volume.occlusion.empty() ? glm::vec4(1.0f) : volume.occlusion[probe];
    for (size_t k = 0; k < compact.occlusion.size(); ++k) {
        if (!is_rounded(compact.occlusion[k], occlusion[static_cast<int>(k)])) return false;
    }
    return is_rounded(compact.validity, volume.validity.empty() ? 1.0f : volume.validity[probe]);
}

/// Precondition: there is irradiance, and the scale is set.
CompactProbe compacted(const ProbeVolume& volume, size_t i) {
    CompactProbe probe;
    for (size_t k = 0; k < probe.irradiance.size(); ++k) {
        const float value = volume.irradiance[i].coefficients[k / 3][static_cast<int>(k % 3)];
        probe.irradiance[k] = glm::packHalf1x16(value / volume.info.compact_scale);
    }
    const glm::vec4 occlusion = volume.occlusion.empty() ? glm::vec4(1.0f) : volume.occlusion[i];
    for (int k = 0; k < 4; ++k) {
        probe.occlusion[static_cast<size_t>(k)] = glm::packHalf1x16(occlusion[k]);
    }
    probe.validity = glm::packHalf1x16(volume.validity.empty() ? 1.0f : volume.validity[i]);
    return probe;
}

}  // namespace

float largest_coefficient(std::span<const IrradianceSh> irradiance) noexcept {
    float largest = 0.0f;
    for (const IrradianceSh& sh : irradiance) {
        for (const glm::vec3& c : sh.coefficients) {
            largest = std::max({largest, std::abs(c.x), std::abs(c.y), std::abs(c.z)});
        }
    }
    return largest;
}

float compact_scale(float largest) noexcept {
    constexpr int kLargestExponent = 12;
    int exponent = 0;
    const float fraction = std::frexp(largest, &exponent);  // largest = fraction · 2^exponent
    if (fraction == 0.5f) --exponent;
    constexpr int kSmallestExponent = -126;  // of normal floats
    return std::ldexp(1.0f, std::max(exponent - kLargestExponent, kSmallestExponent));
}

void make_compact_probes(ProbeVolume& volume) {
    volume.compact.clear();
    volume.info.compact_scale = 0.0f;
    if (volume.irradiance.empty()) return;
    volume.info.compact_scale = compact_scale(largest_coefficient(volume.irradiance));
    volume.compact.resize(volume.irradiance.size());
    for (size_t i = 0; i < volume.compact.size(); ++i) volume.compact[i] = compacted(volume, i);
}

void update_compact_probes(ProbeVolume& volume, std::span<const uint32_t> changed) {
    float scale = volume.info.compact_scale;
    for (const uint32_t i : changed) {
        if (i >= volume.irradiance.size()) break;
        scale = std::max(scale, compact_scale(largest_coefficient({&volume.irradiance[i], 1})));
    }
    if (volume.irradiance.empty() || volume.compact.empty() || scale > volume.info.compact_scale) {
        return make_compact_probes(volume);
    }
    const size_t old_size = volume.compact.size();
    volume.compact.resize(volume.irradiance.size());
    for (size_t i = old_size; i < volume.compact.size(); ++i)
        volume.compact[i] = compacted(volume, i);
    for (const uint32_t i : changed) volume.compact[i] = compacted(volume, i);
}

uint32_t count_wrong_compact_probes(const ProbeVolumeView& volume) noexcept {
    if (volume.irradiance.empty()) return 0;
    uint32_t count = 0;
    for (size_t probe = 0; probe < volume.compact.size(); ++probe) {
        count += !is_rounded(volume.compact[probe], volume, probe);
    }
    return count;
}

IrradianceSh compact_irradiance(const CompactProbe& probe, float scale) noexcept {
    IrradianceSh sh;
    for (size_t k = 0; k < probe.irradiance.size(); ++k) {
        sh.coefficients[k / 3][static_cast<int>(k % 3)] =
            glm::unpackHalf1x16(probe.irradiance[k]) * scale;
    }
    return sh;
}

glm::vec4 compact_occlusion(const CompactProbe& probe) noexcept {
    return {glm::unpackHalf1x16(probe.occlusion[0]), glm::unpackHalf1x16(probe.occlusion[1]),
            glm::unpackHalf1x16(probe.occlusion[2]), glm::unpackHalf1x16(probe.occlusion[3])};
}

}  // namespace tetralight
