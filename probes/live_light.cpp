// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/live_light.h>

#include <algorithm>
#include <utility>

#include <tetralight/probes/compact_probes.h>
#include <tetralight/probes/recombine.h>

namespace tetralight {
namespace {

/// Occlusion and validity of the compact probes, which no recombination changes.
std::vector<CompactProbe> unlit_probes(const ProbeVolumeView& volume) {
    if (!volume.compact.empty()) return {volume.compact.begin(), volume.compact.end()};
    ProbeVolume other;
    other.irradiance.resize(volume.positions.size());
    other.occlusion.assign(volume.occlusion.begin(), volume.occlusion.end());
    other.validity.assign(volume.validity.begin(), volume.validity.end());
    make_compact_probes(other);
    return std::move(other.compact);
}

}  // namespace

LiveLight::LiveLight(const ProbeVolumeView& volume) : volume_(volume) {
    for (Set& set : sets_) {
        set.probes = unlit_probes(volume);
        set.layers.assign(volume.layers.begin(), volume.layers.end());
        set.info = volume.info;
    }
    weights_.resize(volume.layers.size());
}

LiveLight::LiveLight(LiveLight&& other) noexcept
    : volume_(other.volume_),
      published_(other.published_.load()),
      weights_(std::move(other.weights_)),
      next_info_(other.next_info_),
      next_probe_(other.next_probe_),
      is_under_way_(other.is_under_way_),
      is_set_free_(other.is_set_free_) {
    for (size_t i = 0; i < sets_.size(); ++i) {
        sets_[i].probes = std::move(other.sets_[i].probes);
        sets_[i].layers = std::move(other.sets_[i].layers);
        sets_[i].info = other.sets_[i].info;
    }
}

Result<LiveLight> LiveLight::make(const ProbeVolumeView& volume) {
    const std::vector<float> weights = layer_weights(volume);
    if (auto info = check_weights(volume, weights); !info) return info.error();
    LiveLight light(volume);
    if (auto status = light.begin(weights); !status) return status.error();
    light.step(volume.probe_count());
    return light;
}

Status LiveLight::begin(std::span<const float> weights) {
    const auto info = check_weights(volume_, weights);
    if (!info) return info.error();
    std::ranges::copy(weights, weights_.begin());
    next_info_ = volume_.info;
    next_info_.ambient = info->ambient;
    next_info_.compact_scale = info->compact_scale;
    next_probe_ = 0;
    is_under_way_ = true;
    is_set_free_ = false;
    return Ok{};
}

bool LiveLight::step(uint32_t probe_count) {
    if (!is_under_way_) return true;
    const uint32_t back = 1 - published_.load();
    Set& set = sets_[back];
    // Once its reader count is 0 it stays 0: readers begin with the published set.
    if (!is_set_free_ && set.reader_count.load() != 0) return false;
    is_set_free_ = true;
    const uint32_t end = next_probe_ + std::min(probe_count, volume_.probe_count() - next_probe_);
    const auto probes = std::span(set.probes).subspan(next_probe_, end - next_probe_);
    recombine_probes(volume_, weights_, next_probe_, end, {}, probes, next_info_.compact_scale);
    next_probe_ = end;
    if (end < volume_.probe_count()) return false;
    set.info = next_info_;
    for (size_t k = 0; k < weights_.size(); ++k) set.layers[k].weight = weights_[k];
    published_.store(back);
    is_under_way_ = false;
    return true;
}

LiveLight::Reading LiveLight::read() const {
    for (;;) {
        const uint32_t number = published_.load();
        Set& set = sets_[number];
        set.reader_count.fetch_add(1);
        if (published_.load() == number) {
            ProbeVolumeView view = volume_;
            view.info = set.info;
            view.compact = set.probes;
            view.layers = set.layers;
            view.irradiance = {};
            return {&set, view};
        }
        set.reader_count.fetch_sub(1);
    }
}

}  // namespace tetralight
