// SPDX-License-Identifier: Apache-2.0
// Runs where there is a screen, Xvfb for example (tests/runtime/CMakeLists.txt).
#include <tetralight/render/gl/window.h>

#include <gtest/gtest.h>

#include <cstdlib>
#include <optional>

#include <tetralight/base/error_text.h>
#include <tetralight/render/gl/gl_mesh_ball.h>
#include <tetralight/render/gl/presenter.h>
#include <tetralight/render/image_renderer.h>
#include "tests/support/random_probes.h"

namespace tetralight {
namespace {

class WindowTest : public testing::Test {
  protected:
    void SetUp() override {
        auto created = Window::create(80, 60, "test");
        if (!created) GTEST_SKIP() << error_text(created.error());
        window_.emplace(std::move(*created));
    }

    /// One frame at the window's size, with something in the middle of it.
    template <class Meanwhile>
    Status draw(GlMeshBall& ball, const Presenter& presenter, Meanwhile meanwhile) {
        static_cast<void>(window_->poll());
        const glm::uvec2 size = window_->size();
        const RenderTarget target(size.x, size.y, 4);
        if (auto status = ball.set_frame(0.1, BallLight::Probes, Specular::On); !status) {
            return status;
        }
        const SphereInstances instances = ball.sphere_instances();
        meanwhile();
        const Camera camera = look_at({0, 0, 15}, {0, 0, 0}, 0.8);
        if (auto status = ball.renderer().draw(camera, target, {&instances, 1}); !status)
            return status;
        presenter.present(target, 0, size.x, size.y, 1.0f);
        window_->swap();
        return Ok{};
    }

    std::optional<Window> window_;
};

TEST_F(WindowTest, MayBeResizedAndClosedInTheMiddleOfAFrame) {
    const ProbeVolume volume = test::make_lit_volume(test::random_positions(30, 1, 9.0));
    MeshBallSettings settings;
    settings.instance_count = 30;
    auto light = make_scene_light({}, volume.view(), ProbeLight::AsTheScene);
    auto ball = GlMeshBall::make(settings, {}, std::move(*light), volume.view(), 64);
    ASSERT_TRUE(ball) << error_text(ball.error());
    const auto presenter = Presenter::make();
    ASSERT_TRUE(presenter);
    const auto expect_fine = [&](auto meanwhile) {
        const auto status = draw(*ball, *presenter, meanwhile);
        EXPECT_TRUE(status) << error_text(status.error());
    };
    expect_fine([] {});
    expect_fine([&] { window_->resize(120, 40); });
    for (int i = 0; i < 100 && window_->size() != glm::uvec2(120, 40); ++i) {
        static_cast<void>(window_->poll());
    }
    EXPECT_EQ(window_->size(), glm::uvec2(120, 40));
    expect_fine([&] { window_->resize(1, 1); });
    expect_fine([&] { window_->close(); });
    EXPECT_TRUE(window_->is_closed());
    expect_fine([] {});
}

TEST_F(WindowTest, CanBeOpenedAgain) {
    window_.reset();
    for (int i = 0; i < 2; ++i) {
        const auto again = Window::create(40, 30, "again");
        ASSERT_TRUE(again) << error_text(again.error());
        EXPECT_FALSE(again->is_closed());
    }
}

TEST(WindowWithoutScreen, IsAnErrorThatSaysSo) {
    const char* display = std::getenv("DISPLAY");
    const std::string before = display ? display : "";
    ::setenv("DISPLAY", ":987", 1);
    const auto window = Window::create(40, 30, "none");
    display ? ::setenv("DISPLAY", before.c_str(), 1) : ::unsetenv("DISPLAY");
    ASSERT_FALSE(window);
    EXPECT_EQ(error_text(window.error()).find("OpenGL: no screen for a window"), 0u)
        << error_text(window.error());
}

}  // namespace
}  // namespace tetralight
