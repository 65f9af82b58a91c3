// SPDX-License-Identifier: Apache-2.0
#include <tetralight/settings/values.h>

#include <gtest/gtest.h>

#include <tetralight/base/error_text.h>
#include <tetralight/settings/read_values.h>

namespace tetralight::settings {
namespace {

Values bake_values(const Json& more = Json::object()) {
    Json json{{"scene", "s.glb"}, {"output", "v.probes"}};
    json.update(more);
    auto values = values_from_json(kBake, json, Access::Command);
    EXPECT_TRUE(values);
    return values ? *values : Values(kBake, Form::Json);
}

TEST(Values, HaveTheDefaultsOfTheTable) {
    const Values values = bake_values();
    EXPECT_EQ(values.number("min_validity"), 0.75);
    EXPECT_EQ(values.integer("bounces"), 1000u);
    EXPECT_FALSE(values.is_given("bounces"));
    EXPECT_EQ(values.text("dering_window"), "mildest");
    EXPECT_EQ(values.find("samples"), nullptr);
    EXPECT_FALSE(values.flag("dering"));
}

TEST(Values, JsonHasThemInTheOrderOfTheTable) {
    const Json json = json_from_values(bake_values({{"bounces", 2}, {"samples", 16}}));
    std::vector<std::string> names;
    for (const auto& [name, value] : json.items()) names.push_back(name);
    const auto at = [&](const char* name) { return std::ranges::find(names, name); };
    EXPECT_LT(at("samples"), at("bounces"));
    EXPECT_EQ(json["bounces"], 2);
}

TEST(Values, WholeNumbersAreTheBitsOfAMask) {
    const auto query = [](const Json& more) {
        Json json{{"volume", "v.probes"}};
        json.update(more);
        const auto values = values_from_json(kQuery, json, Access::Command);
        EXPECT_TRUE(values);
        return values->bits("rendering_layers", 7);
    };
    EXPECT_EQ(query(Json::object()), 7u);
    EXPECT_EQ(query({{"rendering_layers", {0}}}), 1u);
    EXPECT_EQ(query({{"rendering_layers", {31, 0, 31}}}), 0x80000001u);
}

TEST(Values, RenderingLayersAreFrom0To31) {
    for (const Json& layers : {Json::array(), Json{32}, Json{-1}, Json{0.5}, Json{"a"}, Json(3)}) {
        const auto values = values_from_json(
            kQuery, {{"volume", "v.probes"}, {"rendering_layers", layers}}, Access::Command);
        ASSERT_FALSE(values) << layers;
        EXPECT_EQ(values.error().field, "rendering_layers");
    }
}

TEST(Values, ErrorsNameTheSettingInTheFormThatWasUsed) {
    const Error error = bake_values({{"max_samples", 5}}).error("max_samples", "needs more");
    EXPECT_EQ(error.field, "max_samples");
    EXPECT_EQ(error.value, "5");
    EXPECT_EQ(error_text(error), "max_samples: needs more");
    EXPECT_EQ(error_text(Values(kBake, Form::Options).error("max_samples", "needs more")),
              "--max-samples: needs more");
}

}  // namespace
}  // namespace tetralight::settings
