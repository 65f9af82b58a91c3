// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <vector>

#include <tetralight/bake/rays/trace_scene.h>
#include <tetralight/bake/scene/scene.h>
#include <tetralight/pipeline/bake_volume.h>
#include <tetralight/probes/interpolate.h>

namespace tetralight::bench {

/// The light of the same positions by plain weights, by weights that know walls, and by weights of
/// only the corners that a ray reaches.
struct LeakAnswers {
    std::vector<IrradianceSh> plain, walls, rays;
    /// False where a ray reaches no corner: there `rays` has plain weights.
    std::vector<bool> is_seen;
};

/// A baked volume and the rays of its scene.
class LeakVolume {
  public:
    /// Keeps a reference to the scene.
    LeakVolume(const Scene& scene, std::span<const ProbeGroup> groups, uint32_t sample_count);

    [[nodiscard]] ProbeVolumeView view() const { return baked_.volume.view(); }

    [[nodiscard]] LeakAnswers answers(std::span<const glm::vec3> positions) const;

    /// Reports `PREFIX.bytesSUFFIX` and `PREFIX.bake_costSUFFIX`.
    void report_cost(const std::string& prefix, const std::string& suffix) const;

  private:
    [[nodiscard]] std::vector<IrradianceSh> batch(std::span<const glm::vec3> positions,
                                                  Walls walls) const;
    void answer_by_rays(const glm::vec3& position, LeakAnswers& answers) const;

    BakedVolume baked_;
    TraceScene traced_;
};

/// Mean irradiance of all answers.
[[nodiscard]] double mean_light(const std::vector<IrradianceSh>& answers);

}  // namespace tetralight::bench
