// SPDX-License-Identifier: Apache-2.0
// Normal maps and light on mapped normals in GLSL against their twins in C++.
#include <algorithm>
#include <glm/geometric.hpp>
#include <random>

#include <tetralight/bake/scene/mapped_normal.h>
#include <tetralight/lightmap/directional_light.h>
#include "tests/render/gl/shader_runner.h"

namespace tetralight {
namespace {

constexpr uint32_t kCount = 20'000;
constexpr size_t kInputsEach = 3;

struct Arguments {
    glm::vec4 light;  ///< v, flux
    glm::vec4 base_normal, normal;
};

static_assert(sizeof(Arguments) == 16 * kInputsEach);

glm::vec3 random_direction(std::mt19937& engine) {
    std::normal_distribution<float> value;
    return glm::normalize(glm::vec3(value(engine), value(engine), value(engine)));
}

std::vector<Arguments> make_arguments() {
    std::mt19937 engine(1);
    std::uniform_real_distribution<float> unit(0.0f, 1.0f);
    std::vector<Arguments> all(kCount);
    for (Arguments& a : all) {
        const float flux = 10.0f * unit(engine);
        // A tenth has a vector that is too long.
        a.light = {1.1f * unit(engine) * flux * random_direction(engine), flux};
        a.base_normal = glm::vec4(random_direction(engine), 0.0f);
        a.normal = glm::vec4(random_direction(engine), 0.0f);
    }
    all[0].light = glm::vec4(0.0f);
    return all;
}

class DirectionalTwins : public test::ShaderRunner {
  protected:
    std::vector<Arguments> arguments = make_arguments();
    test::ShaderTask task{
        R"(
vec4 result(uint index, uint part) {
    uint at = 3u * index;
    vec4 light = input_at(at);
    vec3 base = input_at(at + 1u).xyz;
    vec3 normal = input_at(at + 2u).xyz;
    return vec4(tetralight_directional_irradiance(light, base, normal),
                tetralight_mono_ratio(light.xyz / 11.0, base, normal), 0.0, 0.0);
}
)",
        {reinterpret_cast<const glm::vec4*>(arguments.data()), arguments.size() * kInputsEach},
        kCount};

    void expect_twin(const std::vector<glm::vec4>& results) const {
        ASSERT_EQ(results.size(), size_t{kCount});
        for (size_t i = 0; i < kCount && !HasFailure(); ++i) {
            const Arguments& a = arguments[i];
            const glm::vec3 vector(a.light), base(a.base_normal), normal(a.normal);
            EXPECT_NEAR(results[i].x, directional_irradiance(a.light.w, vector, base, normal),
                        1e-3f);
            const float ratio = mono_ratio(vector / 11.0f, base, normal);
            EXPECT_NEAR(results[i].y, ratio, 1e-3f * std::max(1.0f, ratio));
        }
    }
};

TEST_F(DirectionalTwins, AgreeInGlsl450) {
    expect_twin(run_compute(task, ShaderPart::Lightmap));
}

TEST_F(DirectionalTwins, AgreeInGlslEs300) {
    expect_twin(run_fragment(task, ShaderPart::Lightmap));
}

/// A triangle with a normal map of one texel, and what the shader gets of it.
struct MappedTriangle {
    Scene scene;
    glm::vec4 tangent, texel;
    glm::vec3 normal;

    explicit MappedTriangle(std::mt19937& engine) {
        const auto code = [&] { return static_cast<uint8_t>(engine()); };
        const std::array<uint8_t, 4> codes{code(), code(), code(), 255};
        scene.normal_maps.push_back({"map", Image8{1, 1, {codes}}});
        scene.materials.resize(1);
        scene.materials[0].normal_texture.texture = 0;
        scene.materials[0].normal_scale = static_cast<float>(engine() % 5) - 1.0f;
        tangent = glm::vec4(random_direction(engine), engine() % 2 == 0 ? 1.0f : -1.0f);
        Mesh& mesh = scene.meshes.emplace_back();
        mesh.positions.resize(3);
        mesh.uvs[0].resize(3);
        mesh.tangents.assign(3, tangent);
        mesh.indices = {0, 1, 2};
        mesh.material = 0;
        texel = glm::vec4(codes[0], codes[1], 0, 0) / 255.0f;
        texel.z = scene.materials[0].normal_scale;
        normal = random_direction(engine);
    }

    [[nodiscard]] glm::vec3 twin() const {
        return mapped_normal(scene, mesh_point(scene.meshes[0], 0, glm::vec2(0.0f)),
                             glm::mat3(1.0f), normal);
    }
};

TEST_F(DirectionalTwins, AgreeOnMappedNormals) {
    std::mt19937 engine(2);
    std::vector<MappedTriangle> triangles;
    std::vector<glm::vec4> inputs;
    for (int i = 0; i < 500; ++i) {
        const MappedTriangle& triangle = triangles.emplace_back(engine);
        inputs.insert(inputs.end(),
                      {glm::vec4(triangle.normal, 0.0f), triangle.tangent, triangle.texel});
    }
    const test::ShaderTask mapping{R"(
vec4 result(uint index, uint part) {
    vec4 texel = input_at(3u * index + 2u);
    return vec4(tetralight_mapped_normal(input_at(3u * index).xyz, input_at(3u * index + 1u),
                                         texel.xy, texel.z), 0.0);
}
)",
                                   inputs, 500};
    const auto results = run_compute(mapping, ShaderPart::Sh);
    ASSERT_EQ(results.size(), triangles.size());
    for (size_t i = 0; i < triangles.size(); ++i)
        EXPECT_LT(glm::distance(glm::vec3(results[i]), triangles[i].twin()), 1e-3f) << i;
}

}  // namespace
}  // namespace tetralight
