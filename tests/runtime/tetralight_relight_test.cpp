// SPDX-License-Identifier: Apache-2.0
// Changes of the sky and the sun through the C API.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include <tetralight/base/file.h>
#include <tetralight/probes/compact_probes.h>
#include <tetralight/probes/probe_file.h>
#include <tetralight/probes/recombine.h>
#include <tetralight/probes/relight.h>
#include <tetralight/runtime/tetralight.h>
#include "tests/support/layered_volume.h"
#include "tests/support/temp_folder.h"

namespace tetralight {
namespace {

/// Layers "sun", "sky" and "rest", and probes that see half of each light.
ProbeVolume make_volume() {
    ProbeVolume volume = test::make_layered_volume(20, 3);
    volume.layer_names = "sun\nsky\nrest\n";
    ProbeTransfer transfer;
    for (size_t j = 0; j < 9; ++j) {
        transfer.direct[j][j] = 0.5f;
        transfer.bounced[j][j] = glm::vec3(0.25f, 0.5f, 0.125f);
    }
    volume.transfer.assign(20, transfer);
    volume.sky.resize(1);
    volume.lights.resize(1);
    volume.light_names = "sun\n";
    volume.light_states = {{MixedLighting::Shadowmask, 2, 0, 0}};
    volume.occlusion_lights.assign(20, {kNoIndex, kNoIndex, 0, kNoIndex});
    volume.occlusion.assign(20, glm::vec4(0.5f));
    volume.metadata = R"({"samples":16})";
    make_compact_probes(volume);
    return volume;
}

class CApiRelight : public testing::Test {
  protected:
    CApiRelight() { volume = open(data); }

    ~CApiRelight() override { tetralight_close(volume); }

    CApiRelight(const CApiRelight&) = delete;
    CApiRelight& operator=(const CApiRelight&) = delete;

    tetralight_volume* open(const ProbeVolume& from) {
        const auto bytes = probe_file_bytes(from.view());
        tetralight_volume* opened = nullptr;
        EXPECT_EQ(tetralight_open_memory(bytes.data(), bytes.size(), &opened, &error),
                  TETRALIGHT_OK)
            << error.message;
        return opened;
    }

    /// The volume holds what `data` holds: it is saved as the same bytes.
    void expect_data() {
        const std::string path = folder.path("saved.probes");
        ASSERT_EQ(tetralight_save(volume, path.c_str(), &error), TETRALIGHT_OK) << error.message;
        const auto saved = open_probe_file(path);
        ASSERT_TRUE(saved);
        EXPECT_EQ(copy_volume(saved->view()), data);
    }

    const TempFolder folder;
    ProbeVolume data = make_volume();
    DistantLight sky = distant_sun({0.0f, 1.0f, 0.0f}, {1.0f, 2.0f, 3.0f});
    const float* sky_floats = &sky.coefficients[0].x;
    const float direction[3]{0.0f, -0.8f, 0.6f};
    const float irradiance[3]{5.0f, 4.0f, 3.0f};
    tetralight_volume* volume = nullptr;
    tetralight_error error{};
};

TEST_F(CApiRelight, SkyIsThatOfTheLibrary) {
    tetralight_details details{};
    ASSERT_EQ(tetralight_get_details(volume, &details, &error), TETRALIGHT_OK);
    EXPECT_EQ(details.can_relight_sky, 1u);
    EXPECT_EQ(details.can_relight_sun, 1u);
    ASSERT_EQ(tetralight_relight_sky(volume, sky_floats, &error), TETRALIGHT_OK) << error.message;
    ASSERT_TRUE(relight_sky(data, sky));
    data.metadata = R"({"samples":16,"relit":"tetralight_relight_sky"})";
    expect_data();
}

TEST_F(CApiRelight, SunIsThatOfTheLibrary) {
    ASSERT_EQ(tetralight_relight_sun(volume, direction, irradiance, &error), TETRALIGHT_OK)
        << error.message;
    ASSERT_TRUE(relight_sun(data, {0.0f, -0.8f, 0.6f}, {5.0f, 4.0f, 3.0f}));
    data.metadata = R"({"samples":16,"relit":"tetralight_relight_sun"})";
    expect_data();
    tetralight_scene_light light{};
    ASSERT_EQ(tetralight_get_scene_light(volume, 0, &light, &error), TETRALIGHT_OK);
    EXPECT_EQ(light.direction[1], -0.8f);
    EXPECT_EQ(light.intensity[0], 5.0f);
    EXPECT_EQ(light.channel, TETRALIGHT_NO_CELL);
}

TEST_F(CApiRelight, RecombineWeighsTheNewLayers) {
    const float before[] = {0.5f, 2.0f, 1.0f}, after[] = {1.0f, 0.25f, 0.0f};
    ASSERT_EQ(tetralight_recombine(volume, before, 3, &error), TETRALIGHT_OK);
    ASSERT_EQ(tetralight_relight_sky(volume, sky_floats, &error), TETRALIGHT_OK);
    ASSERT_TRUE(recombine(data, std::vector<float>(before, before + 3)));
    ASSERT_TRUE(relight_sky(data, sky));
    data.metadata = R"({"samples":16,"relit":"tetralight_relight_sky"})";
    expect_data();
    ASSERT_EQ(tetralight_recombine(volume, after, 3, &error), TETRALIGHT_OK);
    ASSERT_EQ(tetralight_relight_sun(volume, direction, irradiance, &error), TETRALIGHT_OK);
    ASSERT_TRUE(recombine(data, std::vector<float>(after, after + 3)));
    ASSERT_TRUE(relight_sun(data, {0.0f, -0.8f, 0.6f}, {5.0f, 4.0f, 3.0f}));
    data.metadata = R"({"samples":16,"relit":"tetralight_relight_sky tetralight_relight_sun"})";
    expect_data();
}

TEST_F(CApiRelight, WeightsAreNotRecordedAsRelit) {
    const float weights[] = {0.5f, 2.0f, 1.0f};
    ASSERT_EQ(tetralight_recombine(volume, weights, 3, &error), TETRALIGHT_OK);
    ASSERT_TRUE(recombine(data, weights));
    expect_data();
}

TEST_F(CApiRelight, WhatIsMissingIsAnErrorAndChangesNothing) {
    ProbeVolume other = data;
    other.layer_names = "lamp\nmoon\nrest\n";
    tetralight_volume* unnamed = open(other);
    EXPECT_EQ(tetralight_relight_sky(unnamed, sky_floats, &error), TETRALIGHT_NOT_THERE);
    EXPECT_STREQ(error.message, "the volume holds no layer \"sky\"");
    EXPECT_EQ(tetralight_relight_sun(unnamed, direction, irradiance, &error), TETRALIGHT_NOT_THERE);
    tetralight_close(unnamed);
    other = data;
    other.transfer.clear();
    tetralight_volume* bare = open(other);
    EXPECT_EQ(tetralight_relight_sky(bare, sky_floats, &error), TETRALIGHT_NOT_THERE);
    EXPECT_STREQ(error.message, "the volume holds no transfer of distant light");
    tetralight_close(bare);
    other = data;
    other.light_states[0].layer = kNoIndex;
    tetralight_volume* sunless = open(other);
    EXPECT_EQ(tetralight_relight_sun(sunless, direction, irradiance, &error), TETRALIGHT_NOT_THERE);
    EXPECT_EQ(tetralight_relight_sky(sunless, sky_floats, &error), TETRALIGHT_OK);
    tetralight_close(sunless);
}

TEST_F(CApiRelight, ArgumentsThatAreWrongAreErrorsAndChangeNothing) {
    DistantLight broken = sky;
    broken.coefficients[15].z = NAN;
    EXPECT_EQ(tetralight_relight_sky(volume, &broken.coefficients[0].x, &error),
              TETRALIGHT_BAD_VALUE);
    EXPECT_STREQ(error.message, "sky[47] is not finite: nan");
    broken = sky;
    broken *= 1e38f;
    EXPECT_EQ(tetralight_relight_sky(volume, &broken.coefficients[0].x, &error),
              TETRALIGHT_BAD_VALUE)
        << "light that is not finite";
    EXPECT_EQ(tetralight_relight_sky(volume, nullptr, &error), TETRALIGHT_BAD_POINTER);
    EXPECT_EQ(tetralight_relight_sky(nullptr, sky_floats, &error), TETRALIGHT_BAD_POINTER);
    const float nowhere[3] = {0.0f, 0.0f, 0.0f}, dark[3] = {1.0f, -1.0f, 1.0f};
    EXPECT_EQ(tetralight_relight_sun(volume, nowhere, irradiance, &error), TETRALIGHT_BAD_VALUE);
    EXPECT_STREQ(error.message, "direction is not a unit vector: its length is 0");
    EXPECT_EQ(tetralight_relight_sun(volume, direction, dark, &error), TETRALIGHT_BAD_VALUE);
    EXPECT_STREQ(error.message, "irradiance[1] is negative: -1");
    EXPECT_EQ(tetralight_relight_sun(volume, nullptr, irradiance, &error), TETRALIGHT_BAD_POINTER);
    EXPECT_EQ(tetralight_relight_sun(volume, direction, nullptr, &error), TETRALIGHT_BAD_POINTER);
    EXPECT_EQ(tetralight_relight_sun(nullptr, direction, irradiance, &error),
              TETRALIGHT_BAD_POINTER);
    expect_data();
}

/// A file whose sections do not fit together is opened lazily: nothing is written out of bounds.
TEST_F(CApiRelight, SectionsThatDoNotFitAreCorrupt) {
    const auto relight_lazily = [&](const ProbeVolume& wrong) {
        const std::string path = folder.path("wrong.probes");
        EXPECT_TRUE(write_file(path, probe_file_bytes(wrong.view())));
        tetralight_volume* lazy = nullptr;
        EXPECT_EQ(tetralight_open_lazy(path.c_str(), &lazy, &error), TETRALIGHT_OK);
        const tetralight_status status = tetralight_relight_sky(lazy, sky_floats, &error);
        tetralight_close(lazy);
        return status;
    };
    ProbeVolume wrong = data;
    wrong.layers.resize(1);
    EXPECT_EQ(relight_lazily(wrong), TETRALIGHT_NOT_THERE);
    wrong = data;
    wrong.irradiance.resize(1);
    EXPECT_EQ(relight_lazily(wrong), TETRALIGHT_CORRUPT);
    wrong = data;
    wrong.compact.resize(1);
    EXPECT_EQ(relight_lazily(wrong), TETRALIGHT_CORRUPT);
}

TEST_F(CApiRelight, SavingToWhereNothingCanBeIsAnError) {
    EXPECT_EQ(tetralight_save(volume, nullptr, &error), TETRALIGHT_BAD_POINTER);
    EXPECT_EQ(tetralight_save(nullptr, "a.probes", &error), TETRALIGHT_BAD_POINTER);
    const std::string path = folder.path("missing/a.probes");
    EXPECT_EQ(tetralight_save(volume, path.c_str(), &error), TETRALIGHT_BAD_FILE);
    EXPECT_NE(std::string(error.message).find(path), std::string::npos) << error.message;
}

}  // namespace
}  // namespace tetralight
