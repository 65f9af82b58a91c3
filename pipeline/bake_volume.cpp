// SPDX-License-Identifier: Apache-2.0
#include "pipeline/bake_volume.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "base/assert.h"
#include "base/text.h"
#include "probes/build/make_probe_volume.h"
#include "probes/compact_probes.h"

namespace tetralight {
namespace {

/// Seconds since the last call.
class Stopwatch {
  public:
    double lap() {
        const auto now = std::chrono::steady_clock::now();
        return std::chrono::duration<double>(now - std::exchange(last_, now)).count();
    }

  private:
    std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

std::string metadata(const BakeSettings& settings) {
    return text("{\"generator\":\"tetralight ", TETRALIGHT_VERSION,
                "\",\"samples\":", settings.sample_count, ",\"bounces\":", settings.bounces,
                ",\"seed\":", settings.seed, "}");
}

void store_light(const Scene& scene, const BakedProbes& baked, ProbeVolume& volume) {
    TETRALIGHT_ASSERT(scene.light_names.size() == scene.lights.size(), "one name for each light");
    for (const RadianceSh& radiance : baked.radiance) {
        volume.irradiance.push_back(irradiance_from_radiance(radiance));
    }
    volume.validity = baked.validity;
    volume.info.ambient = irradiance_from_radiance(baked.ambient);
    volume.lights = scene.lights;
    for (const std::string& name : scene.light_names) volume.light_names += name + "\n";
    make_compact_probes(volume);
}

/// Groups in which half of the probes or more lie inside something.
std::vector<std::string> buried_groups(const MergedProbes& merged,
                                       std::span<const float> validity) {
    std::vector<size_t> buried(merged.group_names.size(), 0);
    std::vector<size_t> total(merged.group_names.size(), 0);
    for (const ProbeSource& source : merged.sources) {
        ++total[source.group];
        buried[source.group] += validity[source.probe] < 0.5f;
    }
    std::vector<std::string> warnings;
    for (size_t g = 0; g < total.size(); ++g) {
        if (total[g] == 0 || 2 * buried[g] < total[g]) continue;
        warnings.push_back(text("group \"", merged.group_names[g], "\": ", buried[g], " of ",
                                total[g], " probes see mostly back faces (inside geometry?)"));
    }
    return warnings;
}

/// Probes that no light reaches, as in hollow walls.
void add_dark_warning(std::span<const RadianceSh> radiance, uint32_t sample_count,
                      std::vector<std::string>& warnings) {
    constexpr uint32_t kEnoughSamples = 64;  // with fewer a probe may miss a small opening
    const auto dark = std::ranges::count_if(
        radiance, [](const RadianceSh& sh) { return sh.coefficients[0] == glm::vec3(0.0f); });
    const bool is_all = dark == std::ssize(radiance);  // a scene without light: nothing is odd
    if (dark == 0 || is_all || sample_count < kEnoughSamples) return;
    warnings.push_back(text(dark, " of ", radiance.size(),
                            " probes receive no light at all (in closed hollows?); what they light "
                            "will be black"));
}

void add_dering_warnings(const MergedProbes& merged, std::vector<std::string>& warnings) {
    for (size_t g = 0; g < merged.group_names.size(); ++g) {
        if (!merged.group_dering[g]) continue;
        warnings.push_back(text("group \"", merged.group_names[g],
                                "\": dering is asked for, which this version does not do"));
    }
}

}  // namespace

Result<BakedVolume> bake_volume(const Scene& scene, std::span<const ProbeGroup> groups,
                                const MergeSettings& merge_settings, const BakeSettings& settings,
                                const BakeCallback& callback) {
    BakedVolume result;
    Stopwatch watch;
    const auto merged = merge(groups, merge_settings);
    if (!merged) return merged.error();
    result.report.welded_count = merged->welded_count();
    result.report.lattice_group_names = merged->lattice_group_names();
    result.report.largest_snap = merged->largest_snap;
    result.report.merge_seconds = watch.lap();

    ProbeVolume volume = make_probe_volume(*merged);
    result.report.tetrahedralize_seconds = watch.lap();

    const auto baked = bake_probes(scene, merged->positions, settings, callback);
    if (!baked) return baked.error();
    store_light(scene, *baked, volume);
    volume.metadata = metadata(settings);
    result.report.bake_seconds = watch.lap();
    result.report.ray_count = baked->ray_count;
    result.report.warnings = buried_groups(*merged, volume.validity);
    add_dark_warning(baked->radiance, settings.sample_count, result.report.warnings);
    add_dering_warnings(*merged, result.report.warnings);
    result.volume = std::move(volume);
    return result;
}

}  // namespace tetralight
