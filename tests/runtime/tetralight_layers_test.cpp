// SPDX-License-Identifier: Apache-2.0
// Layers of light through the C API.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include <tetralight/probes/compact_probes.h>
#include <tetralight/probes/interpolate.h>
#include <tetralight/probes/probe_file.h>
#include <tetralight/probes/recombine.h>
#include <tetralight/runtime/tetralight.h>
#include "tests/support/property_volume.h"
#include "tests/support/temp_folder.h"

namespace tetralight {
namespace {

/// A volume whose light is that of two layers.
ProbeVolume make_layered_volume(bool is_compact) {
    ProbeVolume volume = test::make_random_volume(test::random_positions(100, 1), 2);
    std::mt19937_64 engine(3);
    volume.layers.resize(2);
    volume.layer_names = "light:lamp\nrest\n";
    for (Layer& layer : volume.layers) {
        layer.largest = 4.0f;
        layer.ambient = test::random_light(engine, 0.5f, 1.0f);
        for (size_t i = 0; i < volume.positions.size(); ++i) {
            volume.layer_irradiance.push_back(test::random_light(engine, 0.5f, 2.0f));
        }
    }
    EXPECT_TRUE(recombine(volume, std::vector<float>{1.0f, 1.0f}));
    if (is_compact) make_compact_probes(volume);
    return volume;
}

class CApiLayers : public testing::TestWithParam<bool> {
  protected:
    CApiLayers() {
        const std::string path = folder.write("test.probes", probe_file_bytes(data.view()));
        EXPECT_EQ(tetralight_open(path.c_str(), &volume, &error), TETRALIGHT_OK) << error.message;
    }

    ~CApiLayers() override { tetralight_close(volume); }

    CApiLayers(const CApiLayers&) = delete;
    CApiLayers& operator=(const CApiLayers&) = delete;

    void expect_light_of(const ProbeVolume& expected) {
        const float at[] = {0.1f, 0.2f, -0.3f}, far[] = {NAN, 0.0f, 0.0f};
        tetralight_light light{}, ambient{};
        ASSERT_EQ(tetralight_query(volume, at, nullptr, &light, &error), TETRALIGHT_OK);
        ASSERT_EQ(tetralight_query(volume, far, nullptr, &ambient, &error), TETRALIGHT_OK);
        const auto view = expected.view();
        const PackedSh packed =
            pack_sh(interpolate(view, locate(view, {0.1f, 0.2f, -0.3f})).irradiance);
        EXPECT_EQ(std::memcmp(light.packed, &packed, sizeof packed), 0);
        EXPECT_EQ(ambient.packed[3], pack_sh(view.info.ambient).sha_r.w);
    }

    TempFolder folder;
    ProbeVolume data = make_layered_volume(GetParam());
    tetralight_volume* volume = nullptr;
    tetralight_error error{};
};

TEST_P(CApiLayers, HaveNamesAndWeights) {
    tetralight_info info{};
    ASSERT_EQ(tetralight_get_info(volume, &info, &error), TETRALIGHT_OK);
    EXPECT_EQ(info.layer_count, 2u);
    tetralight_layer layer{};
    ASSERT_EQ(tetralight_get_layer(volume, 0, &layer, &error), TETRALIGHT_OK);
    EXPECT_STREQ(layer.name, "light:lamp");
    EXPECT_EQ(layer.weight, 1.0f);
    EXPECT_EQ(tetralight_get_layer(volume, 2, &layer, &error), TETRALIGHT_NOT_THERE);
    EXPECT_EQ(tetralight_get_layer(volume, 0, nullptr, &error), TETRALIGHT_BAD_POINTER);
    EXPECT_EQ(tetralight_get_layer(nullptr, 0, &layer, &error), TETRALIGHT_BAD_POINTER);
}

TEST_P(CApiLayers, WeighTheLightOfEveryQuery) {
    expect_light_of(data);
    for (const std::vector<float>& weights : {std::vector{0.0f, 2.0f}, std::vector{1.5f, 0.25f}}) {
        ASSERT_EQ(tetralight_recombine(volume, weights.data(), 2, &error), TETRALIGHT_OK);
        ProbeVolume expected = data;
        ASSERT_TRUE(recombine(expected, weights));
        expect_light_of(expected);
        tetralight_layer layer{};
        ASSERT_EQ(tetralight_get_layer(volume, 1, &layer, &error), TETRALIGHT_OK);
        EXPECT_EQ(layer.weight, weights[1]);
    }
}

TEST_P(CApiLayers, WrongWeightsChangeNothing) {
    const float good[] = {1.0f, 1.0f, 1.0f}, negative[] = {1.0f, -1.0f}, nan[] = {NAN, 0.0f};
    EXPECT_EQ(tetralight_recombine(nullptr, good, 2, &error), TETRALIGHT_BAD_POINTER);
    EXPECT_EQ(tetralight_recombine(volume, nullptr, 2, &error), TETRALIGHT_BAD_POINTER);
    EXPECT_EQ(tetralight_recombine(volume, good, 1, &error), TETRALIGHT_SHORT_BUFFER);
    EXPECT_STREQ(error.message, "1 weights for 2 layers");
    EXPECT_EQ(tetralight_recombine(volume, good, 3, &error), TETRALIGHT_BAD_VALUE);
    EXPECT_EQ(tetralight_recombine(volume, negative, 2, &error), TETRALIGHT_BAD_VALUE);
    EXPECT_EQ(tetralight_recombine(volume, nan, 2, &error), TETRALIGHT_BAD_VALUE);
    expect_light_of(data);
}

INSTANTIATE_TEST_SUITE_P(Precisions, CApiLayers, testing::Bool(),
                         [](const auto& is) { return is.param ? "Compact" : "Floats"; });

TEST(CApiLayersNone, AreSaid) {
    const TempFolder folder;
    const ProbeVolume data = test::make_random_volume(test::random_positions(20, 1), 2);
    const std::string path = folder.write("plain.probes", probe_file_bytes(data.view()));
    tetralight_volume* volume = nullptr;
    tetralight_error error;
    ASSERT_EQ(tetralight_open(path.c_str(), &volume, &error), TETRALIGHT_OK);
    const float weight = 1.0f;
    EXPECT_EQ(tetralight_recombine(volume, &weight, 1, &error), TETRALIGHT_NOT_THERE);
    tetralight_close(volume);
}

}  // namespace
}  // namespace tetralight
