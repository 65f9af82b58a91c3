// SPDX-License-Identifier: Apache-2.0
// The functions of runtime/shaders/sh.glsl on OpenGL against their twins in C++.
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <random>

#include <tetralight/runtime/probe_shading.h>
#include "tests/render/gl/shader_runner.h"

namespace tetralight {
namespace {

constexpr uint32_t kCount = 100'000;
constexpr size_t kInputsEach = 17;
constexpr uint32_t kParts = 8;

/// One set of arguments as the shader gets it: 17 float4.
struct Arguments {
    PackedSh sh, layer;
    glm::vec4 x_axis, y_axis, z_axis;  ///< w: shadow, occlusion fade, channel
};

static_assert(sizeof(Arguments) == 16 * kInputsEach);

glm::vec4 random_vector(std::mt19937_64& engine, float low, float high) {
    std::uniform_real_distribution<float> value(low, high);
    return {value(engine), value(engine), value(engine), value(engine)};
}

PackedSh random_packed(std::mt19937_64& engine) {
    PackedSh sh;
    for (glm::vec4* v :
         {&sh.sha_r, &sh.sha_g, &sh.sha_b, &sh.shb_r, &sh.shb_g, &sh.shb_b, &sh.shc}) {
        *v = random_vector(engine, -1.0f, 2.0f);
    }
    return sh;
}

std::vector<Arguments> make_arguments() {
    std::mt19937_64 engine(1);
    std::vector<Arguments> all(kCount);
    for (Arguments& a : all) {
        a.sh = random_packed(engine);
        a.layer = random_packed(engine);
        a.x_axis = random_vector(engine, -2.0f, 2.0f);
        a.y_axis = random_vector(engine, -2.0f, 2.0f);
        a.z_axis = random_vector(engine, -2.0f, 2.0f);
        a.x_axis.w = 0.5f + 0.25f * a.x_axis.w;
        a.y_axis.w = 0.5f + 0.25f * a.y_axis.w;
        a.z_axis.w = static_cast<float>(engine() % 6) - 1.0f;
    }
    return all;
}

constexpr const char* kShader = R"(
TetralightPackedSh sh_at(uint i) {
    return TetralightPackedSh(input_at(i), input_at(i + 1u), input_at(i + 2u), input_at(i + 3u),
                    input_at(i + 4u), input_at(i + 5u), input_at(i + 6u));
}
vec4 result(uint index, uint part) {
    uint at = 17u * index;
    TetralightPackedSh sh = sh_at(at);
    TetralightPackedSh layer = sh_at(at + 7u);
    vec4 x = input_at(at + 14u);
    vec4 y = input_at(at + 15u);
    vec4 z = input_at(at + 16u);
    vec3 normal = tetralight_instance_normal(x.xyz, y.xyz, z.xyz, layer.shc.xyz);
    if (part == 0u) return vec4(normal, 0.0);
    if (part == 1u) return vec4(tetralight_sample_sh9(sh, normal), 0.0);
    if (part == 2u) return vec4(tetralight_sample_sh4(tetralight_first_bands(sh), normal), 0.0);
    TetralightPackedSh sum = tetralight_add_layer(sh, layer, x.xyz);
    if (part == 3u) return vec4(tetralight_sample_sh9(sum, normal), 0.0);
    vec3 dominant = tetralight_dominant_direction(sh);
    if (part == 5u) return vec4(dominant, 0.0);
    if (part == 6u) return vec4(tetralight_dominant_irradiance(sh, dominant), 0.0);
    if (part == 7u) {
        vec3 to_eye = normalize(y.xyz);
        return vec4(tetralight_specular_reflection(normal, dominant, to_eye, x.www, 0.1 + 0.9 * y.w),
                    0.0);
    }
    float occlusion = tetralight_probe_occlusion(sh.sha_r, int(z.w));
    return vec4(occlusion, tetralight_mix_occlusion(x.w, occlusion, y.w), 0.0, 0.0);
}
)";

std::array<glm::vec4, kParts> twin(const Arguments& a) {
    const glm::vec3 normal = instance_normal(a.x_axis, a.y_axis, a.z_axis, glm::vec3(a.layer.shc));
    const float occlusion = probe_occlusion(a.sh.sha_r, static_cast<int>(a.z_axis.w));
    const glm::vec3 dominant = dominant_direction(a.sh);
    return {glm::vec4(normal, 0.0f),
            glm::vec4(sample_sh9(a.sh, normal), 0.0f),
            glm::vec4(sample_sh4(first_bands(a.sh), normal), 0.0f),
            glm::vec4(sample_sh9(add_layer(a.sh, a.layer, glm::vec3(a.x_axis)), normal), 0.0f),
            glm::vec4(occlusion, mix_occlusion(a.x_axis.w, occlusion, a.y_axis.w), 0.0f, 0.0f),
            glm::vec4(dominant, 0.0f),
            glm::vec4(dominant_irradiance(a.sh, dominant), 0.0f),
            glm::vec4(specular_reflection(normal, dominant, glm::normalize(glm::vec3(a.y_axis)),
                                          glm::vec3(a.x_axis.w), 0.1f + 0.9f * a.y_axis.w),
                      0.0f)};
}

/// A normal is as sure as its instance's volume is not flat.
bool is_well_formed(const Arguments& a) {
    const glm::vec3 x(a.x_axis), y(a.y_axis), z(a.z_axis);
    return std::abs(glm::dot(glm::normalize(x), glm::cross(glm::normalize(y), glm::normalize(z)))) >
           0.05f;
}

class ShadingTwins : public test::ShaderRunner {
  protected:
    std::vector<Arguments> arguments = make_arguments();
    test::ShaderTask task{
        kShader,
        {reinterpret_cast<const glm::vec4*>(arguments.data()), arguments.size() * kInputsEach},
        kCount,
        kParts};

    void expect_twin(const std::vector<glm::vec4>& results) const {
        ASSERT_EQ(results.size(), size_t{kCount} * kParts);
        size_t tested = 0;
        for (size_t i = 0; i < kCount && !HasFailure(); ++i) {
            if (!is_well_formed(arguments[i])) continue;
            ++tested;
            const auto expected = twin(arguments[i]);
            for (size_t part = 0; part < kParts; ++part) {
                EXPECT_LE(glm::distance(results[kParts * i + part], expected[part]),
                          2e-4f * std::max(1.0f, glm::length(expected[part])))
                    << "part " << part << " of " << i;
            }
        }
        EXPECT_TRUE(HasFailure() || tested > kCount / 2);
    }
};

TEST_F(ShadingTwins, AgreeInGlsl450) {
    expect_twin(run_compute(task, ShaderPart::Sh));
}

TEST_F(ShadingTwins, AgreeInGlslEs300) {
    expect_twin(run_fragment(task, ShaderPart::Sh));
}

}  // namespace
}  // namespace tetralight
