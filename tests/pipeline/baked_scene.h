// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <optional>
#include <utility>
#include <vector>

#include <tetralight/bake/lightmap/stitch_seams.h>
#include <tetralight/bake/scene/scene_bounds.h>
#include <tetralight/base/error_text.h>
#include <tetralight/base/half.h>
#include <tetralight/lightmap/sample_lightmap.h>
#include <tetralight/pipeline/bake_lightmaps.h>
#include <tetralight/pipeline/lightmap_scene.h>

namespace tetralight::test {

inline BakeLightmapsSettings lightmap_settings(uint32_t samples, double texels_per_meter = 10.0) {
    BakeLightmapsSettings settings;
    settings.layout.texels_per_meter = texels_per_meter;
    settings.layout.page_size = 256;
    settings.bake.sample_count = samples;
    return settings;
}

/// Irradiance of a convex polygon of radiance 1 that lies in front of a surface (Lambert 1760).
inline double polygon_irradiance(glm::dvec3 position, glm::dvec3 normal,
                                 const std::vector<glm::dvec3>& corners) {
    double sum = 0.0;
    for (size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec3 a = glm::normalize(corners[i] - position);
        const glm::dvec3 b = glm::normalize(corners[(i + 1) % corners.size()] - position);
        const glm::dvec3 cross = glm::cross(a, b);
        const double sine = glm::length(cross);
        if (sine > 0.0) sum += std::atan2(sine, glm::dot(a, b)) * glm::dot(cross, normal) / sine;
    }
    return 0.5 * std::abs(sum);
}

/// Irradiance of the sides of a box of radiance 1 on a floor that looks up, beside the box.
inline double irradiance_of_sides(glm::dvec3 position, glm::dvec3 low, glm::dvec3 high) {
    double sum = 0.0;
    for (const int axis : {0, 2}) {
        const int other = 2 - axis;
        const bool is_above = position[axis] > high[axis];
        if (!is_above && position[axis] >= low[axis]) continue;
        std::vector<glm::dvec3> side(4, low);
        for (glm::dvec3& corner : side) corner[axis] = is_above ? high[axis] : low[axis];
        side[1][other] = side[2][other] = high[other];
        side[0].y = side[1].y = std::max(low.y, position.y);
        side[2].y = side[3].y = high.y;
        sum += polygon_irradiance(position, {0, 1, 0}, side);
    }
    return sum;
}

/// A texel whose light was sampled.
struct SampledTexel {
    glm::dvec3 position{0.0};
    std::vector<glm::dvec3> places;  ///< where its light was sampled
    double irradiance = 0.0;         ///< green
    double error = 0.0;              ///< one standard error of it
    double own_error = 0.0;          ///< the same before it was filtered
};

/// The lightmaps of a scene, by places in the world.
class BakedScene {
  public:
    BakedScene(Scene scene, const BakeLightmapsSettings& settings) : scene_(std::move(scene)) {
        auto prepared = prepare_lightmaps(scene_, settings);
        EXPECT_TRUE(prepared) << (prepared ? "" : error_text(prepared.error()));
        if (!prepared) return;
        prepared_ = *prepared;
        const auto bake = bake_texels(scene_, prepared_);
        EXPECT_TRUE(bake) << (bake ? "" : error_text(bake.error()));
        if (!bake) return;
        own_errors_.resize(prepared_.texels.positions.size());
        for (size_t i = 0; i < bake->accumulators.size(); ++i) {
            own_errors_[prepared_.baked[i]] =
                double{bake->accumulators[i].standard_error(ErrorMeasure::OwnNormal)};
        }
        result_ = finish_lightmaps(std::move(*prepared), *bake);
    }

    [[nodiscard]] const Lightmaps& maps() const { return result_.lightmaps; }

    [[nodiscard]] const LightmapReport& report() const { return result_.report; }

    [[nodiscard]] const PreparedLightmaps& prepared() const { return prepared_; }

    /// The sampled texels of an instance.
    [[nodiscard]] std::vector<SampledTexel> texels(uint32_t instance) const {
        const LightmapTexels& all = prepared_.texels;
        const LightmapPlace& place = prepared_.layout.places[instance];
        const TexelMap& map = prepared_.maps[place.packing];
        std::vector<SampledTexel> found;
        for (size_t i = 0; i < map.texels.size(); ++i) {
            const size_t texel = all.first_texel[instance] + i;
            if (!all.is_valid(texel)) continue;
            const uint32_t index = map.texels[i].index;
            const size_t at =
                maps().info.texel_index(place.corner.page, place.corner.x + index % map.width,
                                        place.corner.y + index / map.width);
            SampledTexel sampled;
            sampled.position = all.positions[texel];
            for (const glm::vec3& offset : all.view()[texel].origins)
                sampled.places.push_back(sampled.position + glm::dvec3(offset));
            sampled.irradiance =
                double{float_from_half(maps().irradiance[at].rgb[1]) * maps().info.scale};
            sampled.error = double{float_from_half(maps().error[at])} * sampled.irradiance;
            sampled.own_error = own_errors_[texel] * sampled.irradiance;
            found.push_back(std::move(sampled));
        }
        return found;
    }

    /// Bilinear green irradiance at a place on an instance.
    [[nodiscard]] double irradiance_at(uint32_t instance, glm::dvec3 position) const {
        const std::optional<uint32_t> triangle = triangle_at(instance, position);
        EXPECT_TRUE(triangle) << position.x << ' ' << position.y << ' ' << position.z;
        return triangle ? irradiance_at(instance, *triangle, position) : 0.0;
    }

    [[nodiscard]] double irradiance_at(uint32_t instance, uint32_t triangle,
                                       glm::dvec3 position) const {
        const LightmapsView view = maps().view();
        const glm::vec2 uv = page_uv_of(view, scene_, instance, triangle, position);
        return double{sample_irradiance(view, view.rectangles[instance].page, uv).y};
    }

    /// The largest difference of the green irradiance of both sides of a seam.
    [[nodiscard]] double worst_seam() const {
        const SeamStitcher seams(prepared_.seams, maps().info.page_size,
                                 [](uint64_t) { return 1.0; });
        std::vector<double> values;
        for (const uint64_t texel : seams.texels()) {
            values.push_back(
                double{float_from_half(maps().irradiance[texel].rgb[1]) * maps().info.scale});
        }
        double worst = 0.0;
        for (const double difference : seams.differences(values))
            worst = std::max(worst, std::abs(difference));
        return worst;
    }

    /// The corners of a triangle in the world.
    [[nodiscard]] std::array<glm::dvec3, 3> corners(uint32_t instance, uint32_t triangle) const {
        const MeshInstance& object = scene_.instances[instance];
        const Mesh& mesh = scene_.meshes[object.mesh];
        std::array<glm::dvec3, 3> found{};
        for (size_t i = 0; i < 3; ++i) {
            found[i] =
                world_position(object, mesh.positions[mesh.indices[3 * size_t{triangle} + i]]);
        }
        return found;
    }

  private:
    [[nodiscard]] std::optional<uint32_t> triangle_at(uint32_t instance,
                                                      glm::dvec3 position) const {
        const Mesh& mesh = scene_.meshes[scene_.instances[instance].mesh];
        for (uint32_t i = 0; i < mesh.indices.size() / 3; ++i) {
            const auto [a, b, c] = corners(instance, i);
            const glm::dvec3 normal = glm::cross(b - a, c - a);
            const double area2 = glm::dot(normal, normal);
            const double v = glm::dot(glm::cross(position - a, c - a), normal) / area2;
            const double w = glm::dot(glm::cross(b - a, position - a), normal) / area2;
            const double off = glm::dot(position - a, normal) / std::sqrt(area2);
            if (std::min({v, w, 1.0 - v - w}) > -1e-6 && std::abs(off) < 1e-4) return i;
        }
        return std::nullopt;
    }

    Scene scene_;
    PreparedLightmaps prepared_;
    BakedLightmaps result_;
    std::vector<double> own_errors_;  ///< relative, of all texels
};

/// Expects the light of texels to be the mean of light(place) over their places, within their error
/// bars and the rounding of halves; and the mean of all texels within that of them all, which
/// filtering does not change: neighbors share their errors.
template <class LightAt>
void expect_light(const std::vector<SampledTexel>& texels, const LightAt& light) {
    ASSERT_FALSE(texels.empty());
    const auto count = static_cast<double>(texels.size());
    double errors2 = 0.0, own_errors2 = 0.0, differences2 = 0.0, bias = 0.0, rounding = 0.0;
    std::vector<double> differences;
    for (const SampledTexel& texel : texels) {
        double mean = 0.0;
        for (const glm::dvec3& place : texel.places) mean += light(place);
        mean /= static_cast<double>(texel.places.size());
        differences.push_back(texel.irradiance - mean);
        rounding = std::max(rounding, 0x1p-11 * mean);
        errors2 += texel.error * texel.error / count;
        own_errors2 += texel.own_error * texel.own_error / count;
        differences2 += differences.back() * differences.back() / count;
        bias += differences.back() / count;
    }
    const double error = std::sqrt(errors2);
    EXPECT_LE(std::sqrt(differences2), 1.4 * error + rounding);
    EXPECT_LE(std::abs(bias), 4.0 * std::sqrt(own_errors2 / count) + rounding);
    double worst = 0.0;
    for (size_t i = 0; i < texels.size(); ++i) {
        const double bar = std::max(error, texels[i].error);
        worst = std::max(worst, (std::abs(differences[i]) - rounding) / bar);
    }
    EXPECT_LE(worst, 6.0);
}

}  // namespace tetralight::test
