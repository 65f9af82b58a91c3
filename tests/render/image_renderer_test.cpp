// SPDX-License-Identifier: Apache-2.0
#include <tetralight/render/image_renderer.h>

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include <tetralight/bake/image/srgb.h>

namespace tetralight {
namespace {

TEST(LookAt, IsFiniteWhereEyeAndTargetCanHardlyBeParted) {
    for (const double distance : {0.0, 1e-300, 1e-160}) {
        const Camera camera = look_at({0, 1, 0}, {0, 1, distance}, 1.0);
        for (int axis = 0; axis < 3; ++axis) {
            EXPECT_NEAR(glm::length(camera.world_from_camera[axis]), 1.0, 1e-12) << distance;
        }
    }
}

RenderSettings small(uint32_t width, uint32_t height, uint32_t samples_per_axis = 1) {
    RenderSettings settings;
    settings.width = width;
    settings.height = height;
    settings.samples_per_axis = samples_per_axis;
    return settings;
}

/// Shows the ray's own direction.
glm::vec3 show_direction(const glm::dvec3&, glm::vec3 direction) {
    return direction;
}

glm::dvec3 axis(const Camera& camera, int index) {
    return glm::dvec3(camera.world_from_camera[index]);
}

TEST(LookAt, LooksAlongItsMinusZWithYUp) {
    const Camera camera = look_at({0, 0, 5}, {0, 0, 0}, 0.7);
    EXPECT_EQ(camera.world_from_camera[3], glm::dvec4(0, 0, 5, 1));
    EXPECT_EQ(axis(camera, 0), glm::dvec3(1, 0, 0));
    EXPECT_EQ(axis(camera, 1), glm::dvec3(0, 1, 0));
    EXPECT_EQ(axis(camera, 2), glm::dvec3(0, 0, 1));
    EXPECT_EQ(camera.fov_y_radians, 0.7);
}

TEST(LookAt, AxesAreOrthonormalAndRightHandedFromEverywhere) {
    for (const glm::dvec3 eye : {glm::dvec3(3, 4, 5), glm::dvec3(0, 7, 0), glm::dvec3(0, -7, 0),
                                 glm::dvec3(1e-12, 9, 0), glm::dvec3(-2, 0, 1e6)}) {
        const Camera camera = look_at(eye, {0, 0, 0}, 0.7);
        const glm::dvec3 right = axis(camera, 0), up = axis(camera, 1), back = axis(camera, 2);
        EXPECT_NEAR(glm::length(right), 1.0, 1e-9);
        EXPECT_LT(glm::distance(glm::cross(right, up), back), 1e-9);
        EXPECT_LT(glm::distance(back, glm::normalize(eye)), 1e-9);
        EXPECT_GE(up.y, -1e-9);
    }
}

/// The same camera with parallel rays.
Camera with_half_height(Camera camera, double half_height) {
    camera.half_height = half_height;
    return camera;
}

TEST(PictureHeight, GrowsWithDepthInPerspectiveAlone) {
    const Camera camera = look_at({0, 0, 5}, {0, 0, 0}, 2.0 * std::atan(0.5));
    EXPECT_NEAR(picture_height(camera).at(3.0), 3.0, 1e-12);
    EXPECT_EQ(picture_height(with_half_height(camera, 4.0)).at(3.0), 8.0);
}

TEST(RenderView, RaysOfAnOrthographicCameraAreParallelAndStartInThePlaneThroughIt) {
    const Camera camera = with_half_height(look_at({0, 0, 5}, {0, 0, 0}, 1.0), 2.0);
    for (const glm::vec3& direction : render_view(camera, small(4, 2), show_direction).pixels) {
        EXPECT_EQ(direction, glm::vec3(0, 0, -1));
    }
    const ImageF origins = render_view(
        camera, small(4, 2), [](const glm::dvec3& origin, glm::vec3) { return glm::vec3(origin); });
    for (size_t i = 0; i < 8; ++i) {  // pixels of 2 m
        const auto column = static_cast<float>(i % 4), row = static_cast<float>(i / 4);
        EXPECT_EQ(origins.pixels[i], glm::vec3(2.0f * column - 3.0f, 1.0f - 2.0f * row, 5.0f));
    }
}

TEST(RenderView, RightOfTheTargetIsRightInThePictureAndUpIsUp) {
    // From +X towards the origin: −Z is on the right hand.
    const Camera camera = look_at({5, 0, 0}, {0, 0, 0}, 1.0);
    const ImageF image = render_view(camera, small(3, 3), show_direction);
    EXPECT_LT(glm::distance(image.pixels[4], glm::vec3(-1, 0, 0)), 1e-6f);
    EXPECT_GT(image.pixels[3].z, 0.1f);   // left
    EXPECT_LT(image.pixels[5].z, -0.1f);  // right
    EXPECT_GT(image.pixels[1].y, 0.1f);   // top row first
    EXPECT_LT(image.pixels[7].y, -0.1f);
}

TEST(RenderView, FieldOfViewSpansTheHeight) {
    // Centres of the upper of 2 rows stand half way to the edge: slope tan(fov/2) / 2, and those of
    // 4 columns as far to the side as pixels are square: 3/2 and 1/2 pixels.
    const Camera camera = look_at({0, 0, 5}, {0, 0, 0}, 1.0);
    const ImageF image = render_view(camera, small(4, 2), show_direction);
    const float pixel = std::tan(0.5f);  // half of the height
    const glm::vec3 d = image.pixels[0];
    EXPECT_NEAR(d.y / -d.z, 0.5f * pixel, 1e-6f);
    EXPECT_NEAR(d.x / -d.z, -1.5f * pixel, 1e-6f);
    EXPECT_NEAR(glm::length(d), 1.0f, 1e-6f);
}

TEST(RenderView, RaysStartAtTheEye) {
    const Camera camera = look_at({1e7 + 0.25, 2, 3}, {0, 0, 0}, 1.0);
    const ImageF image = render_view(camera, small(1, 1), [](const glm::dvec3& origin, glm::vec3) {
        return glm::vec3(origin - glm::dvec3(1e7, 0, 0));
    });
    EXPECT_EQ(image.pixels[0], glm::vec3(0.25f, 2, 3));
}

TEST(RenderView, AveragesARegularGridOfSamples) {
    // One pixel whose left half is 1: two of its four columns of samples.
    const Camera camera = look_at({0, 0, 5}, {0, 0, 0}, 1.0);
    const ImageF image = render_view(camera, small(1, 1, 4), [](const glm::dvec3&, glm::vec3 d) {
        return glm::vec3(d.x < 0.0f ? 1.0f : 0.0f);
    });
    EXPECT_EQ(image.pixels[0], glm::vec3(0.5f));
}

TEST(RenderView, ThreadsDoNotMatter) {
    const Camera camera = look_at({1, 2, 3}, {0, 0, 0}, 1.0);
    RenderSettings settings = small(17, 13, 3);
    settings.thread_count = 1;
    const ImageF one = render_view(camera, settings, show_direction);
    settings.thread_count = 2;
    EXPECT_EQ(render_view(camera, settings, show_direction), one);
}

TEST(Develop, ExposesToneMapsAndEncodes) {
    // 0.5 · 0.4 = 0.2; Khronos PBR Neutral takes off 0.04 and leaves the rest below 0.76 as it is.
    const Image8 image = develop({1, 1, {glm::vec3(0.5f)}}, 0.4f);
    const uint8_t code = srgb8_from_linear(0.16f);
    EXPECT_EQ(image.pixels[0], (std::array<uint8_t, 4>{code, code, code, 255}));
}

TEST(Develop, AutomaticExposureDoesNotDependOnTheUnit) {
    const ImageF radiance{2, 2, {{0, 0, 0}, {0.25f, 0.5f, 1}, {1, 1, 1}, {4, 2, 1}}};
    ImageF brighter = radiance;
    for (glm::vec3& pixel : brighter.pixels) pixel *= 1024.0f;
    const Image8 image = develop(radiance, 0.0f);
    EXPECT_EQ(develop(brighter, 0.0f), image);
    EXPECT_GT(image.pixels[2][1], 60);
    EXPECT_LT(image.pixels[2][1], 200);
}

TEST(Develop, BlackStaysBlack) {
    const Image8 image = develop({1, 1, {glm::vec3(0.0f)}}, 0.0f);
    EXPECT_EQ(image.pixels[0], (std::array<uint8_t, 4>{0, 0, 0, 255}));
}

TEST(Projection, FindsThePlaceThatARayCameFrom) {
    const Camera perspective = look_at({1, 2, 3}, {-4, 1, 0}, 0.9);
    for (const Camera& camera : {perspective, with_half_height(perspective, 2.5)}) {
        const Projection projection(camera, 640, 360);
        for (const glm::dvec2 place :
             {glm::dvec2(0, 0), glm::dvec2(320, 180), glm::dvec2(600, 20)}) {
            const ViewRay ray = projection.ray(place.x, place.y);
            const glm::dvec3 seen = ray.origin + 7.0 * glm::dvec3(ray.direction);
            const glm::dvec3 view = projection.view_from_world(seen);
            const glm::dvec3 found = projection.picture_from_view(view);
            EXPECT_NEAR(found.x, place.x, 1e-3);
            EXPECT_NEAR(found.y, place.y, 1e-3);
            EXPECT_NEAR(found.z, projection.depth(ray.direction, 7.0), 1e-5);
            EXPECT_NEAR(view_distance(camera, seen), 7.0, 1e-5);
            // A pixel further right at the same depth.
            const double step = projection.pixel_size(found.z);
            EXPECT_NEAR(projection.picture_from_view(view + glm::dvec3(step, 0, 0)).x,
                        found.x + 1.0, 1e-9);
        }
    }
}

}  // namespace
}  // namespace tetralight
