// SPDX-License-Identifier: Apache-2.0
#include <tetralight/settings/json_schema.h>

#include <gtest/gtest.h>

#include <cmath>

namespace tetralight::settings {
namespace {

TEST(JsonSchema, HasLimitsDefaultUnitAndHelp) {
    const Json schema = json_schema(*kBake.find("min_validity"));
    EXPECT_EQ(schema["type"], "number");
    EXPECT_EQ(schema["minimum"], 0.0);
    EXPECT_EQ(schema["maximum"], 1.0);
    EXPECT_EQ(schema["default"], 0.75);
    EXPECT_EQ(schema["x-unit"], "fraction");
    EXPECT_EQ(schema["description"], kBake.find("min_validity")->help);
}

TEST(JsonSchema, ChoicesAreAnEnumeration) {
    EXPECT_EQ(json_schema(*kBake.find("dering_window"))["enum"],
              Json::array({"mildest", "hann", "lanczos"}));
}

TEST(JsonSchema, SeedsHaveAll64Bits) {
    const Json schema = json_schema(*kBake.find("seed"));
    EXPECT_EQ(schema["type"], "integer");
    EXPECT_EQ(schema["maximum"], Json(UINT64_MAX));
}

TEST(JsonSchema, VectorsAreArraysOfThree) {
    const Json schema = json_schema(*kBake.find("sun_direction"));
    EXPECT_EQ(schema["minItems"], 3);
    EXPECT_EQ(schema["maxItems"], 3);
}

TEST(JsonSchema, AnObjectHasWhatItsCallerMaySet) {
    const Json service = json_schema(kBake, Access::Service);
    EXPECT_TRUE(service["properties"].contains("samples"));
    EXPECT_FALSE(service["properties"].contains("output"));
    EXPECT_EQ(service["required"], Json::array({"scene"}));
    EXPECT_TRUE(json_schema(kBake, Access::Command)["properties"].contains("output"));
}

}  // namespace
}  // namespace tetralight::settings
