// SPDX-License-Identifier: Apache-2.0
#include <tetralight/render/health_balls.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <optional>

namespace tetralight {
namespace {

constexpr glm::vec3 kBad(0.85f, 0.13f, 0.10f);
constexpr glm::vec3 kFair(0.97f, 0.80f, 0.22f);
constexpr glm::vec3 kGood(0.08f, 0.58f, 0.66f);
constexpr glm::vec3 kUnknown(0.6f);

/// Colour of a grade: 0 = bad, 1/2 = fair, 1 = good.
glm::vec3 color_of_grade(float grade) {
    const float t = 2.0f * std::clamp(grade, 0.0f, 1.0f);
    return t < 1.0f ? glm::mix(kBad, kFair, t) : glm::mix(kFair, kGood, t - 1.0f);
}

/// 0 = bad, 1/2 = fair, 1 = good.
float validity_grade(float validity) {
    constexpr float kFairValidity = 0.75f;
    return validity < kFairValidity ? 0.5f * validity / kFairValidity
                                    : 0.5f + 2.0f * (validity - kFairValidity);
}

/// 0 = bad, 1/2 = fair, 1 = good; empty if the volume does not store the quantity.
std::optional<float> grade(const ProbeVolumeView& volume, uint32_t probe, ProbeColor quantity) {
    if (quantity == ProbeColor::Validity) {
        if (volume.validity.empty()) return std::nullopt;
        return validity_grade(volume.validity[probe]);
    }
    const float error = volume.health.empty() ? 0.0f : volume.health[probe].standard_error;
    if (!(error > 0.0f)) return std::nullopt;
    return -0.5f - 0.5f * std::log10(error);
}

uint8_t blended(uint8_t below, float above, float coverage) {
    return static_cast<uint8_t>(std::lround((1.0f - coverage) * below + 255.0f * above));
}

}  // namespace

glm::vec3 validity_color(float validity) {
    return color_of_grade(validity_grade(validity));
}

glm::vec3 health_color(const ProbeVolumeView& volume, uint32_t probe, ProbeColor quantity) {
    const auto known = grade(volume, probe, quantity);
    return known ? color_of_grade(*known) : kUnknown;
}

void draw_health_balls(Image8& image, const Camera& camera, const RenderSettings& settings,
                       const HidingDistance& surfaces, const LightBalls& balls,
                       const ProbeVolumeView& volume, ProbeColor quantity) {
    // Most probes of poor health are inside walls, where a surface would hide them.
    const auto opacity = [&](const LightBalls::Hit& ball, const glm::dvec3& origin,
                             glm::vec3 direction) {
        if (ball.distance < surfaces(origin, direction)) return 1.0f;
        return grade(volume, ball.ball, quantity).value_or(1.0f) < 0.5f ? 0.5f : 0.0f;
    };
    const ImageF coverage =
        render_view(camera, settings, [&](const glm::dvec3& origin, glm::vec3 direction) {
            const auto ball = balls.find(origin, direction);
            return glm::vec3(ball ? opacity(*ball, origin, direction) : 0.0f);
        });
    const ImageF color =
        render_view(camera, settings, [&](const glm::dvec3& origin, glm::vec3 direction) {
            const auto ball = balls.find(origin, direction);
            if (!ball) return glm::vec3(0.0f);
            // Darker towards the rim, so that balls look round.
            const float facing = std::max(0.0f, -glm::dot(ball->normal, direction));
            return health_color(volume, ball->ball, quantity) *
                   ((0.6f + 0.4f * facing) * opacity(*ball, origin, direction));
        });
    for (size_t i = 0; i < image.pixels.size(); ++i) {
        for (int channel = 0; channel < 3; ++channel) {
            uint8_t& value = image.pixels[i][static_cast<size_t>(channel)];
            value = blended(value, color.pixels[i][channel], coverage.pixels[i].x);
        }
    }
}

}  // namespace tetralight
