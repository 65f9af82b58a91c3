// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/ball_window.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include <tetralight/render/gl/gl_mesh_ball.h>
#include <tetralight/render/gl/presenter.h>
#include <tetralight/render/gl/window.h>
#include <tetralight/render/orbit_camera.h>

namespace tetralight::cli {
namespace {

constexpr double kRadiansPerPixel = 0.008;
constexpr double kRadiansPerSecond = 0.4;

class BallWindow {
  public:
    BallWindow(Window& window, GlMeshBall& spheres, const Presenter& presenter,
               const BallOptions& ball, const Camera& camera, float exposure)
        : window_(window),
          spheres_(spheres),
          presenter_(presenter),
          light_(ball.light),
          specular_(ball.specular),
          orbit_(camera, ball.settings.center),
          exposure_(exposure) {}

    Status draw_frame(double seconds) {
        take(window_.poll(), seconds);
        const glm::uvec2 size = window_.size();
        if (size.x == 0 || size.y == 0) return Ok{};
        if (!target_ || target_->width() != size.x || target_->height() != size.y) {
            target_.emplace(size.x, size.y, 4);
        }
        if (auto status = spheres_.set_frame(angle_, light_, specular_); !status) return status;
        const SphereInstances instances = spheres_.sphere_instances();
        const auto status = spheres_.renderer().draw(orbit_.camera(), *target_, {&instances, 1});
        if (!status) return status;
        if (exposure_ <= 0.0f) exposure_ = automatic_exposure(target_->read());
        presenter_.present(*target_, 0, size.x, size.y, exposure_);
        window_.swap();
        return Ok{};
    }

  private:
    void take(const WindowInput& input, double seconds) {
        orbit_.turn(-input.drag.x * kRadiansPerPixel, input.drag.y * kRadiansPerPixel);
        orbit_.zoom(std::pow(0.9, input.scroll));
        for (const char key : input.keys) {
            if (key == 'P') light_ = BallLight::Probes;
            if (key == 'L') light_ = BallLight::ProxyVolume;
            if (key == 'O') light_ = BallLight::Off;
            if (key == 'S') {
                specular_ = specular_ == Specular::On ? Specular::Off : Specular::On;
            }
            if (key == ' ') bit_trails_ = !bit_trails_;
        }
        if (bit_trails_) angle_ += kRadiansPerSecond * std::min(seconds, 0.1);
    }

    Window& window_;
    GlMeshBall& spheres_;
    const Presenter& presenter_;
    BallLight light_;
    Specular specular_;
    OrbitCamera orbit_;
    float exposure_;
    double angle_ = 0.0;
    bool bit_trails_ = true;
    std::optional<RenderTarget> target_;
};

}  // namespace

Result<BallShow> show_ball(const BallOptions& ball, const Scene& scene, SceneLight light,
                           const ProbeVolumeView& volume, const Camera& camera,
                           const RenderSettings& settings, uint64_t frame_count) {
    auto window = Window::create(settings.width, settings.height,
                                 "Tetralight: P probes, L proxy volume, O off, S specular");
    if (!window) return window.error();
    auto spheres = GlMeshBall::make(ball.settings, scene, std::move(light), volume, 1024);
    if (!spheres) return spheres.error();
    const auto presenter = Presenter::make();
    if (!presenter) return presenter.error();

    BallWindow shown(*window, *spheres, *presenter, ball, camera, settings.exposure);
    const auto start = std::chrono::steady_clock::now();
    auto before = start;
    BallShow show;
    while (!window->is_closed() && (frame_count == 0 || show.frame_count < frame_count)) {
        const auto now = std::chrono::steady_clock::now();
        const double seconds = std::chrono::duration<double>(now - before).count();
        before = now;
        if (auto status = shown.draw_frame(seconds); !status) return status.error();
        ++show.frame_count;
    }
    show.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return show;
}

}  // namespace tetralight::cli
