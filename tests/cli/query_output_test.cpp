// SPDX-License-Identifier: Apache-2.0
// What `query` answers, and the forms in which it writes.
#include <bit>
#include <charconv>
#include <functional>

#include <tetralight/probes/interpolate.h>
#include <tetralight/probes/probe_file.h>
#include "tests/cli/query_fixture.h"

namespace tetralight::test {
namespace {

class QueryOutput : public QueryFixture {
  protected:
    [[nodiscard]] std::string raw_answers(const std::vector<glm::vec3>& positions,
                                          const Arguments& options = {}) const {
        Arguments arguments{"query", "v.probes", "--from", "raw", "--to", "raw"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        return succeed(arguments, raw(positions)).out;
    }

    /// What the library answers when every walk begins at the seed of its position.
    [[nodiscard]] static std::string library_answers(const ProbeVolumeView& volume,
                                                     const std::vector<glm::vec3>& positions,
                                                     const OutsideHull& outside = {}) {
        std::vector<uint32_t> cells(positions.size(), kNoIndex);
        std::vector<IrradianceSh> light(positions.size());
        std::vector<glm::vec4> occlusion(positions.size());
        EXPECT_TRUE(interpolate(volume, {.positions = positions,
                                         .hints = cells,
                                         .irradiance = light,
                                         .occlusion = occlusion,
                                         .outside = outside}));
        std::vector<RawRecord> records(positions.size());
        for (size_t i = 0; i < records.size(); ++i) {
            std::memcpy(records[i].irradiance, &light[i], sizeof records[i].irradiance);
            std::memcpy(records[i].occlusion, &occlusion[i], sizeof records[i].occlusion);
            records[i].cell = cells[i];
        }
        return raw(std::span<const RawRecord>(records));
    }
};

/// The last of them are denormal and not finite.
std::vector<glm::vec3> with_odd_ones(std::vector<glm::vec3> positions) {
    positions.emplace_back(1e-40f, -1e-42f, 1e-45f);
    positions.emplace_back(std::bit_cast<float>(0x7fc00000u), 0.0f, 0.0f);
    positions.emplace_back(3e38f, -3e38f, 3e38f);
    return positions;
}

std::vector<std::string> split(const std::string& line, char separator) {
    std::istringstream stream(line);
    std::vector<std::string> parts;
    for (std::string part; std::getline(stream, part, separator);) parts.push_back(part);
    return parts;
}

float float_of(const std::string& digits) {
    float number = -1.0f;
    const auto end = std::from_chars(digits.data(), digits.data() + digits.size(), number).ptr;
    EXPECT_EQ(end, digits.data() + digits.size()) << digits;
    return number;
}

TEST_F(QueryOutput, IsWhatTheLibraryAnswers) {
    const auto positions = with_odd_ones(random_positions(5000));
    const auto file = open_probe_file(path("v.probes"));
    ASSERT_TRUE(file);
    EXPECT_TRUE(raw_answers(positions) ==
                library_answers(file->view().without_compact(), positions));
    EXPECT_TRUE(raw_answers(positions, {"--precision", "half"}) ==
                library_answers(file->view(), positions));
}

TEST_F(QueryOutput, FollowsThePolicyOutsideTheHull) {
    const auto positions = with_odd_ones(random_positions(5000));
    const auto file = open_probe_file(path("v.probes"));
    ASSERT_TRUE(file);
    const ProbeVolumeView volume = file->view().without_compact();
    const std::pair<Arguments, OutsideHull> kPolicies[] = {
        {{"--outside", "extrapolate"}, {OutsidePolicy::Extrapolate}},
        {{"--outside", "clamp"}, {OutsidePolicy::Clamp}},
        {{"--outside", "ambient"}, {OutsidePolicy::Ambient}},
        {{"--outside", "ambient", "--fade", "2.5"}, {OutsidePolicy::Ambient, 2.5f}},
    };
    for (const auto& [options, outside] : kPolicies) {
        EXPECT_TRUE(raw_answers(positions, options) == library_answers(volume, positions, outside))
            << options.back();
    }
}

/// Two metres from the face x = 0 and fading over four, half of the light is ambient.
TEST_F(QueryOutput, SaysHowMuchOfTheLightIsAmbient) {
    const auto half = answers("-2 1 1\n", {"--outside", "ambient", "--fade", "4"});
    EXPECT_NEAR(half.at(0)["ambient"].get<double>(), 0.5, 1e-6);
    const auto none = answers("-2 1 1\n1 1 1\n");
    EXPECT_EQ(none.at(0)["ambient"], 0.0);
    EXPECT_EQ(none.at(1)["ambient"], 0.0);
    const Arguments fading{"query", "v.probes", "--outside", "ambient", "--fade", "4"};
    EXPECT_TRUE(contains(succeed(fading, "-2 1 1").out, ", ambient×0.5"));
    EXPECT_FALSE(contains(succeed(fading, "1 1 1").out, "ambient"));
}

TEST_F(QueryOutput, HasTheFloatsOfRawInCsv) {
    const auto positions = random_positions(100);
    const auto expected = raw_records(raw_answers(positions));
    write("p.f32", raw(positions));
    const auto lines = split(succeed({"query", "v.probes", "p.f32", "--to", "csv"}).out, '\n');
    ASSERT_EQ(lines.size(), 101u);
    EXPECT_EQ(lines[0].find("x,y,z,cell,sh0_r,sh0_g,sh0_b,sh1_r,"), 0u);
    EXPECT_EQ(split(lines[0], ',').size(), 35u);
    for (size_t i = 0; i < positions.size(); ++i) {
        const auto values = split(lines[i + 1], ',');
        ASSERT_EQ(values.size(), 35u);
        for (int k = 0; k < 3; ++k) EXPECT_EQ(float_of(values.at(k)), positions[i][k]);
        EXPECT_EQ(values[3], std::to_string(expected[i].cell));
        for (size_t k = 0; k < 27; ++k)
            EXPECT_EQ(float_of(values[4 + k]), expected[i].irradiance[k]);
        for (size_t k = 0; k < 4; ++k)
            EXPECT_EQ(float_of(values[31 + k]), expected[i].occlusion[k]);
    }
}

TEST_F(QueryOutput, HasTheFloatsOfRawInJson) {
    const auto positions = random_positions(100);
    const auto expected = raw_records(raw_answers(positions));
    const auto all = answers(raw(positions), {"--from", "raw"});
    ASSERT_EQ(all.size(), expected.size());
    for (size_t i = 0; i < all.size(); ++i) {
        EXPECT_EQ(all[i]["cell"], expected[i].cell);
        for (size_t k = 0; k < 27; ++k) {
            EXPECT_EQ(all[i]["irradiance_sh"][k / 3][k % 3].get<float>(),
                      expected[i].irradiance[k]);
        }
        for (size_t k = 0; k < 4; ++k) {
            EXPECT_EQ(all[i]["occlusion"][k].get<float>(), expected[i].occlusion[k]);
        }
    }
}

/// The digits of JSON and CSV are the same: the shortest ones.
TEST_F(QueryOutput, HasTheNumbersOfCsvInJson) {
    const std::string positions = raw(random_positions(20));
    const auto json =
        split(succeed({"query", "v.probes", "--from", "raw", "--json"}, positions).out, '\n');
    const auto csv =
        split(succeed({"query", "v.probes", "--from", "raw", "--to", "csv"}, positions).out, '\n');
    for (size_t i = 0; i < json.size(); ++i) {
        const auto values = split(csv.at(i + 1), ',');
        const std::string position = values[0] + "," + values[1] + "," + values[2];
        EXPECT_EQ(json[i].find("{\"position\":[" + position + "],\"cell\":" + values[3]), 0u);
        EXPECT_NE(json[i].find("\"irradiance_sh\":[[" + values[4] + "," + values[5] + ","),
                  std::string::npos);
    }
}

TEST_F(QueryOutput, HasNoCellWhereThereIsNone) {
    EXPECT_EQ(raw_records(succeed({"query", "v.probes", "--to", "raw"}, "nan 0 0").out).at(0).cell,
              0xffffffffu);
    const std::string csv = succeed({"query", "v.probes", "--to", "csv"}, "nan 0 0").out;
    EXPECT_TRUE(contains(csv, "\nnan,0,0,,")) << csv;
    EXPECT_EQ(answers("nan 0 0").at(0)["position"], (Json{nullptr, 0, 0}));
}

TEST_F(QueryOutput, HasItsHeaderWithoutPositions) {
    const std::string header = succeed({"query", "v.probes", "--to", "csv"}, "").out;
    EXPECT_EQ(header.find('\n') + 1, header.size());
    EXPECT_EQ(split(header, ',').size(), 35u);
}

TEST_F(QueryOutput, DoesNotDependOnThreads) {
    const auto positions = random_positions(100'000);
    EXPECT_TRUE(raw_answers(positions, {"-j", "1"}) == raw_answers(positions));
}

TEST_F(QueryOutput, HasTheFormatOfItsName) {
    write("p.txt", "1 1 1\n2 3 4\n");
    for (const auto& [name, format] : {std::pair{"a.txt", "text"},
                                       {"a.csv", "csv"},
                                       {"a.jsonl", "jsonl"},
                                       {"a.f32", "raw"},
                                       {"a.raw", "raw"},
                                       {"A.BIN", "raw"},
                                       {"a", "text"}}) {
        succeed({"query", "v.probes", "p.txt", "-o", name});
        EXPECT_EQ(read(name), succeed({"query", "v.probes", "p.txt", "--to", format}).out) << name;
    }
    succeed({"query", "v.probes", "p.txt", "-o", "json", "--json"});
    EXPECT_EQ(read("json"), succeed({"query", "v.probes", "p.txt", "--json"}).out);
}

TEST_F(QueryOutput, IsCountedInTheReport) {
    const CommandResult result = succeed({"query", "v.probes", "-o", "a.csv"}, "1 1 1\n2 3 4\n");
    EXPECT_EQ(result.out.find("a.csv: 2 answers in "), 0u) << result.out;
    const CommandResult json = succeed({"query", "v.probes", "-o", "b.csv", "--json"}, "1 1 1\n");
    EXPECT_EQ(Json::parse(json.out)["answers"], 1);
}

TEST_F(QueryOutput, StaysAsItWasWhenTheInputIsMalformed) {
    write("bad.txt", "1 1 1\n2 2\n");
    write("bad.f32", std::string(100'000 * 12 + 5, '\0'));
    for (const char* input : {"bad.txt", "bad.f32", "none.txt"}) {
        EXPECT_TRUE(
            contains(fail_and_keep("a.csv", {"query", "v.probes", input, "-o", "a.csv"}), input));
    }
}

TEST_F(QueryOutput, DoesNotReplaceItsInputs) {
    write("p.txt", "1 1 1\n");
    EXPECT_TRUE(contains(fail({"query", "v.probes", "p.txt", "-o", "p.txt"}),
                         "p.txt: is an input of this command"));
}

TEST_F(QueryOutput, CannotBeHalfPreciseWithoutCompactProbes) {
    succeed({"tetrahedralize", "five.json", "-o", "unlit.probes"});
    const CommandResult result =
        run({"query", "unlit.probes", "--precision", "half", "--quiet"}, "1 1 1\n");
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_EQ(result.err,
              "tetralight: unlit.probes: holds no half-precision probes; use --precision full\n");
}

}  // namespace
}  // namespace tetralight::test
