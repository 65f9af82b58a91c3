// SPDX-License-Identifier: Apache-2.0
#include <tetralight/render/render_gizmos.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/random_probes.h"
#include "tests/support/scenes.h"

namespace tetralight {
namespace {

/// Twenty metres in twenty pixels at the origin, seen from the front.
const Camera kCamera = look_at({0, 0, 20}, {0, 0, 0}, 2.0 * std::atan(0.5));

RenderSettings small_settings() {
    RenderSettings settings;
    settings.width = settings.height = 20;
    settings.samples_per_axis = 1;
    settings.exposure = 1.0f;
    return settings;
}

/// A tetrahedron around a fifth probe, which is seen left of the middle and in front of its edges.
ProbeVolume five_probes() {
    return test::make_lit_volume(
        {{-8, -8, 0}, {8, -8, 0}, {0, 8, 0}, {0.25, 0.25, 9}, {0.1, -2, 2}});
}

Image8 render(const Scene& scene, const ProbeVolume& volume, const GizmoSettings& show) {
    const auto shader = SceneShader::make(scene, volume.view());
    EXPECT_TRUE(shader);
    const auto image =
        render_gizmos(ray_traced_pictures(*shader, volume.view()), volume.view(), kCamera,
                      small_settings(), make_gizmos(volume.view(), {}, show));
    EXPECT_TRUE(image);
    return image ? *image : Image8{};
}

TEST(RenderGizmos, IsThePlainPictureWithoutOverlay) {
    Scene scene;
    test::add_floor(scene, test::diffuse(glm::vec3(0.5f)), 5.0f, -3.0f);
    const ProbeVolume volume = five_probes();
    const auto plain = render_scene(scene, volume.view(), kCamera, small_settings());
    ASSERT_TRUE(plain);
    EXPECT_EQ(render(scene, volume, {}), develop(*plain, 1.0f));
}

TEST(RenderGizmos, DrawsTheHullInAWarmerColorThanWhatIsWithin) {
    ProbeVolume volume = five_probes();
    volume.irradiance.assign(5, {});  // black
    const Image8 image = render({}, volume, {.has_cells = true});
    uint64_t warm = 0, cool = 0;
    for (const auto& pixel : image.pixels) {
        warm += pixel[0] > pixel[2];
        cool += pixel[0] < pixel[2];
    }
    // The lowest edge of the hull is 16 m long, and the others are longer.
    EXPECT_GT(warm, 3u * 16u);
    EXPECT_GT(cool, 5u);
}

TEST(RenderGizmos, ShowsProbesAmongTheSurfaces) {
    ProbeVolume volume = five_probes();
    volume.irradiance.assign(5, irradiance_from_radiance(constant_radiance({1, 0, 0})));
    const auto is_red = [](const std::array<uint8_t, 4>& pixel) {
        return pixel[0] > pixel[1] + 50;
    };
    const Image8 open = render({}, volume, {.has_probes = true, .ball_radius = 1.0f});
    EXPECT_GT(std::ranges::count_if(open.pixels, is_red), 5);
    Scene wall;
    test::add_quad(wall, test::diffuse(glm::vec3(0.0f), glm::vec3(0.5f)), {-15, -15, 12},
                   {30, 0, 0}, {0, 30, 0});
    EXPECT_EQ(std::ranges::count_if(
                  render(wall, volume, {.has_probes = true, .ball_radius = 1.0f}).pixels, is_red),
              0);
}

}  // namespace
}  // namespace tetralight
