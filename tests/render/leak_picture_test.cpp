// SPDX-License-Identifier: Apache-2.0
#include <tetralight/render/leak_picture.h>

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/random_probes.h"
#include "tests/support/rooms.h"

namespace tetralight {
namespace {

TEST(LeakPicture, ColorsGoFromGreyOverOrangeAndRedToWhite) {
    EXPECT_EQ(leak_color(0.0), glm::vec3(0.62f));
    EXPECT_EQ(leak_color(0.001), leak_color(0.0));
    const glm::vec3 orange = leak_color(0.01), red = leak_color(0.1);
    EXPECT_GT(orange.r, 0.9f);
    EXPECT_GT(orange.g, 2.0f * orange.b);
    EXPECT_GT(red.r, 5.0f * red.g);
    EXPECT_EQ(leak_color(1.0), glm::vec3(1.0f));
    EXPECT_EQ(leak_color(50.0), glm::vec3(1.0f));
}

/// Places in two rooms: those of the second have a tenth of the mean light through the wall.
LeakReport two_rooms_report() {
    LeakReport report;
    report.mean_light = 1.0;
    report.through_walls.mean = 0.05;
    for (int i = 0; i < 50; ++i) {
        LeakPlace place;
        place.position = {0.1 + 1.8 * (i % 10) / 9, 0.1 + 1.8 * (i / 10) / 4, 1.0};
        report.places.push_back(place);
        place.position.x += 2.2;
        place.answer = place.hidden = 0.1;
        report.places.push_back(place);
    }
    return report;
}

TEST(LeakPicture, ShowsLeaksWhereTheyAre) {
    const Scene scene = test::row_of_rooms({1.0f, 0.0f});
    const ProbeVolume volume = test::make_lit_volume(test::random_positions(8, 1));
    const auto image = draw_leaks(scene, volume.view(), two_rooms_report());
    ASSERT_TRUE(image);
    uint32_t left = 0, right = 0;
    for (uint32_t y = 0; y + 40 < image->height; ++y) {  // without the legend
        for (uint32_t x = 0; x < image->width; ++x) {
            const auto& pixel = image->pixels[size_t{y} * image->width + x];
            const bool is_red = pixel[0] > 200 && pixel[1] < 60;
            (2 * x < image->width ? left : right) += is_red;
        }
    }
    EXPECT_EQ(left, 0u);
    EXPECT_GT(right, 1000u);
}

TEST(LeakPicture, IsTheSameForAnyNumberOfThreads) {
    const Scene scene = test::row_of_rooms({1.0f, 0.0f});
    const ProbeVolume volume = test::make_lit_volume(test::random_positions(8, 1));
    const auto one = draw_leaks(scene, volume.view(), two_rooms_report(), 1);
    const auto three = draw_leaks(scene, volume.view(), two_rooms_report(), 3);
    ASSERT_TRUE(one && three);
    EXPECT_EQ(*one, *three);
}

}  // namespace
}  // namespace tetralight
