// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/answer_json.h>

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <random>
#include <string>

namespace tetralight {
namespace {

std::string json(const ProbeVolumeView& volume, const AnsweredPosition& answer) {
    std::string text(kAnswerJsonSize, '\0');
    char* const end = write_json(text.data(), volume, answer);
    text.resize(static_cast<size_t>(end - text.data()));
    return text;
}

IrradianceSh all(float value) {
    IrradianceSh sh;
    sh.coefficients.fill(glm::vec3(value));
    return sh;
}

TEST(AnswerJson, HasTheShortestFloats) {
    ProbeVolume volume;
    volume.cells = {Cell{{3, 1, 4, 15}}};
    IrradianceSh sh = all(0.0f);
    sh.coefficients[0] = {0.1f, 1e-7f, -0.0f};
    const CellLocation location{0, 0.0f, {0.7f, 0.1f, 0.1f, 0.1f}};
    EXPECT_EQ(json(volume.view(), {{0.1f, -2.5f, 3e20f}, location, sh, {1.0f, 0.5f, 0.0f, 0.3f}}),
              R"({"position":[0.1,-2.5,3e+20],"cell":0,"probes":[{"probe":3,"weight":0.7},)"
              R"({"probe":1,"weight":0.1},{"probe":4,"weight":0.1},{"probe":15,"weight":0.1}],)"
              R"("ambient":0,"irradiance_sh":[[0.1,1e-07,-0.0],[0,0,0],[0,0,0],[0,0,0],[0,0,0],)"
              R"([0,0,0],[0,0,0],[0,0,0],[0,0,0]],"occlusion":[1,0.5,0,0.3]})");
}

TEST(AnswerJson, HasNoProbeWhereACellHasNone) {
    ProbeVolume volume;
    volume.cells = {Cell{{3, 1, 4, kNoIndex}}};
    const CellLocation location{0, 0.5f, {0.25f, 0.25f, 0.0f, 0.0f}};
    const std::string text = json(volume.view(), {glm::vec3(0), location, {}, glm::vec4(1)});
    EXPECT_NE(text.find(R"([{"probe":3,"weight":0.25},{"probe":1,"weight":0.25},)"
                        R"({"probe":4,"weight":0}],"ambient":0.5,)"),
              std::string::npos)
        << text;
}

TEST(AnswerJson, HasNoCellWhereThereIsNone) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (const uint32_t cell : {kNoIndex, 0u}) {
        CellLocation location;
        location.cell = cell;
        const std::string text = json({}, {{nan, 0, 0}, location, {}, glm::vec4(1)});
        EXPECT_EQ(text.find(R"({"position":[null,0,0],"cell":null,"probes":[],"ambient":1,)"), 0u)
            << text;
    }
}

/// JSON libraries read doubles, and round once more to floats.
TEST(AnswerJson, ReadsBackToTheSameBitsByWayOfDouble) {
    std::mt19937 engine(1);
    for (int i = 0; i < 200'000; ++i) {
        const auto number = std::bit_cast<float>(static_cast<uint32_t>(engine()));
        if (!std::isfinite(number)) continue;
        const std::string text = json({}, {glm::vec3(number), {}, {}, glm::vec4(1)});
        const double read = std::strtod(text.c_str() + std::strlen("{\"position\":["), nullptr);
        ASSERT_EQ(std::bit_cast<uint32_t>(static_cast<float>(read)),
                  std::bit_cast<uint32_t>(number))
            << text;
    }
}

TEST(AnswerJson, FitsInItsRoom) {
    constexpr float kLongest = -1.17549449e-38f;  // fifteen characters
    ProbeVolume volume;
    volume.cells.resize(1, Cell{{4294967290u, 4294967290u, 4294967290u, 4294967290u}});
    const CellLocation location{0, kLongest, glm::vec4(kLongest)};
    const IrradianceSh sh = all(kLongest);
    const auto size =
        json(volume.view(), {glm::vec3(kLongest), location, sh, glm::vec4(kLongest)}).size();
    EXPECT_LE(size + 10, kAnswerJsonSize - 32);  // a cell of ten digits, and room for one number
}

}  // namespace
}  // namespace tetralight
