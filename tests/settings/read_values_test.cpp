// SPDX-License-Identifier: Apache-2.0
#include <tetralight/settings/read_values.h>

#include <gtest/gtest.h>

#include <tetralight/base/error_text.h>

namespace tetralight::settings {
namespace {

Argument argument(const Table& table, std::string_view name, std::string text) {
    return {table.find(name), std::move(text)};
}

Result<Values> from_json(const Json& json, Access caller = Access::Command) {
    return values_from_json(kGrid, json, caller);
}

const Json kSmallest{{"scene", "s.glb"}, {"output", "g.json"}};

Json with(const Json& more) {
    Json json = kSmallest;
    json.update(more);
    return json;
}

TEST(ReadValues, ReadsArgumentsAndJsonAlike) {
    const Argument arguments[] = {
        argument(kGrid, "scene", "s.glb"), argument(kGrid, "output", "g.json"),
        argument(kGrid, "spacing", "2"),   argument(kGrid, "from", "1,2,3"),
        argument(kGrid, "from", "4,5,6"),  argument(kGrid, "heights", "1,2")};
    const auto typed = values_from_arguments(kGrid, arguments);
    ASSERT_TRUE(typed) << error_text(typed.error());
    const auto read =
        from_json(with({{"spacing", 2}, {"from", {{1, 2, 3}, {4, 5, 6}}}, {"heights", {1, 2}}}));
    ASSERT_TRUE(read) << error_text(read.error());
    EXPECT_EQ(json_from_values(*typed), json_from_values(*read));
}

TEST(ReadValues, NamesTheSettingAndTheValueOfAnError) {
    const auto values = from_json(with({{"region_size", -1}}));
    ASSERT_FALSE(values);
    EXPECT_EQ(values.error().code, ErrorCode::InvalidArgument);
    EXPECT_EQ(values.error().field, "region_size");
    EXPECT_EQ(values.error().value, "-1");
    EXPECT_EQ(error_text(values.error()), "region_size: -1 is not in the range 0 to 1e9");
}

TEST(ReadValues, NamesTheElementOfAListOfAnError) {
    const auto values = from_json(with({{"from", {{1, 2, 3}, {1, 2}}}}));
    ASSERT_FALSE(values);
    EXPECT_EQ(values.error().field, "from[1]");
}

TEST(ReadValues, OptionsAreNamedAsTheyAreTyped) {
    const Argument arguments[] = {argument(kGrid, "region_size", "many")};
    const auto values = values_from_arguments(kGrid, arguments);
    ASSERT_FALSE(values);
    EXPECT_EQ(error_text(values.error()), "--region-size: \"many\" is not a number");
}

TEST(ReadValues, RefusesAnOptionThatIsGivenTwice) {
    const Argument arguments[] = {argument(kGrid, "name", "a"), argument(kGrid, "name", "b")};
    const auto values = values_from_arguments(kGrid, arguments);
    ASSERT_FALSE(values);
    EXPECT_EQ(error_text(values.error()), "--name is given more than once");
}

TEST(ReadValues, WantsWhatIsRequiredAndWhatIsNeeded) {
    const auto without_scene = from_json({{"output", "g.json"}});
    ASSERT_FALSE(without_scene);
    EXPECT_EQ(error_text(without_scene.error()), "scene is required");
    const auto without_max = from_json(with({{"min", {0, 0, 0}}}));
    ASSERT_FALSE(without_max);
    EXPECT_EQ(error_text(without_max.error()), "min: needs max");
    const auto with_both = from_json(
        with({{"min", {0, 0, 0}}, {"max", {1, 1, 1}}, {"bounds_of", Json::array({"a"})}}));
    ASSERT_FALSE(with_both);
    EXPECT_EQ(error_text(with_both.error()), "bounds_of: does not go with min");
}

TEST(ReadValues, AFlagThatIsFalseAndANullCountAsNotGiven) {
    const auto values = from_json(with({{"json", false}, {"name", nullptr}}));
    ASSERT_TRUE(values);
    EXPECT_FALSE(values->is_given("json"));
    EXPECT_EQ(values->text("name"), "grid");
}

TEST(ReadValues, SuggestsANearName) {
    const auto values = from_json(with({{"spacin", 2}}));
    ASSERT_FALSE(values);
    EXPECT_EQ(error_text(values.error()),
              "spacin: there is no such setting; did you mean spacing?");
}

TEST(ReadValues, TheServiceHasNoSettingsOfTheCommand) {
    const auto values = values_from_json(kGrid, {{"output", "/etc/passwd"}}, Access::Service);
    ASSERT_FALSE(values);
    EXPECT_EQ(values.error().field, "output");
}

TEST(ReadValues, LeavesMembersOfTheCallerAlone) {
    EXPECT_TRUE(values_from_json(kGrid, with({{"priority", 3}}), Access::Command, "priority x"));
    EXPECT_FALSE(values_from_json(kGrid, Json::array(), Access::Command));
}

}  // namespace
}  // namespace tetralight::settings
