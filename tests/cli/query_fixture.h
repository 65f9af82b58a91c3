// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstring>
#include <glm/vec3.hpp>
#include <random>
#include <span>
#include <sstream>
#include <string>
#include <vector>

#include "tests/cli/command_fixture.h"

namespace tetralight::test {

/// Queries of v.probes, five baked probes.
class QueryFixture : public CommandFixture {
  protected:
    QueryFixture() {
        write("five.json", kFiveProbes);
        succeed({"bake", kCourtyard, "-g", "five.json", "--only-given-groups", "--invalid-probes",
                 "keep", "-o", "v.probes", "-s", "16"});
    }

    [[nodiscard]] std::vector<Json> answers(const std::string& positions,
                                            const Arguments& options = {}) const {
        Arguments arguments{"query", "v.probes", "--json"};
        arguments.insert(arguments.end(), options.begin(), options.end());
        std::istringstream lines(succeed(arguments, positions).out);
        std::vector<Json> result;
        for (std::string line; std::getline(lines, line);) result.push_back(Json::parse(line));
        return result;
    }

    /// Inside the probes and around them.
    [[nodiscard]] static std::vector<glm::vec3> random_positions(size_t count) {
        std::mt19937 engine(1);
        std::uniform_real_distribution<float> coordinate(-4.0f, 8.0f);
        std::vector<glm::vec3> positions(count);
        for (glm::vec3& p : positions) {
            p = {coordinate(engine), coordinate(engine), coordinate(engine)};
        }
        return positions;
    }

    /// The values as raw files hold them.
    template <class Value>
    [[nodiscard]] static std::string raw(std::span<const Value> values) {
        return {reinterpret_cast<const char*>(values.data()), values.size_bytes()};
    }

    [[nodiscard]] static std::string raw(const std::vector<glm::vec3>& positions) {
        return raw(std::span<const glm::vec3>(positions));
    }
};

/// An answer as docs/query.md lays raw ones out.
struct RawRecord {
    float irradiance[27];
    float occlusion[4];
    uint32_t cell;
};

[[nodiscard]] inline std::vector<RawRecord> raw_records(const std::string& bytes) {
    EXPECT_EQ(bytes.size() % 128, 0u);
    std::vector<RawRecord> records(bytes.size() / 128);
    std::memcpy(records.data(), bytes.data(), records.size() * 128);
    return records;
}

}  // namespace tetralight::test
