// SPDX-License-Identifier: Apache-2.0
#include <tetralight/render/seam_lines.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <tetralight/bake/lightmap/seams.h>
#include <tetralight/lightmap/directional_light.h>
#include <tetralight/lightmap/sample_lightmap.h>
#include <tetralight/pipeline/lightmap_scene.h>

namespace tetralight {
namespace {

const LineStyle kGoodStyle{{0.08f, 0.58f, 0.66f}, 0.9f, 0.05f, 1.4f};
const LineStyle kFairStyle{{0.97f, 0.80f, 0.22f}, 0.95f, 0.05f, 1.8f};
const LineStyle kBadStyle{{0.85f, 0.13f, 0.10f}, 1.0f, 0.05f, 2.2f};

/// Light on both sides of one place of a seam.
struct Sides {
    float first = 0.0f, second = 0.0f;

    [[nodiscard]] float mean() const { return 0.5f * (first + second); }
};

float luminance_at(const LightmapsView& lightmaps, const PageEdge& edge, float t) {
    const auto size = static_cast<float>(lightmaps.info.page_size);
    const glm::vec2 uv = glm::mix(edge.begin, edge.end, t) / size;
    return glm::dot(sample_irradiance(lightmaps, edge.page, uv), kLuminanceWeights);
}

/// Two places a texel of the longer side.
std::vector<Sides> sides_along(const Seam& seam, const LightmapsView& lightmaps) {
    const float length = std::max(glm::distance(seam.first.begin, seam.first.end),
                                  glm::distance(seam.second.begin, seam.second.end));
    const auto count = static_cast<uint32_t>(std::ceil(2.0f * length)) + 1;
    std::vector<Sides> sides;
    for (uint32_t i = 0; i < count; ++i) {
        const float t = (static_cast<float>(i) + 0.5f) / static_cast<float>(count);
        sides.push_back(
            {luminance_at(lightmaps, seam.first, t), luminance_at(lightmaps, seam.second, t)});
    }
    return sides;
}

}  // namespace

std::vector<GizmoLines> make_seam_lines(const Scene& scene, const LightmapsView& lightmaps) {
    const std::vector<bool> all(scene.instances.size(), true);
    const std::vector<Seam> seams = find_seams(scene, layout_of(lightmaps, scene), all);
    std::vector<std::vector<Sides>> sides;
    double sum = 0.0;
    size_t count = 0;
    for (const Seam& seam : seams) {
        sides.push_back(sides_along(seam, lightmaps));
        for (const Sides& place : sides.back()) sum += static_cast<double>(place.mean());
        count += sides.back().size();
    }
    const auto floor =
        static_cast<float>(0.01 * sum / static_cast<double>(std::max<size_t>(count, 1)));
    std::vector<GizmoLines> lines{{{}, kGoodStyle}, {{}, kFairStyle}, {{}, kBadStyle}};
    for (size_t i = 0; i < seams.size(); ++i) {
        float worst = 0.0f;
        for (const Sides& place : sides[i]) {
            const float light = std::max(place.mean(), floor);
            if (light > 0.0f) worst = std::max(worst, std::abs(place.first - place.second) / light);
        }
        const size_t group = worst <= 0.01f ? 0 : worst <= 0.1f ? 1 : 2;
        lines[group].lines.push_back(seams[i].ends);
    }
    return lines;
}

}  // namespace tetralight
