// SPDX-License-Identifier: Apache-2.0
// The functions of runtime/shaders/reflection.glsl on OpenGL against their twins in C++.
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <random>

#include <tetralight/reflection/sample_reflections.h>
#include <tetralight/reflection/split_sum.h>
#include <tetralight/runtime/shader_reflections.h>
#include "tests/reflection/reflection_fixture.h"
#include "tests/render/gl/shader_runner.h"

namespace tetralight {
namespace {

constexpr uint32_t kCount = 20'000;
constexpr size_t kInputsEach = 2;  // position, roughness; direction, n · v
constexpr uint32_t kParts = 5;

/// Far from the origin of the world.
constexpr glm::dvec3 kOrigin{1e5, -2e5, 3e5};

/// `SAMPLE` is the light of part 0.
constexpr const char* kShader = R"(
layout(std140) uniform Blend { TetralightReflectionBlend blend; };
uniform highp sampler2D table;
TetralightReflectionChoice choose(vec3 at) {
    TetralightReflectionChoice choice = tetralight_no_reflection();
    choice = tetralight_add_reflection(choice, 1.0,
                                       tetralight_reflection_influence(blend.second, at));
    choice = tetralight_add_reflection(choice, 0.0,
                                       tetralight_reflection_influence(blend.first, at));
    return tetralight_add_reflection(choice, 2.0,
                                     tetralight_reflection_influence(blend.third, at));
}
vec4 result(uint index, uint part) {
    vec4 at = input_at(2u * index);
    vec4 along = input_at(2u * index + 1u);
    if (part == 0u) return vec4(SAMPLE, 0.0);
    if (part == 1u) return vec4(tetralight_project_on_box(blend.first, at.xyz, along.xyz), 0.0);
    TetralightReflectionChoice choice = choose(at.xyz);
    if (part == 2u) return vec4(tetralight_reflection_weights(choice), 0.0);
    if (part == 3u) return choice.probes;
    return vec4(tetralight_split_sum(table, along.w, at.w),
                tetralight_reflection_occlusion(abs(at.xyz), abs(along.xyz), at.w), 0.0);
}
)";

class ReflectionTwins : public test::ShaderRunner {
  protected:
    Reflections reflections;
    std::vector<glm::vec2> table = make_split_sum_table(32, 64);
    std::vector<glm::vec4> inputs;
    ShaderReflectionBlend constants;
    ReflectionBlend blend{{0, 1, 2}, {0.5f, 0.25f, 0.25f}};
    GLuint textures[2]{};

    void SetUp() override {
        ShaderRunner::SetUp();
        std::mt19937 random(1);
        std::uniform_real_distribution<float> unit(0.0f, 1.0f);
        std::vector<ReflectionProbe> probes{test::box_probe(kOrigin, {3, 2, 4}, 1.0f),
                                            test::box_probe(kOrigin, {1, 2, 2}, 0.5f),
                                            ReflectionProbe{}};
        const glm::mat3 axes = test::random_axes(random);
        probes[0].axes = {axes[0], axes[1], axes[2]};
        probes[0].box_center = {0.5f, 0.25f, -0.5f};
        probes[2].position = kOrigin;
        // Smooth light, so that the GPU's coarse weights of texels do not matter.
        reflections = test::make_reflections(
            16, 3, probes, [](uint32_t probe, uint32_t level, const glm::vec3& d) {
                const float brightness = 1.0f + static_cast<float>(probe + 2 * level);
                return brightness * (0.5f + 0.5f * d);
            });
        constants = make_shader_reflection_blend(reflections.view(), blend, kOrigin);
        for (uint32_t i = 0; i < kCount; ++i) {
            const glm::vec3 place(unit(random), unit(random), unit(random));
            inputs.emplace_back(9.0f * (place - 0.5f), unit(random));
            inputs.emplace_back(test::random_unit_vector(random), unit(random));
        }
    }

    [[nodiscard]] test::ShaderTask task(const std::string& globals, const std::string& sample,
                                        GLenum target) {
        return {globals + "#define SAMPLE " + sample + "\n" + kShader, inputs, kCount, kParts,
                [this, target](const ShaderProgram& program) { bind(program, target); }};
    }

    /// All cubes as an array, or the first cube alone.
    void bind_cubes(GLenum target) {
        const bool is_array = target == GL_TEXTURE_CUBE_MAP_ARRAY;
        glCreateTextures(target, 1, &textures[0]);
        const auto faces = static_cast<GLsizei>(is_array ? 6 * reflections.probes.size() : 6);
        if (is_array) {
            glTextureStorage3D(textures[0], 3, GL_RGBA16F, 16, 16, faces);
        } else {
            glTextureStorage2D(textures[0], 3, GL_RGBA16F, 16, 16);
        }
        for (GLint level = 0; level < 3; ++level) {
            glTextureSubImage3D(textures[0], level, 0, 0, 0, 16 >> level, 16 >> level, faces,
                                GL_RGBA, GL_HALF_FLOAT,
                                reflections.levels[static_cast<size_t>(level)].data());
        }
        glTextureParameteri(textures[0], GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
        glEnable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
        glBindTextureUnit(3, textures[0]);
    }

    void bind(const ShaderProgram& program, GLenum target) {
        bind_cubes(target);
        glCreateTextures(GL_TEXTURE_2D, 1, &textures[1]);
        glTextureStorage2D(textures[1], 1, GL_RG32F, 32, 32);
        glTextureSubImage2D(textures[1], 0, 0, 0, 32, 32, GL_RG, GL_FLOAT, table.data());
        glTextureParameteri(textures[1], GL_TEXTURE_MIN_FILTER, GL_LINEAR);
        glTextureParameteri(textures[1], GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
        glTextureParameteri(textures[1], GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
        glBindTextureUnit(4, textures[1]);
        const auto set = [&](const char* name, GLint unit) {
            glProgramUniform1i(program.name(), glGetUniformLocation(program.name(), name), unit);
        };
        set("cubes", 3);
        set("table", 4);
        GLuint buffer = 0;
        glCreateBuffers(1, &buffer);
        glNamedBufferStorage(buffer, sizeof constants, &constants, 0);
        glUniformBlockBinding(program.name(), glGetUniformBlockIndex(program.name(), "Blend"), 1);
        glBindBufferBase(GL_UNIFORM_BUFFER, 1, buffer);
    }

    void TearDown() override {
        if (context) glDeleteTextures(2, textures);
        ShaderRunner::TearDown();
    }

    /// `light(position, direction, roughness)` is the twin of part 0.
    template <class Light>
    void expect_twin(const std::vector<glm::vec4>& results, Light light) const {
        ASSERT_EQ(results.size(), size_t{kCount} * kParts);
        for (size_t i = 0; i < kCount && !HasFailure(); ++i) {
            const glm::vec4 at = inputs[kInputsEach * i], along = inputs[kInputsEach * i + 1];
            const glm::vec4* found = &results[i * kParts];
            const glm::dvec3 position = kOrigin + glm::dvec3(glm::vec3(at));
            const glm::vec3 direction(along);
            EXPECT_LT(glm::distance(glm::vec3(found[0]), light(position, direction, at.w)), 0.03f);
            const glm::vec3 projected = project_on_box(reflections.probes[0], position, direction);
            EXPECT_LT(glm::distance(glm::vec3(found[1]), projected), 1e-4f) << i;
            expect_same_choice(found[2], found[3], position);
            EXPECT_LT(glm::distance(glm::vec2(found[4]), sample_split_sum(table, along.w, at.w)),
                      3e-3f);
            EXPECT_NEAR(
                found[4].z,
                reflection_occlusion(glm::abs(glm::vec3(at)), glm::abs(glm::vec3(along)), at.w),
                1e-5f);
        }
    }

    void expect_same_choice(const glm::vec4& weights, const glm::vec4& probes,
                            const glm::dvec3& position) const {
        const ReflectionBlend expected = blend_reflections(reflections.view(), position);
        glm::vec3 of_shader(0.0f), of_twin(0.0f);
        for (int i = 0; i < 3; ++i) {
            of_shader[static_cast<int>(probes[i])] += weights[i];
            of_twin[static_cast<int>(expected.probes[i])] += expected.weights[i];
        }
        EXPECT_LT(glm::distance(of_shader, of_twin), 1e-4f);
    }
};

TEST_F(ReflectionTwins, AgreeInGlsl450) {
    const auto results =
        run_compute(task("uniform samplerCubeArray cubes;\n",
                         "tetralight_sample_reflections(cubes, blend, at.xyz, along.xyz, at.w)",
                         GL_TEXTURE_CUBE_MAP_ARRAY),
                    ShaderPart::Reflection);
    expect_twin(results, [&](const glm::dvec3& position, const glm::vec3& direction, float rough) {
        return sample_reflections(reflections.view(), blend, position, direction, rough);
    });
}

TEST_F(ReflectionTwins, AgreeInGlslEs300OnOneCube) {
    const auto results = run_fragment(
        task("uniform highp samplerCube cubes;\n",
             "tetralight_sample_reflection_cube(cubes, blend.first, at.xyz, along.xyz, "
             "tetralight_reflection_level(at.w, 2.0))",
             GL_TEXTURE_CUBE_MAP),
        ShaderPart::Reflection);
    expect_twin(results, [&](const glm::dvec3& position, const glm::vec3& direction, float rough) {
        const ReflectionBlend first{{0}, {1.0f}};
        return sample_reflections(reflections.view(), first, position, direction, rough);
    });
}

}  // namespace
}  // namespace tetralight
