// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/split_light.h>

#include <algorithm>

#include <tetralight/bake/layer_errors.h>
#include <tetralight/base/contract.h>
#include <tetralight/probes/compact_probes.h>
#include <tetralight/probes/recombine.h>

namespace tetralight {
namespace {

/// Clamped-cosine factors A_l of each coefficient.
constexpr double cosine_factor(int i) {
    constexpr double kPi = 3.14159265358979323846;
    return i == 0 ? kPi : i < 4 ? 2.0 * kPi / 3.0 : kPi / 4.0;
}

IrradianceSh irradiance_from_row(std::span<const double> row, double sample_count) {
    RadianceSh radiance;
    for (int i = 0; i < kShCoefficientCount; ++i) {
        for (int channel = 0; channel < 3; ++channel) {
            radiance.coefficients[i][channel] =
                static_cast<float>(row[static_cast<size_t>(3 * i + channel)] / sample_count);
        }
    }
    return irradiance_from_radiance(radiance);
}

ProbeTransfer transfer_from_row(std::span<const double> row, double sample_count) {
    ProbeTransfer transfer;
    const double* direct = row.data();
    const double* bounced = direct + LightGroupLayout::kDirectSize;
    for (int i = 0; i < kShCoefficientCount; ++i) {
        const double factor = cosine_factor(i) / sample_count;
        for (int j = 0; j < kDistantCoefficientCount; ++j) {
            transfer.direct[i][j] = static_cast<float>(*direct++ * factor);
            for (int channel = 0; channel < 3; ++channel) {
                transfer.bounced[i][j][channel] = static_cast<float>(*bounced++ * factor);
            }
        }
    }
    return transfer;
}

glm::vec4 occlusion_from_row(std::span<const double> row) {
    return {row[0], row[1], row[2], row[3]};
}

bool has_rest(const ProbeVolumeView& volume) {
    return !volume.layers.empty() &&
           find_layer(volume, "rest") == static_cast<uint32_t>(volume.layers.size() - 1);
}

/// The light of one layer of a volume.
std::span<IrradianceSh> layer_light(ProbeVolume& volume, size_t layer) {
    const size_t count = volume.positions.size();
    return std::span(volume.layer_irradiance).subspan(layer * count, count);
}

}  // namespace

LightGroupLayout split_layout(const ProbeVolumeView& volume) noexcept {
    LightGroupLayout layout;
    layout.layer_count = static_cast<uint32_t>(volume.layers.size()) - (has_rest(volume) ? 1 : 0);
    layout.has_rest = has_rest(volume);
    layout.has_transfer = !volume.sky.empty();
    layout.has_occlusion = !volume.occlusion_lights.empty();
    return layout;
}

void store_split(const PlaceRange& range, std::span<const ProbeAccumulator> accumulators,
                 std::span<const double> rows, ProbeVolume& volume) {
    const LightGroupLayout layout = split_layout(volume.view());
    TETRALIGHT_ASSERT(rows.size() == layout.size() * accumulators.size(), "one row a probe");
    const size_t count = volume.positions.size();
    volume.layer_irradiance.resize(volume.layers.size() * count);
    volume.layer_errors.resize(volume.layer_irradiance.size());
    if (layout.has_transfer) volume.transfer.resize(count);
    if (layout.has_occlusion) volume.occlusion.resize(count);
    for (size_t i = 0; i < accumulators.size(); ++i) {
        const size_t probe = range[i];
        const auto row = rows.subspan(i * layout.size(), layout.size());
        // A probe without samples (its light is reused) keeps zeros here.
        const auto directions =
            static_cast<double>(std::max<uint64_t>(accumulators[i].sample_count, 1));
        for (uint32_t layer = 0; layer < layout.layer_count; ++layer) {
            layer_light(volume, layer)[probe] =
                irradiance_from_row(row.subspan(layer * LightGroupLayout::kLayerSize), directions);
        }
        const std::vector<float> errors = layer_errors(layout, accumulators[i], row);
        for (size_t layer = 0; layer < errors.size(); ++layer) {
            volume.layer_errors[layer * count + probe] = errors[layer];
        }
        if (layout.has_transfer) {
            volume.transfer[probe] =
                transfer_from_row(row.subspan(layout.direct_begin()), directions);
        }
        if (layout.has_occlusion) {
            volume.occlusion[probe] = occlusion_from_row(row.subspan(layout.occlusion_begin()));
        }
    }
}

void store_rest(ProbeVolume& volume) {
    if (!has_rest(volume.view())) return;
    const size_t rest = volume.layers.size() - 1;
    const auto light = layer_light(volume, rest);
    for (size_t i = 0; i < light.size(); ++i) {
        IrradianceSh sum;
        for (size_t layer = 0; layer < rest; ++layer) sum += layer_light(volume, layer)[i];
        light[i] = volume.irradiance[i] + -1.0f * sum;
    }
}

void dering_layers(const std::vector<bool>& is_dering_asked_for, DeringWindow window,
                   ProbeVolume& volume) {
    for (size_t layer = 0; layer < volume.layers.size(); ++layer) {
        const auto light = layer_light(volume, layer);
        for (size_t i = 0; i < light.size(); ++i) {
            if (is_dering_asked_for[i]) light[i] = dering(light[i], window);
        }
    }
}

void sum_layers(ProbeVolume& volume) {
    if (volume.layers.empty()) return;
    for (size_t layer = 0; layer < volume.layers.size(); ++layer) {
        volume.layers[layer].largest = largest_coefficient(layer_light(volume, layer));
    }
    const Status status = recombine(volume, layer_weights(volume.view()));
    TETRALIGHT_ASSERT(status, "weights of 1 are fine");
}

}  // namespace tetralight
