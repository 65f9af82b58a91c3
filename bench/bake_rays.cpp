// SPDX-License-Identifier: Apache-2.0
// The whole baker against tracing the same rays only.
#include <limits>

#include <tetralight/bake/lights/scene_openings.h>
#include <tetralight/bake/parallel.h>
#include <tetralight/bake/path_tracer.h>
#include <tetralight/bake/probe_estimator.h>
#include <tetralight/bake/sampling/sampling.h>
#include <tetralight/bench/bake_scenes.h>

namespace tetralight::bench {
namespace {

constexpr uint32_t kEstimates = 8;
constexpr uint32_t kDirections = 128;

struct RecordedRay {
    Ray ray;
    RayKind kind = RayKind::Nearest;
    float distance = 0.0f;  ///< as `RayListener` has it
};

void record_ray(void* context, const Ray& ray, RayKind kind, float distance) {
    static_cast<std::vector<RecordedRay>*>(context)->push_back({ray, kind, distance});
}

float distance_of(const RayCaster& caster, const RecordedRay& recorded) {
    constexpr float kNone = std::numeric_limits<float>::infinity();
    if (recorded.kind == RayKind::Shadow) return caster.occluded(recorded.ray) ? 0.0f : kNone;
    const auto hit = caster.intersect(recorded.ray);
    return hit ? hit->distance : kNone;
}

/// The estimates of a bake and the rays that each of them traces.
class RayContest {
  public:
    explicit RayContest(const BakeSubject& subject)
        : subject_(subject),
          scene_(*TraceScene::make_static(subject.scene)),
          tracer_(subject.scene, scene_, {}, {}, openings_of(subject.scene, scene_)),
          rays_(kEstimates * subject.probes.size()) {
        parallel_for(rays_.size(), 1, [&](size_t item) {
            scene_.listen({record_ray, &rays_[item]});
            estimate(item);
            ray_count_ += rays_[item].size();
        });
        scene_.listen({});
    }

    [[nodiscard]] size_t ray_count() const { return ray_count_; }

    void bake() const {
        parallel_for(rays_.size(), 0, [&](size_t item) { estimate(item); });
    }

    void intersect() const {
        parallel_for(rays_.size(), 0, [&](size_t item) {
            for (const RecordedRay& ray : rays_[item]) (void)distance_of(scene_.caster(), ray);
        });
    }

    /// Each ray finds the same hit as in the baker.
    void check() const {
        parallel_for(rays_.size(), 1, [&](size_t item) {
            for (const RecordedRay& ray : rays_[item]) {
                require(distance_of(scene_.caster(), ray) == ray.distance, "a ray's hit");
            }
        });
    }

  private:
    void estimate(size_t item) const {
        const glm::dvec3& probe = subject_.probes[item / kEstimates];
        const uint64_t key = probe_key(item % kEstimates, probe);
        (void)estimate_probe(tracer_, scene_.render_from_world(probe), key, directions_);
    }

    const BakeSubject& subject_;
    TraceScene scene_;
    PathTracer tracer_;
    const DirectionSet directions_{kDirections};
    std::vector<std::vector<RecordedRay>> rays_;
    size_t ray_count_ = 0;
};

}  // namespace

void bench_bake_rays(const BakeSubject& subject, const Options& options) {
    const RayContest rays(subject);
    rays.check();
    Contest contest;
    contest.figure = "bake.rays." + subject.name;
    contest.unit = "Mrays/s";
    contest.baseline_is = "the same rays, Embree alone";
    contest.work = 1e-6 * static_cast<double>(rays.ray_count());
    contest.ours = [&] { return seconds([&] { rays.bake(); }); };
    contest.baseline = [&] { return seconds([&] { rays.intersect(); }); };
    run(contest, options);
}

}  // namespace tetralight::bench
