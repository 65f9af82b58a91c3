// SPDX-License-Identifier: Apache-2.0
// What `query` knows of what is lit: rendering layers, a radius, normals.
#include <algorithm>
#include <glm/geometric.hpp>
#include <sstream>

#include <tetralight/base/str_cat.h>
#include <tetralight/probes/interpolate.h>
#include <tetralight/probes/probe_file.h>
#include "tests/cli/query_fixture.h"
#include "tests/support/property_volume.h"
#include "tests/support/random_walls.h"

namespace tetralight::test {
namespace {

/// Queries of w.probes, which has walls and probes on two layers.
class QueryReceiver : public CommandFixture {
  protected:
    QueryReceiver() : volume(make_random_volume(test::random_positions(60, 1, 4.0), 2)) {
        add_random_walls(volume, 3);
        for (uint32_t i = 0; i < volume.positions.size(); ++i) {
            volume.rendering_layers.push_back(i % 2 == 0 ? 0b0001 : 0b1000);
        }
        EXPECT_TRUE(write_probe_file(path("w.probes"), volume.view()));
        for (const glm::dvec3& p : test::random_positions(kCount, 4, 5.0)) {
            positions.emplace_back(p);
        }
        for (const glm::dvec3& p : test::random_positions(kCount, 5)) normals.emplace_back(p);
    }

    /// Answers in JSON.
    [[nodiscard]] std::vector<Json> ask(const Arguments& options, const std::string& input) const {
        Arguments arguments{"query", "w.probes", "--json"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        std::istringstream lines(succeed(arguments, input).out);
        std::vector<Json> result;
        for (std::string line; std::getline(lines, line);) result.push_back(Json::parse(line));
        return result;
    }

    [[nodiscard]] std::string text_of(bool has_normals) const {
        std::string lines;
        for (size_t i = 0; i < kCount; ++i) {
            const glm::vec3 &p = positions[i], &n = normals[i];
            lines += str_cat(p.x, " ", p.y, " ", p.z);
            if (has_normals) lines += str_cat(" ", n.x, " ", n.y, " ", n.z);
            lines += "\n";
        }
        return lines;
    }

    /// Holds that an answer is that of the library at a place, and so are its cell and weights.
    void expect_answer(const Json& answer, const glm::vec3& place, const Receiver& receiver) const {
        const CellLocation plain = locate(volume.view(), place);
        const CellLocation seen = visible_location(volume.view(), plain, receiver);
        const IrradianceSh light = interpolate(volume.view(), plain, receiver).irradiance;
        EXPECT_EQ(answer["cell"], plain.cell);
        float sum = 0.0f;
        for (const Json& probe : answer["probes"]) {
            const auto& vertices = volume.cells[plain.cell].vertices;
            const auto corner = std::ranges::find(vertices, probe["probe"].get<uint32_t>());
            ASSERT_NE(corner, vertices.end());
            EXPECT_NEAR(probe["weight"].get<float>(),
                        seen.weights[static_cast<int>(corner - vertices.begin())], 1e-5f);
            sum += probe["weight"].get<float>();
        }
        EXPECT_NEAR(sum, 1.0f, 1e-5f);
        for (size_t k = 0; k < 9; ++k) {
            for (int c = 0; c < 3; ++c) {
                EXPECT_NEAR(answer["irradiance_sh"][k][static_cast<size_t>(c)].get<float>(),
                            light.coefficients[k][c], 1e-4f);
            }
        }
    }

    static constexpr size_t kCount = 100;
    ProbeVolume volume;
    std::vector<glm::vec3> positions, normals;
};

TEST_F(QueryReceiver, AnswersAreThoseOfTheLibraryForEachOption) {
    const auto plain = ask({}, text_of(false));
    for (const auto& [options, receiver] :
         {std::pair<Arguments, Receiver>({"--rendering-layers", "0"}, {.rendering_layers = 0b0001}),
          {{"--rendering-layers", "3,7"}, {.rendering_layers = 0b10001000}},
          {{"--radius", "0.5"}, {.radius = 0.5f}},
          {{"--walls", "ignore", "--rendering-layers", "3", "--radius", "1"},
           {Walls::Ignore, 0b1000, 1.0f}}}) {
        const auto all = ask(options, text_of(false));
        ASSERT_EQ(all.size(), kCount);
        EXPECT_NE(all, plain) << options[0];
        for (size_t i = 0; i < kCount; ++i) expect_answer(all[i], positions[i], receiver);
    }
    EXPECT_EQ(ask({"--rendering-layers", "0,3"}, text_of(false)), plain);
    EXPECT_EQ(ask({"--radius", "0"}, text_of(false)), plain);
}

TEST_F(QueryReceiver, PositionsWithNormalsArePushedOffTheirSurfaces) {
    for (const auto& [options, offset] : {std::pair<Arguments, float>({"--normals"}, kNormalOffset),
                                          {{"--normals", "--normal-offset", "0.5"}, 0.5f},
                                          {{"--normals", "--normal-offset", "0"}, 0.0f}}) {
        const auto all = ask(options, text_of(true));
        ASSERT_EQ(all.size(), kCount);
        for (size_t i = 0; i < kCount; ++i) {
            const glm::vec3 place =
                push_off_surface(volume.view(), positions[i], glm::normalize(normals[i]),
                                 locate(volume.view(), positions[i]), offset);
            EXPECT_EQ(all[i]["position"][0].get<float>(), positions[i].x);
            expect_answer(all[i], place, {});
        }
    }
}

TEST_F(QueryReceiver, NormalsMeanTheSameInEveryFormat) {
    std::string csv = "x,y,z,nx,ny,nz,name\n", array, objects, jsonl, raw;
    for (size_t i = 0; i < kCount; ++i) {
        const glm::vec3 &p = positions[i], &n = normals[i];
        const std::string place = str_cat(p.x, ",", p.y, ",", p.z);
        const std::string normal = str_cat(n.x, ",", n.y, ",", n.z);
        csv += place + "," + normal + ",a\n";
        array += (i == 0 ? "[[" : ",[") + place + ", " + normal + "]";
        const std::string members = i % 2 == 0
                                        ? R"("position":[)" + place + R"(],"normal":[)" + normal
                                        : R"("normal":[)" + normal + R"(],"position":[)" + place;
        objects += (i == 0 ? "[{" : ",{") + members + R"(],"more":[1]})";
        jsonl += "[" + place + "," + normal + "]\n{" + members + "]}\n";
        for (const glm::vec3& v : {p, n}) raw.append(reinterpret_cast<const char*>(&v), sizeof v);
    }
    const auto answers = [&](const char* format, const std::string& input) {
        return succeed({"query", "w.probes", "--normals", "--from", format, "--to", "raw"}, input)
            .out;
    };
    const std::string expected = answers("raw", raw);
    ASSERT_EQ(expected.size(), kCount * 128);
    EXPECT_EQ(answers("text", text_of(true)), expected);
    EXPECT_EQ(answers("text", csv), expected);
    EXPECT_EQ(answers("json", array + "]"), expected);
    EXPECT_EQ(answers("json", objects + "]"), expected);
    const std::string twice = answers("jsonl", jsonl);
    for (size_t i = 0; i < 2 * kCount; ++i) {
        EXPECT_EQ(twice.substr(i * 128, 128), expected.substr(i / 2 * 128, 128)) << i;
    }
}

TEST_F(QueryReceiver, TheLengthOfANormalDoesNotMatter) {
    const auto unit = ask({"--normals"}, "1 1 1 0 1 0");
    for (const char* normal : {"0 1e-40 0", "0 3e38 0", "0 0.001 0"}) {
        EXPECT_EQ(ask({"--normals"}, str_cat("1 1 1 ", normal)), unit) << normal;
    }
}

TEST_F(QueryReceiver, ManyPositionsGetTheBitsThatTheyGetAlone) {
    std::string many, once;
    const Arguments query{"query", "w.probes", "--to", "raw",      "--rendering-layers",
                          "3",     "--radius", "0.25", "--normals"};
    for (int i = 0; i < 400; ++i) many += text_of(true);  // more than a chunk
    const std::string all = succeed(query, many).out;
    ASSERT_EQ(all.size(), 400 * kCount * 128);
    for (const size_t i : {size_t{0}, size_t{57}, size_t{99}}) {
        const glm::vec3 &p = positions[i], &n = normals[i];
        const std::string alone =
            succeed(query, str_cat(p.x, " ", p.y, " ", p.z, " ", n.x, " ", n.y, " ", n.z)).out;
        for (const size_t repetition : {size_t{0}, size_t{399}}) {
            EXPECT_EQ(all.substr((repetition * kCount + i) * 128, 128), alone) << i;
        }
    }
}

TEST_F(QueryReceiver, NamesTheLineOrPositionWhoseNormalIsNone) {
    const auto error_of = [&](const char* format, const std::string& input) {
        const std::string message =
            fail({"query", "w.probes", "--normals", "--from", format}, input);
        return message.substr(0, message.size() - 1);
    };
    constexpr const char* kZero = "the normal is zero or not finite (0 0 0)";
    EXPECT_EQ(error_of("text", "# a\n1 2 3 0 0 0\n"), str_cat("tetralight: stdin:2: ", kZero));
    EXPECT_EQ(error_of("text", "1 2 3 0 nan 0"),
              "tetralight: stdin:1: the normal is zero or not finite (0 nan 0)");
    EXPECT_EQ(error_of("jsonl", "[1,2,3,0,0,0]"), str_cat("tetralight: stdin:1: ", kZero));
    EXPECT_EQ(error_of("json", R"([{"position": [1,2,3], "normal": [0,0,0]}])"),
              str_cat("tetralight: stdin: position 0: ", kZero));
    EXPECT_EQ(error_of("raw", std::string(24, '\0')),
              str_cat("tetralight: stdin: record 0: ", kZero));
}

TEST_F(QueryReceiver, RefusesPositionsWithoutNormals) {
    for (const auto& [format, input, reason] :
         {std::tuple<const char*, std::string, std::string>(
              "text", "1 2 3", "stdin:1: \"1 2 3\" is not x y z nx ny nz"),
          {"text", "x,y,z\n1,2,3", "stdin:1: \"x,y,z\" is not x y z nx ny nz"},
          {"text", "1 2 3 0 1 1e39", "stdin:1: nz is 1e39, beyond what a float holds (3.4e38)"},
          {"jsonl", "[1, 2, 3]", "stdin:1: has 3 numbers, not six"},
          {"jsonl", "[1, 2, 3, 0, 1, 0, 0]", "stdin:1: has more than six numbers"},
          {"jsonl", "[1, 2, 3, 0, null, 0]", "stdin:1: ny is not a number (null)"},
          {"jsonl", R"({"position": [1, 2, 3]})", "stdin:1: has no \"normal\""},
          {"jsonl", R"({"normal": [1, 2, 3]})", "stdin:1: has no \"position\""},
          {"jsonl", R"({"position": [1, 2, 3], "normal": [0, 1]})",
           "stdin:1: normal has 2 numbers, not three"},
          {"jsonl", R"({"position": [1, 2, 3], "normal": 1})",
           "stdin:1: \"normal\" is not [nx, ny, nz] (1)"},
          {"jsonl", R"({"normal": [0, 1, 0], "position": [1, 2, 3], "normal": [0, 1, 0]})",
           "stdin:1: key \"normal\" is given twice"},
          {"jsonl", "7",
           "stdin:1: is neither [x, y, z, nx, ny, nz] nor {\"position\": [x, y, z], "
           "\"normal\": [nx, ny, nz]} (7)"},
          {"raw", std::string(12, '\1'),
           "stdin: ends at byte 12, 12 bytes into record 0; records are 24 bytes, x y z nx ny nz "
           "as float32"}}) {
        EXPECT_EQ(fail({"query", "w.probes", "--normals", "--from", format}, input),
                  "tetralight: " + reason + "\n");
    }
}

TEST_F(QueryReceiver, RefusesOptionsThatAreWrong) {
    for (const auto& [options, reason] :
         {std::pair<Arguments, const char*>({"--normal-offset", "0.2"},
                                            "--normal-offset: needs --normals"),
          {{"--rendering-layers", "32"}, "--rendering-layers: "},
          {{"--rendering-layers", "-1"}, "--rendering-layers: "},
          {{"--rendering-layers", "0.5"}, "--rendering-layers: "},
          {{"--radius", "-1"}, "--radius: "},
          {{"--normals", "--normal-offset", "-0.1"}, "--normal-offset: "}}) {
        Arguments arguments{"query", "w.probes"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        const std::string message = misuse(arguments);
        EXPECT_TRUE(contains(message, reason)) << message;
    }
}

}  // namespace
}  // namespace tetralight::test
