// SPDX-License-Identifier: Apache-2.0
#include <tetralight/render/draw_lines.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace tetralight {
namespace {

constexpr uint32_t kSize = 20;
constexpr float kFar = std::numeric_limits<float>::infinity();

/// Sees 20 × 20 metres at the origin, a metre a pixel, from 20 m away.
const Camera kCamera = look_at({0, 0, 20}, {0, 0, 0}, 2.0 * std::atan(0.5));

const LineStyle kStyle{glm::vec3(1.0f), 1.0f, 0.2f, 1.0f};

/// Sees the same 20 × 20 metres at any depth.
Camera orthographic() {
    Camera camera = kCamera;
    camera.half_height = 10.0;
    return camera;
}

/// A black picture with white lines in front of, or behind, what has this depth.
Image8 drawn(const std::vector<LineSegment>& lines, float depth = kFar,
             const Camera& camera = kCamera) {
    Image8 image{kSize, kSize, {}};
    image.pixels.assign(size_t{kSize} * kSize, {0, 0, 0, 255});
    DepthImage depths{kSize, kSize, {}};
    depths.depths.assign(size_t{kSize} * kSize, {depth, depth, depth, depth});
    draw_lines(image, depths, camera, lines, kStyle);
    return image;
}

double coverage(const Image8& image, uint32_t x, uint32_t y) {
    return image.pixels[size_t{y} * kSize + x][0] / 255.0;
}

double column_sum(const Image8& image, uint32_t x) {
    double sum = 0.0;
    for (uint32_t y = 0; y < kSize; ++y) sum += coverage(image, x, y);
    return sum;
}

double sum_of(const Image8& image) {
    double sum = 0.0;
    for (uint32_t x = 0; x < kSize; ++x) sum += column_sum(image, x);
    return sum;
}

TEST(DrawLines, FillsThePixelsThatItGoesThrough) {
    const Image8 image = drawn({{glm::dvec3(-8, 0.5, 0), glm::dvec3(8, 0.5, 0)}});
    for (uint32_t x = 3; x < 17; ++x) {
        EXPECT_EQ(coverage(image, x, 9), 1.0) << x;  // 0.5 m up: the middle of row 9
        EXPECT_EQ(column_sum(image, x), 1.0) << x;
    }
    EXPECT_EQ(column_sum(image, 0), 0.0);
    EXPECT_EQ(column_sum(image, 19), 0.0);
}

TEST(DrawLines, SharesALineBetweenThePixelsThatItLiesBetween) {
    const Image8 image = drawn({{glm::dvec3(-8, 0, 0), glm::dvec3(8, 0, 0)}});
    EXPECT_NEAR(coverage(image, 10, 9), 0.5, 0.01);
    EXPECT_NEAR(coverage(image, 10, 10), 0.5, 0.01);
}

TEST(DrawLines, HasTheSameBreadthInEveryDirection) {
    // A band of breadth 1 at an angle φ to the rows covers 1 / cos φ of each column; the distance
    // of a pixel's middle stands for its area.
    for (const double rise : {0.0, 0.3, -0.7, 0.99}) {
        const Image8 image = drawn({{glm::dvec3(-9, -9 * rise, 0), glm::dvec3(9, 9 * rise, 0)}});
        EXPECT_NEAR(column_sum(image, 7), std::sqrt(1.0 + rise * rise), 0.16) << rise;
    }
    EXPECT_NEAR(sum_of(drawn({{glm::dvec3(0.5, -9, 0), glm::dvec3(0.5, 9, 0)}})), 18.0 + 1.0,
                0.1);  // and ends
}

TEST(DrawLines, IsFaintBehindASurface) {
    const std::vector<LineSegment> line{{glm::dvec3(-8, 0.5, 0), glm::dvec3(8, 0.5, 0)}};
    EXPECT_NEAR(coverage(drawn(line, 19.0f), 10, 9), 0.2, 0.01);
    EXPECT_NEAR(coverage(drawn(line, 21.0f), 10, 9), 1.0, 0.01);
    EXPECT_NEAR(coverage(drawn(line, 20.0f), 10, 9), 1.0, 0.01);  // in the surface
}

TEST(DrawLines, GoesBehindASurfaceWhereItsDepthDoes) {
    // From 16 m in front of the eye at the left to 24 m at the right: through depth 20 in the
    // middle of the way, which perspective moves to the left of the middle of the picture's
    // stretch.
    const Image8 image = drawn({{glm::dvec3(-4, 0.01, 4), glm::dvec3(4, 0.01, -4)}}, 20.0f);
    const auto row_pair = [&](uint32_t x) {
        return coverage(image, x, 9) + coverage(image, x, 10);
    };
    EXPECT_NEAR(row_pair(9), 1.0, 0.05);
    EXPECT_NEAR(row_pair(11), 0.2, 0.05);
}

TEST(DrawLines, HasTheSamePlaceAtAnyDepthInOrthographicPictures) {
    for (const double z : {0.0, 15.0, -1000.0}) {
        const Image8 image =
            drawn({{glm::dvec3(-8, 0.5, z), glm::dvec3(8, 0.5, z)}}, kFar, orthographic());
        for (uint32_t x = 3; x < 17; ++x) EXPECT_EQ(column_sum(image, x), 1.0) << x;
        EXPECT_EQ(coverage(image, 10, 9), 1.0);
        EXPECT_EQ(column_sum(image, 0), 0.0);
    }
}

TEST(DrawLines, HasADepthThatIsLinearInOrthographicPictures) {
    // From depth 16 at the left to 24 at the right: depth 18 is a quarter of the way, at x = -2.
    const Image8 image =
        drawn({{glm::dvec3(-4, 0.01, 4), glm::dvec3(4, 0.01, -4)}}, 18.0f, orthographic());
    const auto row_pair = [&](uint32_t x) {
        return coverage(image, x, 9) + coverage(image, x, 10);
    };
    EXPECT_NEAR(row_pair(7), 1.0, 0.05);
    EXPECT_NEAR(row_pair(8), 0.2, 0.05);
}

TEST(DrawLines, LeavesOutWhatIsBehindTheEye) {
    EXPECT_EQ(sum_of(drawn({{glm::dvec3(-1, 0, 21), glm::dvec3(1, 0, 30)}})), 0.0);
    EXPECT_EQ(sum_of(drawn({{glm::dvec3(1, 1, 1), glm::dvec3(1, 1, 1)}})), 0.0);
    const Image8 half = drawn({{glm::dvec3(0.5, 0.5, 0), glm::dvec3(0.5, 0.5, 1e6)}});
    EXPECT_GT(sum_of(half), 5.0);  // from the middle out to a corner
}

TEST(RenderDepth, IsThatAlongTheViewOfAPlaneThatFacesIt) {
    RenderSettings settings;
    settings.width = settings.height = 8;
    const auto plane = [](const glm::dvec3& origin, glm::vec3 direction) {
        return static_cast<float>(-origin.z / static_cast<double>(direction.z));
    };
    for (const Camera& camera : {kCamera, orthographic()}) {
        for (const auto& pixel : render_depth(camera, settings, plane).depths) {
            for (const float depth : pixel) EXPECT_NEAR(depth, 20.0f, 1e-4f);
        }
    }
}

}  // namespace
}  // namespace tetralight
