// SPDX-License-Identifier: Apache-2.0
// The last step of a bake of lightmaps: light into pages.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include <tetralight/bake/image/fraction_byte.h>
#include <tetralight/bake/lightmap/fill_texels.h>
#include <tetralight/bake/lightmap/stitch_light.h>
#include <tetralight/bake/lightmap/stitch_seams.h>
#include <tetralight/bake/parallel.h>
#include <tetralight/base/contract.h>
#include <tetralight/base/half.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/pipeline/bake_lightmaps.h>
#include <tetralight/pipeline/probe_warnings.h>
#include <tetralight/pipeline/texel_lights.h>

namespace tetralight {
namespace {

/// How much a texel resists a change at a seam, in squares of differences at places. Texels that
/// were filled have no light of their own.
constexpr double kBakedWeight = 0.0002, kFilledWeight = 0.00002;

std::array<uint16_t, 3> halves(glm::vec3 value, float scale) {
    return {half_from_float_saturated(value.x / scale), half_from_float_saturated(value.y / scale),
            half_from_float_saturated(value.z / scale)};
}

LightmapTexel packed(const TexelLight& light, float scale) {
    return {halves(light.flux, scale),
            {halves(light.vector[0], scale), halves(light.vector[1], scale),
             halves(light.vector[2], scale)}};
}

/// What of its surroundings a texel sees, in [0, 1].
struct TexelVisibility {
    glm::vec4 lights{0.0f};  ///< the lights of the channels
    float surroundings = 0.0f;

    TexelVisibility& operator+=(const TexelVisibility& other) {
        lights += other.lights;
        surroundings += other.surroundings;
        return *this;
    }

    friend TexelVisibility operator*(const TexelVisibility& visibility, float factor) {
        return {visibility.lights * factor, visibility.surroundings * factor};
    }
};

class PageWriter {
  public:
    PageWriter(const PreparedLightmaps& prepared, const TexelBake& bake, const TexelLights& lights)
        : prepared_(prepared),
          bake_(bake),
          lights_(lights),
          baked_index_(prepared.texels.validity.size(), kNoIndex),
          layout_(prepared.settings.bake.plan),
          maps_(prepared.lightmaps) {
        for (uint32_t i = 0; i < prepared.baked.size(); ++i) baked_index_[prepared.baked[i]] = i;
    }

    Lightmaps run(LightmapReport& report) {
        allocate();
        write_scales();
        for_each_instance([&](uint32_t instance) { prepare_instance(instance); });
        SeamStitcher stitcher(prepared_.seams, maps_.info.page_size, [&](uint64_t texel) {
            return is_baked_[texel] != 0 ? kBakedWeight : kFilledWeight;
        });
        for (uint32_t i = 0; i < stitcher.texels().size(); ++i)
            seam_index_[stitcher.texels()[i]] = i;
        write_lights(stitcher, report);
        return std::move(maps_);
    }

  private:
    [[nodiscard]] size_t layer_count() const { return maps_.layers.size(); }

    void allocate() {
        texel_count_ = maps_.view().texel_count();
        resize_texels(layout_, maps_);
        is_baked_.resize(texel_count_);
        seam_index_.assign(texel_count_, kNoIndex);
        fills_.resize(maps_.rectangles.size());
    }

    /// Filled texels are means of baked ones, which bound them.
    void write_scales() {
        const auto count = static_cast<uint32_t>(prepared_.baked.size());
        float largest = 0.0f;
        for (uint32_t i = 0; i < count; ++i)
            largest = std::max(largest, lights_.total(i).largest());
        maps_.info.scale = lightmap_scale(largest);
        for (size_t layer = 0; layer < layer_count(); ++layer) {
            largest = 0.0f;
            for (uint32_t i = 0; i < count; ++i)
                largest = std::max(largest, lights_.layer(i, layer).largest());
            maps_.layers[layer].scale = lightmap_scale(largest);
        }
    }

    template <class Work>
    void for_each_instance(const Work& work) {
        parallel_for(maps_.rectangles.size(), prepared_.settings.bake.thread_count,
                     [&](size_t instance) {
                         if (maps_.rectangles[instance].page != kNoIndex)
                             work(static_cast<uint32_t>(instance));
                     });
    }

    /// All but the light.
    void prepare_instance(uint32_t instance) {
        const LightmapRectangle& place = maps_.rectangles[instance];
        const TexelMap& map = prepared_.maps[place.mesh];
        std::vector<bool> has_light(map.texels.size());
        for (size_t i = 0; i < map.texels.size(); ++i)
            has_light[i] = baked_at(instance, i) != kNoIndex;
        fills_[instance] = make_texel_fill(map, has_light);
        write_facts(instance, map, place);
        write_coverage(map, place, fills_[instance]);
        if (layout_.has_single_values()) write_visibility(instance);
    }

    [[nodiscard]] TexelVisibility visibility_of(uint32_t baked) const {
        const auto row = std::span(bake_.rows).subspan(baked * layout_.size(), layout_.size());
        TexelVisibility visibility;
        for (int i = 0; layout_.has_occlusion && i < 4; ++i) {
            visibility.lights[i] =
                static_cast<float>(row[layout_.occlusion_begin() + static_cast<size_t>(i)]);
        }
        if (layout_.has_ambient_occlusion) {
            visibility.surroundings = static_cast<float>(row[layout_.ambient_occlusion_begin()]);
        }
        return visibility;
    }

    /// Shadow mask and ambient occlusion.
    void write_visibility(uint32_t instance) {
        const auto values =
            filled<TexelVisibility>(instance, [&](uint32_t baked) { return visibility_of(baked); });
        for_each_texel(instance, [&](uint32_t texel, size_t index) {
            for (size_t i = 0; layout_.has_occlusion && i < 4; ++i) {
                maps_.shadow_mask[index][i] =
                    fraction_byte(values[texel].lights[static_cast<int>(i)]);
            }
            if (layout_.has_ambient_occlusion)
                maps_.ambient_occlusion[index] = fraction_byte(values[texel].surroundings);
        });
    }

    /// The values of all texels of an instance: of baked ones as given, of others filled.
    template <class Value, class ValueOf>
    std::vector<Value> filled(uint32_t instance, const ValueOf& value_of_baked) const {
        const TexelMap& map = prepared_.maps[maps_.rectangles[instance].mesh];
        std::vector<Value> values(map.charts.size() + 1, Value{});
        for (size_t i = 0; i < map.texels.size(); ++i) {
            const uint32_t baked = baked_at(instance, i);
            if (baked != kNoIndex) values[map.texels[i].index] = value_of_baked(baked);
        }
        fills_[instance].apply(values);
        return values;
    }

    /// Visits the texels of an instance by their indices in its rectangle and in the pages.
    template <class Visit>
    void for_each_texel(uint32_t instance, const Visit& visit) const {
        const LightmapRectangle& place = maps_.rectangles[instance];
        const TexelMap& map = prepared_.maps[place.mesh];
        for (uint32_t texel = 0; texel < map.charts.size(); ++texel)
            visit(texel, page_index(map, place, texel));
    }

    [[nodiscard]] uint32_t baked_at(uint32_t instance, size_t texel) const {
        return baked_index_[prepared_.texels.first_texel[instance] + texel];
    }

    [[nodiscard]] size_t page_index(const TexelMap& map, const LightmapRectangle& place,
                                    uint32_t texel) const {
        return maps_.info.texel_index(place.page, place.x + texel % map.width,
                                      place.y + texel / map.width);
    }

    /// Writes the light into the pages, stitched at seams.
    void write_lights(SeamStitcher& stitcher, LightmapReport& report) {
        std::vector<TexelLight> total = write_light(std::nullopt, stitcher.texels().size());
        std::vector<std::vector<TexelLight>> layers;
        for (size_t layer = 0; layer < layer_count(); ++layer)
            layers.push_back(write_light(layer, stitcher.texels().size()));
        report.seam_difference_baked = seam_difference(stitcher, total);
        stitch_light(stitcher, seam_normals(stitcher.texels().size()), total, layers,
                     prepared_.settings.bake.thread_count);
        report.seam_difference = seam_difference(stitcher, total);
        for (size_t i = 0; i < total.size(); ++i) {
            store(stitcher.texels()[i], total[i], std::nullopt);
            for (size_t layer = 0; layer < layer_count(); ++layer)
                store(stitcher.texels()[i], layers[layer][i], layer);
        }
    }

    /// Writes the total light or that of a layer into the pages. Returns that of texels at seams.
    std::vector<TexelLight> write_light(std::optional<size_t> layer, size_t seam_texel_count) {
        std::vector<TexelLight> at_seams(seam_texel_count);
        for_each_instance([&](uint32_t instance) {
            const auto values = filled<TexelLight>(instance, [&](uint32_t baked) {
                return layer ? lights_.layer(baked, *layer) : lights_.total(baked);
            });
            for_each_texel(instance, [&](uint32_t texel, size_t index) {
                store(index, values[texel], layer);
                if (seam_index_[index] != kNoIndex) at_seams[seam_index_[index]] = values[texel];
            });
        });
        return at_seams;
    }

    /// Normals of texels at seams that their irradiance is for: 0 where it is for normal maps.
    std::vector<glm::vec3> seam_normals(size_t seam_texel_count) {
        std::vector<glm::vec3> at_seams(seam_texel_count);
        for_each_instance([&](uint32_t instance) {
            const auto normals = filled<glm::vec3>(instance, [&](uint32_t baked) {
                return bake_.mapped_normals_of(baked).empty() ? bake_.normals[baked]
                                                              : glm::vec3(0.0f);
            });
            for_each_texel(instance, [&](uint32_t texel, size_t index) {
                if (seam_index_[index] != kNoIndex) at_seams[seam_index_[index]] = normals[texel];
            });
        });
        return at_seams;
    }

    void store(size_t index, const TexelLight& value, std::optional<size_t> layer) {
        if (!layer) {
            maps_.irradiance[index].rgb = halves(value.irradiance, maps_.info.scale);
            maps_.light[index] = packed(value, maps_.info.scale);
            return;
        }
        const float scale = maps_.layers[*layer].scale;
        maps_.layer_irradiance[*layer * texel_count_ + index].rgb = halves(value.irradiance, scale);
        maps_.layer_light[*layer * texel_count_ + index] = packed(value, scale);
    }

    /// The 99th percentile of relative differences of green irradiance.
    static float seam_difference(const SeamStitcher& stitcher, std::span<const TexelLight> lights) {
        std::vector<double> values;
        for (const TexelLight& light : lights) values.push_back(double{light.irradiance.y});
        return static_cast<float>(stitcher.relative_percentile(values, 0.99));
    }

    /// Validity and error of the texels that surfaces touch.
    void write_facts(uint32_t instance, const TexelMap& map, const LightmapRectangle& place) {
        for (size_t i = 0; i < map.texels.size(); ++i) {
            const size_t index = page_index(map, place, map.texels[i].index);
            const size_t texel = prepared_.texels.first_texel[instance] + i;
            maps_.validity[index] = fraction_byte(prepared_.texels.validity[texel]);
            const uint32_t baked = baked_index_[texel];
            if (baked == kNoIndex) continue;
            is_baked_[index] = 1;
            maps_.error[index] = half_from_float_saturated(lights_.error(baked));
        }
    }

    void write_coverage(const TexelMap& map, const LightmapRectangle& place,
                        const TexelFill& fill) {
        if (fill.steps.empty()) return;
        const auto cover = [&](uint32_t texel) {
            maps_.irradiance[page_index(map, place, texel)].coverage = kCovered;
        };
        for (uint32_t texel = 0; texel < map.charts.size(); ++texel) {
            if (map.charts[texel] != kNoIndex) cover(texel);
        }
        for (const TexelFill::Step& step : fill.steps) {
            if (step.texel < map.charts.size()) cover(step.texel);
        }
    }

    const PreparedLightmaps& prepared_;
    const TexelBake& bake_;
    const TexelLights& lights_;
    std::vector<uint32_t> baked_index_;  ///< of each texel in `prepared.baked`, or kNoIndex
    uint64_t texel_count_ = 0;
    std::vector<TexelFill> fills_;      ///< one an instance
    std::vector<uint8_t> is_baked_;     ///< one a texel of the pages
    std::vector<uint32_t> seam_index_;  ///< of each texel among those at seams, or kNoIndex
    LightGroupLayout layout_;
    Lightmaps maps_;
};

void report_work(const TexelBake& bake, LightmapReport& report) {
    report.cache_seconds += bake.cache_seconds;
    std::vector<uint64_t> samples;
    for (const ProbeAccumulator& sums : bake.accumulators) {
        report.ray_count += sums.ray_count;
        samples.push_back(sums.sample_count);
    }
    if (samples.empty()) return;
    std::ranges::sort(samples);
    report.min_samples = samples.front();
    report.median_samples = samples[(samples.size() - 1) / 2];
    report.max_samples = samples.back();
}

/// `errors`: 0 = unknown.
void report_errors(std::vector<float> errors, double target_error, LightmapReport& report) {
    std::erase(errors, 0.0f);
    if (errors.empty()) return;
    if (target_error > 0.0) {
        report.over_target_count += static_cast<size_t>(std::ranges::count_if(
            errors, [&](float error) { return double{error} > target_error; }));
    }
    const auto middle = errors.begin() + static_cast<ptrdiff_t>(errors.size() / 2);
    std::ranges::nth_element(errors, middle);
    report.median_error = *middle;
    report.worst_error = *std::ranges::max_element(errors);
}

bool is_black(const TexelLights& lights, size_t texel_count) {
    for (uint32_t i = 0; i < texel_count; ++i) {
        if (lights.total(i).largest() > 0.0f) return false;
    }
    return true;
}

}  // namespace

void resize_texels(const LightGroupLayout& layout, Lightmaps& maps) {
    const size_t count = maps.view().texel_count();
    maps.irradiance.resize(count);
    maps.light.resize(count);
    maps.validity.resize(count);
    maps.error.resize(count);
    if (layout.has_occlusion) maps.shadow_mask.resize(count);
    if (layout.has_ambient_occlusion) maps.ambient_occlusion.resize(count);
    maps.layer_irradiance.resize(maps.layers.size() * count);
    maps.layer_light.resize(maps.layers.size() * count);
}

void report_texels(const TexelBake& bake, double target_error, LightmapReport& report) {
    std::vector<float> errors;
    for (const ProbeAccumulator& sums : bake.accumulators)
        errors.push_back(sums.standard_error(ErrorMeasure::OwnNormal));
    report_work(bake, report);
    report_errors(errors, target_error, report);
}

BakedLightmaps finish_lightmaps(PreparedLightmaps prepared, const TexelBake& bake) {
    TETRALIGHT_ASSERT(bake.accumulators.size() == prepared.baked.size(), "one for each texel");
    BakedLightmaps result;
    result.report = std::move(prepared.report);
    LightmapReport& report = result.report;
    const TexelLights lights(prepared, bake);
    result.lightmaps = PageWriter(prepared, bake, lights).run(report);
    const double target_error = prepared.settings.bake.target_error;
    report_work(bake, report);
    report_errors(lights.errors(), target_error, report);
    const size_t count = prepared.baked.size();
    if (count > 0 && is_black(lights, count)) report.warnings.push_back(no_light_warning("texel"));
    if (report.over_target_count > 0) {
        report.warnings.push_back(str_cat(report.over_target_count, " of ", report.baked_count,
                                          " texels have a standard error above ", target_error,
                                          " (the worst ", report.worst_error,
                                          ") with the samples and the time they had"));
    }
    return result;
}

}  // namespace tetralight
