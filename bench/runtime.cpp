// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <memory>
#include <random>
#include <span>

#include <tetralight/bench/fma_peak.h>
#include <tetralight/bench/harness.h>
#include <tetralight/bench/query_subject.h>
#include <tetralight/probes/interpolate.h>
#include <tetralight/runtime/pack_instances.h>
#include <tetralight/runtime/sample_normals.h>
#ifdef TETRALIGHT_HAS_GL
#include <tetralight/bench/gl_renderer.h>
#include <tetralight/bench/gpu_query.h>
#endif

namespace tetralight::bench {
namespace {

/// Floats aligned to a cache line, as in engines.
class AlignedFloats {
  public:
    explicit AlignedFloats(size_t count)
        : floats_(static_cast<float*>(std::aligned_alloc(64, (count * 4 + 63) / 64 * 64))),
          count_(count) {}

    [[nodiscard]] std::span<float> span() const { return {floats_.get(), count_}; }

  private:
    struct Free {
        void operator()(float* floats) const { std::free(floats); }
    };

    std::unique_ptr<float, Free> floats_;
    size_t count_;
};

/// Normals, and memory for their light.
struct NormalArrays {
    AlignedFloats x, y, z, red, green, blue;

    explicit NormalArrays(size_t count)
        : x(count), y(count), z(count), red(count), green(count), blue(count) {
        std::mt19937_64 engine(1);
        std::uniform_real_distribution<float> share(0.0f, 1.0f);
        for (size_t i = 0; i < count; ++i) {
            const float u = share(engine), v = share(engine);
            const glm::vec3 normal = uniform_direction({u, v});
            x.span()[i] = normal.x;
            y.span()[i] = normal.y;
            z.span()[i] = normal.z;
        }
    }

    void sample(const PackedSh& sh) const {
        sample_sh9(sh, {x.span(), y.span(), z.span()}, {red.span(), green.span(), blue.span()});
    }

    void require_right(const PackedSh& sh) const {
        for (size_t i = 0; i < x.span().size(); ++i) {
            const glm::vec3 expected =
                sample_sh9(sh, glm::vec3(x.span()[i], y.span()[i], z.span()[i]));
            const glm::vec3 light(red.span()[i], green.span()[i], blue.span()[i]);
            require(glm::distance(light, expected) <= 1e-5f, "runtime.sh9: another light");
        }
    }
};

PackedSh some_light() {
    IrradianceSh sh;
    for (int i = 0; i < kShCoefficientCount; ++i) {
        sh.coefficients[i] = glm::vec3(1.0f, 0.5f, 0.25f) / static_cast<float>(1 + i);
    }
    return pack_sh(sh);
}

#ifdef TETRALIGHT_HAS_HIGHWAY
/// Light at many normals against the same number of multiply-adds in registers.
void bench_sh9(const std::string& figure, size_t count, const Options& options) {
    const NormalArrays arrays(count);
    const PackedSh sh = some_light();
    const size_t repeats = std::max<size_t>(1, 8'000'000 / count);
    volatile float sink = 0.0f;
    Contest contest;
    contest.figure = figure;
    contest.unit = "Mnormals/s";
    contest.baseline_is = "27 multiply-adds a normal in registers alone";
    contest.work = static_cast<double>(count * repeats) * 1e-6;
    contest.ours = [&] {
        return seconds([&] {
            for (size_t i = 0; i < repeats; ++i) arrays.sample(sh);
        });
    };
    contest.baseline = [&] { return seconds([&] { sink = multiply_add(27 * count * repeats); }); };
    run(contest, options);
    arrays.require_right(sh);
}

#endif

constexpr size_t kInstanceCount = 1023;

/// The instances of one draw call, a rotating ball: inputs and outputs of its query.
struct MeshBall {
    ProbeVolumeView volume;
    glm::vec3 center;
    std::vector<glm::vec3> offsets;  ///< from the centre
    std::vector<glm::vec3> positions = std::vector<glm::vec3>(kInstanceCount);
    std::vector<uint32_t> hints = std::vector<uint32_t>(kInstanceCount, kNoIndex);
    std::vector<CellLocation> locations = std::vector<CellLocation>(kInstanceCount);
    std::vector<PackedSh> light = std::vector<PackedSh>(kInstanceCount);
    std::vector<PackedSh> gathered = std::vector<PackedSh>(kInstanceCount);
    std::vector<glm::vec4> occlusion = std::vector<glm::vec4>(kInstanceCount);
    std::vector<glm::vec4> gathered_occlusion = std::vector<glm::vec4>(kInstanceCount);

    MeshBall(const Subject& subject, float radius)
        : volume(subject.volume.view()), center(0.5f * (subject.min + subject.max)) {
        std::mt19937_64 engine(1);
        std::uniform_real_distribution<float> share(0.0f, 1.0f);
        for (size_t i = 0; i < kInstanceCount; ++i) {
            const float u = share(engine), v = share(engine);
            offsets.push_back(radius * std::cbrt(share(engine)) * uniform_direction({u, v}));
        }
    }

    void turn_to(float angle) {
        const float c = std::cos(angle), s = std::sin(angle);
        for (size_t i = 0; i < kInstanceCount; ++i) {
            const glm::vec3 p = offsets[i];
            positions[i] = center + glm::vec3(c * p.x + s * p.z, p.y, c * p.z - s * p.x);
        }
        locate(volume, positions, locations);
    }

    void prepare(std::span<uint32_t> cells) {
        const InstanceBatch batch{positions, cells, {}, light, occlusion, {}};
        require(bool(pack_instances(volume, batch)), "runtime.mesh_ball: packing");
    }

    void gather() {
        require(bool(blend(volume, locations, gathered, gathered_occlusion)),
                "runtime.mesh_ball: gathering");
    }

    void require_right() const {
        for (size_t i = 0; i < kInstanceCount; ++i) {
            require(glm::distance(light[i].sha_g, gathered[i].sha_g) <= 1e-3f,
                    "runtime.mesh_ball: another light");
        }
    }
};

/// Microseconds a frame. The ball rotates by 0.01 radian a frame, and cells are kept as hints; with
/// `first` there are no hints.
void bench_mesh_ball(const Options& options) {
    const Subject subject = make_random_subject("20k", 20'000);
    MeshBall ball(subject, 10.0f);
    std::vector<double> kept, first, baseline;
    for (int frame = 0; frame < std::max(50, options.repetitions); ++frame) {
        ball.turn_to(0.01f * static_cast<float>(frame));
        first.push_back(1e6 * seconds([&] { ball.prepare({}); }));
        kept.push_back(1e6 * seconds([&] { ball.prepare(ball.hints); }));
        baseline.push_back(1e6 * seconds([&] { ball.gather(); }));
        ball.require_right();
    }
    const std::string what = "gathering and packing at known cells";
    report_contest("runtime.mesh_ball", median(kept), median(baseline), "us", what);
    report_contest("runtime.mesh_ball.first", median(first), median(baseline), "us", what);
}

}  // namespace

void bench_runtime(const Options& options) {
#ifdef TETRALIGHT_HAS_HIGHWAY
    bench_sh9("runtime.sh9", 4096, options);
    if (!options.is_quick) bench_sh9("runtime.sh9.1m", 1'000'000, options);
#endif
    bench_mesh_ball(options);
#ifdef TETRALIGHT_HAS_GL
    bench_gpu_query();
    bench_gl_renderer(options);
#endif
}

}  // namespace tetralight::bench
