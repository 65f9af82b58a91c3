// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/bake_settings.h>

#include <gtest/gtest.h>

#include <tetralight/settings/read_values.h>

namespace tetralight::test {
namespace {

using settings::Json;
using settings::Values;

Values values_of(const Json& more) {
    Json json{{"scene", "s.glb"}, {"output", "v.probes"}};
    json.update(more);
    auto values = settings::values_from_json(settings::kBake, json, settings::Access::Command);
    EXPECT_TRUE(values);
    return values ? *values : Values(settings::kBake, settings::Form::Json);
}

TEST(BakeSettings, DefaultsOfTheTableAreThoseOfTheLibrary) {
    const BakeVolumeSettings library;
    EXPECT_EQ(cli::bake_settings(values_of({{"samples", library.bake.sample_count}})), library);
}

TEST(BakeSettings, WithoutSamplesAnErrorIsTheTarget) {
    const BakeSettings settings = cli::bake_settings(values_of(Json::object())).bake;
    EXPECT_EQ(settings, with_default_target({}));
}

TEST(BakeSettings, LayersHaveATargetByDefaultAndOnlyThen) {
    const Json layers{{"layers", {"sun"}}};
    const auto target = [&](const Json& more) {
        Json json = layers;
        json.update(more);
        return cli::bake_settings(values_of(json)).bake.target_layer_error;
    };
    EXPECT_EQ(target(Json::object()), kDefaultLayerError);
    EXPECT_EQ(target({{"samples", 64}}), 0.0);
    EXPECT_EQ(target({{"target_error", 0.01}}), 0.0);
    EXPECT_EQ(target({{"target_error", 0.01}, {"target_layers", 0.03}}), 0.03);
    EXPECT_EQ(target({{"target_layers", 0.03}, {"max_samples", 5000}}), 0.03);
    EXPECT_EQ(cli::bake_settings(values_of(Json::object())).bake.target_layer_error, 0.0);
}

TEST(BakeSettings, AMaximumNeedsRounds) {
    EXPECT_THROW((void)cli::bake_settings(values_of({{"max_samples", 5}})), cli::UsageError);
    const Values values = values_of({{"max_samples", 2048}, {"target_error", 0.01}});
    EXPECT_EQ(cli::bake_settings(values).bake.max_sample_count, 2048u);
    // The first round has 1024 samples.
    EXPECT_THROW(
        (void)cli::bake_settings(values_of({{"max_samples", 1023}, {"target_error", 0.01}})),
        cli::UsageError);
    EXPECT_THROW((void)cli::bake_settings(values_of({{"max_samples", 5}, {"samples", 6}})),
                 cli::UsageError);
    // Rounds without a target have 128 samples at least.
    EXPECT_THROW((void)cli::bake_settings(values_of({{"max_samples", 127}, {"samples", 64}})),
                 cli::UsageError);
    const BakeSettings rounds =
        cli::bake_settings(values_of({{"max_samples", 512}, {"samples", 128}})).bake;
    EXPECT_EQ(rounds.max_sample_count, 512u);
    EXPECT_EQ(rounds.target_error, 0.0);
}

}  // namespace
}  // namespace tetralight::test
