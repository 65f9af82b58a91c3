// SPDX-License-Identifier: Apache-2.0
// What holds for every setting of every command.
#include <gtest/gtest.h>

#include <cctype>
#include <set>

#include <tetralight/base/error_text.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/settings/read_values.h>
#include <tetralight/settings/value_json.h>
#include <tetralight/settings/value_text.h>

namespace tetralight::settings {
namespace {

/// Calls `check(table, setting)` for all settings there are.
template <class Check>
void for_each_setting(Check check) {
    for (const Table* table : all_tables()) {
        table->for_each([&](const Setting& setting) {
            SCOPED_TRACE(str_cat(table->command, " ", setting.name));
            check(*table, setting);
        });
    }
}

bool has_unit(Type type) {
    switch (type) {
        case Type::Flag:
        case Type::Text:
        case Type::Choice:
        case Type::Path:
        case Type::Words:
            return false;
        default:
            return true;
    }
}

bool needs_a_range(Type type) {
    return has_unit(type) && type != Type::Range && type != Type::Weights;
}

/// A value that differs from the default, as an option and as JSON.
struct Example {
    std::string text;
    Json json;
};

double number_in(const Range& range) {
    return range.min > 1.0 || range.max < 1.0 ? (range.min + range.max) / 2.0 : 1.0;
}

std::string first_word(std::string_view list) {
    return std::string(list.substr(0, list.find(' ')));
}

Example example_of(const Setting& setting) {
    const double x = number_in(setting.range);
    const std::string t = number_text(x);
    switch (setting.type) {
        case Type::Flag:
            return {"true", true};
        case Type::Integer:
            return {std::to_string(static_cast<int64_t>(x)), static_cast<int64_t>(x)};
        case Type::Number:
            return {t, x};
        case Type::Fraction:
            return {"25%", 0.25};
        case Type::Seconds:
            return {"1.5m", 90};
        case Type::Range:
            return {"3..9", "3..9"};
        case Type::Text:
            return {"word", "word"};
        case Type::Choice:
            return {first_word(setting.choices), first_word(setting.choices)};
        case Type::Path:
            return {"file" + first_word(setting.extensions),
                    "file" + first_word(setting.extensions)};
        case Type::Vector:
        case Type::Direction:
            return {"1,2,3.5", Json::array({1, 2, 3.5})};
        case Type::Scale:
        case Type::Sky:
            return {"2", 2};
        case Type::Numbers:
        case Type::Integers: {
            Example example{"1", Json::array({1})};
            for (uint32_t i = 1; i < setting.count; ++i) {
                example.text += ",1";
                example.json.push_back(1);
            }
            return example;
        }
        case Type::Words:
            return {"sun,sky", Json::array({"sun", "sky"})};
        case Type::Weights:
            return {"a=1,b=0.5", Json{{"a", 1}, {"b", 0.5}}};
    }
    return {};
}

TEST(Tables, NamesAreSnakeCaseAndStandOnceInATable) {
    for (const Table* table : all_tables()) {
        std::set<std::string_view> names;
        std::set<char> letters;
        table->for_each([&](const Setting& setting) {
            EXPECT_TRUE(names.insert(setting.name).second) << setting.name;
            EXPECT_FALSE(setting.name.empty());
            for (const char c : setting.name) EXPECT_TRUE(std::islower(c) || c == '_');
            const char letter = setting.short_name;
            EXPECT_TRUE(letter == 0 || letters.insert(letter).second) << letter;
        });
    }
}

TEST(Tables, EveryCommandHasASummaryAndAnExampleOfItself) {
    for (const Table* table : all_tables()) {
        EXPECT_FALSE(table->summary.empty());
        EXPECT_NE(table->examples.find(str_cat("tetralight ", table->command)), std::string::npos);
        for (const Group& group : table->groups) EXPECT_FALSE(group.heading.empty());
    }
}

TEST(Tables, CommandsWithASceneSayHowItIsRead) {
    int count = 0;
    for (const Table* table : all_tables()) {
        if (table->find("scene") == nullptr) continue;
        ++count;
        for (const char* name : {"scene_name", "time", "animation", "light_unit"})
            EXPECT_NE(table->find(name), nullptr) << table->command << " " << name;
    }
    EXPECT_GE(count, 12);
}

TEST(Tables, EverySettingHasHelpOnOneLine) {
    for_each_setting([](const Table&, const Setting& setting) {
        ASSERT_FALSE(setting.help.empty());
        EXPECT_EQ(setting.help.find('\n'), std::string::npos);
        EXPECT_NE(setting.help.back(), '.');
        EXPECT_NE(setting.help.back(), ' ');
    });
}

TEST(Tables, NumbersHaveAUnitAndARangeThatIsNotEmpty) {
    for_each_setting([](const Table&, const Setting& setting) {
        EXPECT_EQ(!setting.unit.empty(), has_unit(setting.type));
        if (!needs_a_range(setting.type)) return;
        EXPECT_LT(setting.range.min, setting.range.max);
        EXPECT_FALSE(range_text(setting.range).empty());
    });
}

TEST(Tables, EverySettingHasADefaultOrSaysWhatHoldsWithoutOne) {
    for_each_setting([](const Table&, const Setting& setting) {
        const bool has_one = !setting.default_text.empty() || !setting.without.empty();
        EXPECT_EQ(has_one, setting.type != Type::Flag && !setting.is_required);
        EXPECT_TRUE(setting.default_text.empty() || setting.without.empty());
    });
}

TEST(Tables, DefaultsPassTheChecksOfTheirSetting) {
    for_each_setting([](const Table&, const Setting& setting) {
        if (setting.default_text.empty()) return;
        const auto value = value_from_text(setting, setting.default_text);
        EXPECT_TRUE(value) << error_text(value.error());
    });
}

TEST(Tables, ChoicesStandInATableAndNowhereElse) {
    for_each_setting([](const Table&, const Setting& setting) {
        EXPECT_EQ(!setting.choices.empty(), setting.type == Type::Choice);
    });
}

TEST(Tables, NeedsAndExcludesNameOtherSettings) {
    for_each_setting([](const Table& table, const Setting& setting) {
        for (const std::string_view list : {setting.needs, setting.excludes}) {
            for_each_word(list, [&](std::string_view other) {
                EXPECT_NE(table.find(other), nullptr) << other;
                EXPECT_NE(setting.name, other);
            });
        }
    });
}

TEST(Tables, OptionsAndJsonGiveTheSameValues) {
    for_each_setting([](const Table&, const Setting& setting) {
        const Example example = example_of(setting);
        const auto from_text = value_from_text(setting, example.text);
        ASSERT_TRUE(from_text) << error_text(from_text.error());
        const auto from_json = value_from_json(setting, example.json);
        ASSERT_TRUE(from_json) << error_text(from_json.error());
        EXPECT_EQ(*from_text, *from_json);
    });
}

TEST(Tables, NumbersOutsideTheirRangeAreRefusedInBothForms) {
    for_each_setting([](const Table&, const Setting& setting) {
        if (setting.type != Type::Number && setting.type != Type::Integer) return;
        const Range range = setting.range;
        for (const double wrong : {range.min - 1.0, 2.0 * range.max + 1.0}) {
            EXPECT_FALSE(value_from_text(setting, str_cat(wrong))) << wrong;
            EXPECT_FALSE(value_from_json(setting, wrong)) << wrong;
        }
        EXPECT_FALSE(value_from_text(setting, "nan"));
        EXPECT_FALSE(value_from_text(setting, ""));
        EXPECT_FALSE(value_from_text(setting, "1x"));
    });
}

TEST(Tables, TheServiceMaySetNoFileToWrite) {
    for_each_setting([](const Table&, const Setting& setting) {
        EXPECT_TRUE(setting.extensions.empty() || setting.access == Access::Command);
    });
}

}  // namespace
}  // namespace tetralight::settings
