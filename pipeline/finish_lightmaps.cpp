// SPDX-License-Identifier: Apache-2.0
// The last step of a bake of lightmaps: light into pages.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include <tetralight/bake/image/fraction_byte.h>
#include <tetralight/bake/lightmap/fill_texels.h>
#include <tetralight/bake/lightmap/stitch_seams.h>
#include <tetralight/bake/parallel.h>
#include <tetralight/base/contract.h>
#include <tetralight/base/half.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/pipeline/bake_lightmaps.h>
#include <tetralight/pipeline/texel_lights.h>

namespace tetralight {
namespace {

/// The values of a `TexelLight` one by one: irradiance, flux, vector.
constexpr size_t kValueCount = 15;
/// Of these the first ones are not negative: irradiance and flux.
constexpr size_t kPositiveCount = 6;

float& value_of(TexelLight& light, size_t i) {
    if (i < 3) return light.irradiance[static_cast<int>(i)];
    if (i < 6) return light.flux[static_cast<int>(i) - 3];
    const auto k = static_cast<int>(i) - 6;
    return light.vector[k / 3][k % 3];
}

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
        seam_light_.resize(stitcher.texels().size());
        for (uint32_t i = 0; i < seam_light_.size(); ++i) seam_index_[stitcher.texels()[i]] = i;
        write_light(std::nullopt);
        report_seams(stitcher, report.seam_difference_baked);
        hold_zeros(stitcher);
        stitch(stitcher);
        store_seams(stitcher, std::nullopt);
        report_seams(stitcher, report.seam_difference);
        const std::vector<TexelLight> total = seam_light_;
        std::vector<std::vector<TexelLight>> layers;
        for (size_t layer = 0; layer < layer_count(); ++layer) {
            write_light(layer);
            stitch(stitcher);
            layers.push_back(seam_light_);
        }
        add_up(total, layers);
        for (size_t layer = 0; layer < layer_count(); ++layer) {
            seam_light_ = layers[layer];
            store_seams(stitcher, layer);
        }
        return std::move(maps_);
    }

  private:
    [[nodiscard]] size_t layer_count() const { return maps_.layers.size(); }

    void allocate() {
        texel_count_ = maps_.view().texel_count();
        maps_.irradiance.resize(texel_count_);
        maps_.light.resize(texel_count_);
        maps_.validity.resize(texel_count_);
        maps_.error.resize(texel_count_);
        if (layout_.has_occlusion) maps_.shadow_mask.resize(texel_count_);
        if (layout_.has_ambient_occlusion) maps_.ambient_occlusion.resize(texel_count_);
        is_baked_.resize(texel_count_);
        seam_index_.assign(texel_count_, kNoIndex);
        fills_.resize(maps_.rectangles.size());
        maps_.layer_irradiance.resize(layer_count() * texel_count_);
        maps_.layer_light.resize(layer_count() * texel_count_);
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
        if (layout_.has_single_values()) write_visibility(instance, map, place);
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
    void write_visibility(uint32_t instance, const TexelMap& map, const LightmapRectangle& place) {
        std::vector<TexelVisibility> values(map.charts.size() + 1);
        for (size_t i = 0; i < map.texels.size(); ++i) {
            const uint32_t baked = baked_at(instance, i);
            if (baked != kNoIndex) values[map.texels[i].index] = visibility_of(baked);
        }
        fills_[instance].apply(values);
        for (uint32_t texel = 0; texel < map.charts.size(); ++texel) {
            const size_t index = page_index(map, place, texel);
            for (size_t i = 0; layout_.has_occlusion && i < 4; ++i) {
                maps_.shadow_mask[index][i] =
                    fraction_byte(values[texel].lights[static_cast<int>(i)]);
            }
            if (layout_.has_ambient_occlusion)
                maps_.ambient_occlusion[index] = fraction_byte(values[texel].surroundings);
        }
    }

    [[nodiscard]] uint32_t baked_at(uint32_t instance, size_t texel) const {
        return baked_index_[prepared_.texels.first_texel[instance] + texel];
    }

    [[nodiscard]] size_t page_index(const TexelMap& map, const LightmapRectangle& place,
                                    uint32_t texel) const {
        return maps_.info.texel_index(place.page, place.x + texel % map.width,
                                      place.y + texel / map.width);
    }

    /// Writes the total light or that of a layer into the pages, and keeps that of seams.
    void write_light(std::optional<size_t> layer) {
        for_each_instance([&](uint32_t instance) {
            const LightmapRectangle& place = maps_.rectangles[instance];
            const TexelMap& map = prepared_.maps[place.mesh];
            std::vector<TexelLight> values(map.charts.size() + 1);
            for (size_t i = 0; i < map.texels.size(); ++i) {
                const uint32_t baked = baked_at(instance, i);
                if (baked == kNoIndex) continue;
                values[map.texels[i].index] =
                    layer ? lights_.layer(baked, *layer) : lights_.total(baked);
            }
            fills_[instance].apply(values);
            for (uint32_t texel = 0; texel < map.charts.size(); ++texel) {
                const size_t index = page_index(map, place, texel);
                store(index, values[texel], layer);
                if (seam_index_[index] != kNoIndex) seam_light_[seam_index_[index]] = values[texel];
            }
        });
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

    /// Of the total, for all channels and layers.
    void hold_zeros(SeamStitcher& stitcher) const {
        std::vector<double> brightness;
        for (const TexelLight& light : seam_light_)
            brightness.push_back(
                double{light.irradiance.x + light.irradiance.y + light.irradiance.z});
        stitcher.hold_zeros(brightness);
    }

    /// Makes both sides of seams agree.
    void stitch(const SeamStitcher& stitcher) {
        parallel_for(kValueCount, prepared_.settings.bake.thread_count, [&](size_t value) {
            std::vector<double> values;
            for (TexelLight& light : seam_light_) values.push_back(double{value_of(light, value)});
            const bool is_positive = value < kPositiveCount;
            const std::vector<double> stitched = stitcher.stitched(values);
            for (size_t i = 0; i < stitched.size(); ++i) {
                const auto number = static_cast<float>(stitched[i]);
                value_of(seam_light_[i], value) = is_positive ? std::max(0.0f, number) : number;
            }
        });
    }

    void store_seams(const SeamStitcher& stitcher, std::optional<size_t> layer) {
        for (size_t i = 0; i < seam_light_.size(); ++i)
            store(stitcher.texels()[i], seam_light_[i], layer);
    }

    /// Layers that would have become negative are 0, which leaves the others with more than the
    /// total: they get their parts of it.
    static void add_up(const std::vector<TexelLight>& total,
                       std::vector<std::vector<TexelLight>>& layers) {
        for (size_t i = 0; i < total.size(); ++i) {
            TexelLight whole = total[i];
            for (size_t value = 0; value < kPositiveCount; ++value) {
                float sum = 0.0f;
                for (auto& layer : layers) sum += value_of(layer[i], value);
                const float factor = sum > 0.0f ? value_of(whole, value) / sum : 0.0f;
                for (auto& layer : layers) value_of(layer[i], value) *= factor;
            }
        }
    }

    /// The 99th percentile of relative differences of green irradiance.
    void report_seams(const SeamStitcher& stitcher, float& percentile) {
        std::vector<double> values;
        for (TexelLight& light : seam_light_) values.push_back(double{light.irradiance.y});
        percentile = static_cast<float>(stitcher.relative_percentile(values, 0.99));
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
    std::vector<uint32_t> seam_index_;  ///< of each texel in `seam_light_`, or kNoIndex
    std::vector<TexelLight> seam_light_;
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

}  // namespace

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
    if (report.over_target_count > 0) {
        report.warnings.push_back(str_cat(report.over_target_count, " of ", report.baked_count,
                                          " texels have a standard error above ", target_error,
                                          " (the worst ", report.worst_error,
                                          ") with the samples and the time they had"));
    }
    return result;
}

}  // namespace tetralight
