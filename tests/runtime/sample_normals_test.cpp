// SPDX-License-Identifier: Apache-2.0
#include <tetralight/runtime/sample_normals.h>

#include <gtest/gtest.h>

#include <glm/geometric.hpp>
#include <random>
#include <vector>

namespace tetralight {
namespace {

class SampleNormals : public testing::TestWithParam<size_t> {};

TEST_P(SampleNormals, GivesWhatSampleSh9Gives) {
    const size_t count = GetParam();
    std::mt19937_64 engine(1);
    std::normal_distribution<float> value;
    PackedSh sh;
    for (glm::vec4* v :
         {&sh.sha_r, &sh.sha_g, &sh.sha_b, &sh.shb_r, &sh.shb_g, &sh.shb_b, &sh.shc}) {
        *v = {value(engine), value(engine), value(engine), value(engine)};
    }
    std::vector<float> x(count), y(count), z(count);
    for (size_t i = 0; i < count; ++i) {
        const glm::vec3 n = glm::normalize(glm::vec3(value(engine), value(engine), value(engine)));
        x[i] = n.x;
        y[i] = n.y;
        z[i] = n.z;
    }
    // One more than asked for, to see that it stays.
    std::vector<float> red(count + 1, 7.0f), green(count + 1, 7.0f), blue(count + 1, 7.0f);
    sample_sh9(sh, {x, y, z}, {red, green, blue});
    for (size_t i = 0; i < count; ++i) {
        const glm::vec3 expected = sample_sh9(sh, glm::vec3(x[i], y[i], z[i]));
        EXPECT_LE(glm::distance(glm::vec3(red[i], green[i], blue[i]), expected), 5e-6f);
    }
    EXPECT_EQ(glm::vec3(red[count], green[count], blue[count]), glm::vec3(7.0f));
}

INSTANTIATE_TEST_SUITE_P(Counts, SampleNormals, testing::Values(0, 1, 15, 16, 17, 1023, 100000));

}  // namespace
}  // namespace tetralight
