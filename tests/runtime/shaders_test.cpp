// SPDX-License-Identifier: Apache-2.0
// The shader functions compile, by the reference compiler, in every version of GLSL that they are
// for. That they compute what their C++ twins do needs a GPU.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

#include "tests/support/temp_folder.h"

namespace tetralight {
namespace {

constexpr const char* kMain = R"(
uniform sampler3D volume;
uniform sampler3D atlas;
layout(std140) uniform Volumes {
    LppvConstants constants;
    LppvAtlasConstants atlas_constants;
};
in vec3 position;
in vec3 normal;
out vec4 color;

void main() {
    vec3 light = evaluate_sh9(lppv_four_slabs(volume, constants, position), normal) +
                 evaluate_sh9(lppv_seven_slabs(volume, constants, position), normal) +
                 evaluate_sh9(lppv_atlas_four_slabs(atlas, atlas_constants, position), normal) +
                 evaluate_sh9(lppv_atlas_seven_slabs(atlas, atlas_constants, position), normal);
    color = lppv_occlusion(volume, constants, position) *
            lppv_atlas_occlusion(atlas, atlas_constants, position) * vec4(light, 1.0);
}
)";

std::string functions() {
    std::ifstream stream(TETRALIGHT_SOURCE_DIR "/runtime/shaders/lppv.glsl");
    return (std::ostringstream() << stream.rdbuf()).str();
}

/// What glslang says; empty: nothing is wrong.
std::string compile(const std::string& head, const std::string& source) {
    const TempFolder folder;
    const std::string shader = folder.write("shader.frag", head + source);
    const std::string output = folder.path("output");
    const std::string command =
        std::string(TETRALIGHT_GLSLANG) + " " + shader + " > " + output + " 2>&1";
    if (std::system(command.c_str()) == 0) return "";
    std::ifstream stream(output);
    return (std::ostringstream() << stream.rdbuf()).str();
}

class LppvShader : public testing::TestWithParam<const char*> {};

INSTANTIATE_TEST_SUITE_P(Versions, LppvShader,
                         testing::Values("#version 330\n", "#version 450\n",
                                         "#version 300 es\nprecision highp float;\n"
                                         "precision highp sampler3D;\n"));

TEST_P(LppvShader, Compiles) {
    EXPECT_EQ(compile(GetParam(), functions() + kMain), "");
}

TEST(LppvShaderTest, MistakesAreSeen) {
    EXPECT_NE(compile("#version 330\n", functions() + "vec3 x = 1;" + kMain), "");
}

}  // namespace
}  // namespace tetralight
