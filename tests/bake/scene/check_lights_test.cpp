// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/scene/check_lights.h>
#include <tetralight/base/error_text.h>

#include <gtest/gtest.h>

#include <cmath>

namespace tetralight {
namespace {

std::string error_of(const Light& light) {
    Scene scene;
    scene.lights = {Light{}, light};
    scene.light_names = {"sun", "lamp"};
    const Status status = check_lights(scene);
    return status ? "(no error)" : error_text(status.error());
}

TEST(CheckLights, NamesTheLightAndTheValue) {
    Light light;
    EXPECT_EQ(error_of(light), "(no error)");
    light.intensity.y = -2.0f;
    EXPECT_EQ(error_of(light), "light 1 \"lamp\": intensity -2 is negative or not finite");
    light.intensity.y = std::nanf("");
    EXPECT_EQ(error_of(light), "light 1 \"lamp\": intensity nan is negative or not finite");
}

TEST(CheckLights, NamesAreOneLine) {
    for (const char* name : {"a\nb", "\r", "bell\a", "\x7f"}) {
        Scene scene;
        scene.lights.resize(1);
        scene.light_names = {name};
        const Status status = check_lights(scene);
        ASSERT_FALSE(status) << name;
        EXPECT_EQ(error_text(status.error()),
                  "light 0 \"" + std::string(name) +
                      "\": the name holds a line break or another control character");
    }
}

TEST(CheckLights, LooksAtEveryNumberThatABakeMultipliesWith) {
    for (float Light::*number : {&Light::indirect_multiplier, &Light::radius, &Light::range}) {
        Light light;
        light.*number = -1.0f;
        EXPECT_NE(error_of(light), "(no error)");
        light.*number = INFINITY;
        EXPECT_NE(error_of(light), "(no error)");
    }
}

}  // namespace
}  // namespace tetralight
