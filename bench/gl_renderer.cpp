// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bench/gl_renderer.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include <tetralight/bake/scene/read_gltf.h>
#include <tetralight/bake/scene/scene_bounds.h>
#include <tetralight/base/error_text.h>
#include <tetralight/pipeline/bake_volume.h>
#include <tetralight/render/gl/gl_mesh_ball.h>
#include <tetralight/render/gl/gl_pictures.h>
#include <tetralight/render/render_gizmos.h>
#include <tetralight/runtime/pack_instances.h>

namespace tetralight::bench {
namespace {

/// The scene with baked light, without direct light.
struct Lit {
    Scene scene;
    ProbeVolume volume;

    explicit Lit(const Options& options) {
        auto read = read_gltf(
            options.scene.value_or(TETRALIGHT_SOURCE_DIR "/examples/scenes/courtyard.glb"));
        require(bool(read), "runtime.gl: the scene");
        scene = std::move(*read);
        BakeVolumeSettings settings;
        settings.bake.sample_count = 256;
        auto baked = bake_volume(scene, scene.probe_groups, settings);
        require(bool(baked), "runtime.gl: the bake");
        volume = std::move(baked->volume);
        volume.lights.clear();
        volume.light_states.clear();
    }
};

/// Pixels at the edge or bend of a surface, where 1/depth is not linear.
class Silhouettes {
  public:
    explicit Silhouettes(const DepthImage& depth) : depth_(depth) {}

    [[nodiscard]] bool has(uint32_t x, uint32_t y) const {
        if (x == 0 || y == 0 || x + 1 >= depth_.width || y + 1 >= depth_.height) return true;
        for (const int axis : {0, 1}) {
            const uint32_t dx = axis == 0, dy = axis == 1;
            const float second = near(x - dx, y - dy) - 2.0f * near(x, y) + near(x + dx, y + dy);
            if (std::abs(second) > 2e-3f * near(x, y)) return true;
        }
        const auto& quarters = depth_.depths[size_t{y} * depth_.width + x];
        return std::isinf(*std::ranges::max_element(quarters)) !=
               std::isinf(*std::ranges::min_element(quarters));
    }

  private:
    [[nodiscard]] float near(uint32_t x, uint32_t y) const {
        float sum = 0.0f;
        for (const float depth : depth_.depths[size_t{y} * depth_.width + x]) sum += 1.0f / depth;
        return sum;
    }

    const DepthImage& depth_;
};

/// Mean absolute difference of displayed values outside silhouettes, as a fraction of white.
void bench_image_difference(const Lit& lit, const Camera& camera, const std::string& name) {
    const ProbeVolumeView volume = lit.volume.view();
    const auto light = make_scene_light(lit.scene, volume, ProbeLight::AsTheScene);
    require(bool(light), name);
    auto gl = GlPictures::make(lit.scene, volume, *light);
    if (!gl) {
        std::fprintf(stderr, "%s: %s\n", name.c_str(), error_text(gl.error()).c_str());
        return;
    }
    const auto shader = SceneShader::make(lit.scene, volume, *light);
    require(bool(shader), name);
    const PictureSource rays = ray_traced_pictures(*shader, volume);
    RenderSettings settings;
    settings.width = 480;
    settings.height = 270;
    const auto by_rays = rays.radiance(camera, settings, {});
    const auto depth = rays.depth(camera, settings, {});
    const auto by_gl = gl->source().radiance(camera, settings, {});
    require(by_rays && depth && by_gl, name);
    const float exposure = automatic_exposure(*by_rays);
    const Image8 a = develop(*by_rays, exposure), b = develop(*by_gl, exposure);
    const Silhouettes silhouettes(*depth);
    double sum = 0.0;
    size_t count = 0;
    for (uint32_t y = 0; y < a.height; ++y) {
        for (uint32_t x = 0; x < a.width; ++x) {
            if (silhouettes.has(x, y)) continue;
            const size_t i = size_t{y} * a.width + x;
            for (size_t channel = 0; channel < 3; ++channel) {
                sum += std::abs(a.pixels[i][channel] - b.pixels[i][channel]);
            }
            ++count;
        }
    }
    report(name, sum / (3.0 * 255.0 * static_cast<double>(count)),
           "of white, mean outside silhouettes");
    report(name + ".compared", static_cast<double>(count) / (480.0 * 270.0), "of the pixels");
}

/// A frame of the mesh ball: the CPU's work against its batch query alone, and the draw time.
void bench_frame(const Lit& lit, uint32_t count, const std::string& size) {
    const ProbeVolumeView volume = lit.volume.view();
    const auto context = OffscreenContext::create();
    if (!context) return;
    MeshBallSettings ball_settings;
    ball_settings.instance_count = count;
    ball_settings.center = {4.5, 3.0, 7.0};
    ball_settings.radius = 2.8;
    auto ball = GlMeshBall::make(ball_settings, {}, {}, volume, 1024);
    require(bool(ball), "runtime.gl_frame: the ball");
    const RenderTarget target(480, 270, 4);
    const Camera camera = look_at({0, 4.5, 15.5}, {4, 2.6, 6.5}, 0.8);
    std::vector<double> cpu, gpu, bare;
    std::vector<PackedSh> light(count);
    std::vector<glm::vec4> occlusion(count);
    std::vector<uint32_t> cells(count, kNoIndex);
    for (int frame = 0; frame < 15; ++frame) {
        cpu.push_back(1e3 * seconds([&] {
                          const auto status =
                              ball->set_frame(0.01 * frame, BallLight::Probes, Specular::Off);
                          require(bool(status), "runtime.gl_frame: its light");
                      }));
        bare.push_back(
            1e3 * seconds([&] {
                const InstanceBatch batch{ball->positions(), cells, {}, light, occlusion, {}};
                require(bool(pack_instances(volume, batch)), "runtime.gl_frame: the query");
            }));
        if (frame % 3 != 0) continue;
        gpu.push_back(
            1e3 * seconds([&] {
                const SphereInstances instances = ball->sphere_instances();
                const auto status = ball->renderer().draw(camera, target, {&instances, 1});
                require(bool(status), "runtime.gl_frame: drawing");
                glFinish();
            }));
    }
    report_contest("runtime.gl_frame.cpu." + size, median(cpu), median(bare), "ms",
                   "the batch query of the same positions alone");
    report("runtime.gl_frame.gpu." + size, median(gpu), "ms");
}

}  // namespace

void bench_gl_renderer(const Options& options) {
    const Lit lit(options);
    if (!lit.scene.cameras.empty()) {
        bench_image_difference(lit, lit.scene.cameras[0], "runtime.gl_image_difference");
    }
    if (lit.scene.cameras.size() > 1) {
        bench_image_difference(lit, lit.scene.cameras[1], "runtime.gl_image_difference.interior");
    }
    bench_frame(lit, 1023, "1023");
    bench_frame(lit, 100'000, "100k");
    if (!options.is_quick) bench_frame(lit, 1'000'000, "1m");
}

}  // namespace tetralight::bench
