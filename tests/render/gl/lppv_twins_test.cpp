// SPDX-License-Identifier: Apache-2.0
// The functions of runtime/shaders/lppv.glsl on OpenGL against their twins in C++.
#include <glm/geometric.hpp>
#include <random>

#include <tetralight/base/error_text.h>
#include <tetralight/lppv/lppv_atlas.h>
#include <tetralight/lppv/lppv_texture.h>
#include "tests/lppv/lppv_fixture.h"
#include "tests/render/gl/shader_runner.h"

namespace tetralight {
namespace {

constexpr uint32_t kCount = 20'000;
constexpr uint32_t kParts = 8;

/// Part 0..6: the seven float4 of the light; 7: occlusion. `SAMPLE` and `OCCLUSION` are the
/// layout's.
constexpr const char* kShader = R"(
layout(std140) uniform Lppv { TetralightLppvConstants constants; };
uniform highp sampler3D slabs;
vec4 result(uint index, uint part) {
    vec3 at = input_at(index).xyz;
    if (part == 7u) return tetralight_sample_lppv_occlusion(slabs, constants, at);
    TetralightPackedSh sh = SAMPLE(slabs, constants, at);
    if (part == 0u) return sh.sha_r;
    if (part == 1u) return sh.sha_g;
    if (part == 2u) return sh.sha_b;
    if (part == 3u) return sh.shb_r;
    if (part == 4u) return sh.shb_g;
    if (part == 5u) return sh.shb_b;
    return sh.shc;
}
)";

struct LppvCase {
    const char* name;
    LppvLayout layout;
    LppvTexelFormat format;
    LppvQuality quality;
};

std::string shader_of(const LppvCase& which) {
    const bool is_four = which.layout == LppvLayout::FourSlabs;
    return std::string("#define SAMPLE tetralight_sample_lppv_") + (is_four ? "4" : "7") + kShader;
}

class LppvTwins : public test::ShaderRunner, public testing::WithParamInterface<LppvCase> {
  protected:
    Lppv lppv;
    LppvTexture texture;
    LppvConstants constants;
    std::vector<glm::vec4> inputs;

    void SetUp() override {
        ShaderRunner::SetUp();
        ProbeVolume volume = test::make_cube_volume();
        std::mt19937_64 engine(3);
        std::uniform_real_distribution<float> share(0.0f, 1.0f);
        for (size_t i = 0; i < volume.positions.size(); ++i) {
            volume.occlusion.emplace_back(share(engine), share(engine), share(engine), 1.0f);
        }
        // Turned, scaled and mirrored.
        const LppvGrid grid = test::grid_in_box({6, 3, 4}, {-4.0, 2.0, 3.0}, 40.0);
        auto made = make_lppv(volume.view(), grid, {GetParam().quality, {}, 0.5f, {}});
        ASSERT_TRUE(made);
        lppv = std::move(*made);
        texture = make_lppv_texture(lppv, GetParam().layout, GetParam().format);
        constants = make_lppv_constants(lppv, GetParam().layout);
        for (uint32_t i = 0; i < kCount; ++i) {
            const float x = share(engine), y = share(engine), z = share(engine);
            inputs.emplace_back(8.0f * glm::vec3(x, y, z) - 4.0f, 0.0f);
        }
    }

    /// Uploads texture and constants, and gives them to the program.
    void bind(const ShaderProgram& program) {
        const bool is_half = GetParam().format == LppvTexelFormat::Half;
        const glm::ivec3 size(texture.size);
        glCreateTextures(GL_TEXTURE_3D, 1, &slabs_);
        glTextureStorage3D(slabs_, 1, is_half ? GL_RGBA16F : GL_RGBA32F, size.x, size.y, size.z);
        glTextureSubImage3D(slabs_, 0, 0, 0, 0, size.x, size.y, size.z, GL_RGBA,
                            is_half ? GL_HALF_FLOAT : GL_FLOAT, texture.texels.data());
        glTextureParameteri(slabs_, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
        for (const GLenum axis : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R}) {
            glTextureParameteri(slabs_, axis, GL_CLAMP_TO_EDGE);
        }
        glBindTextureUnit(3, slabs_);
        glProgramUniform1i(program.name(), glGetUniformLocation(program.name(), "slabs"), 3);
        glCreateBuffers(1, &buffer_);
        glNamedBufferStorage(buffer_, sizeof constants, &constants, 0);
        glUniformBlockBinding(program.name(), glGetUniformBlockIndex(program.name(), "Lppv"), 1);
        glBindBufferBase(GL_UNIFORM_BUFFER, 1, buffer_);
    }

    void TearDown() override {
        if (!context) return;
        glDeleteTextures(1, &slabs_);
        glDeleteBuffers(1, &buffer_);
    }

    [[nodiscard]] test::ShaderTask task() {
        return {shader_of(GetParam()), inputs, kCount, kParts,
                [this](const ShaderProgram& program) { bind(program); }};
    }

    /// Filtering weighs by 8 bits on some hardware: 1/256 of what neighboring texels differ by.
    void expect_twin(const std::vector<glm::vec4>& results) const {
        ASSERT_EQ(results.size(), size_t{kCount} * kParts);
        for (size_t i = 0; i < kCount && !HasFailure(); ++i) {
            const glm::vec3 at(inputs[i]);
            const PackedSh sh = sample_lppv_texture(texture, constants, at);
            const glm::vec4 expected[] = {sh.sha_r, sh.sha_g, sh.sha_b, sh.shb_r,
                                          sh.shb_g, sh.shb_b, sh.shc};
            for (size_t part = 0; part < 7; ++part) {
                EXPECT_LE(glm::distance(results[kParts * i + part], expected[part]), 2e-2f)
                    << "part " << part << " of " << i;
            }
            if (GetParam().layout == LppvLayout::SevenSlabs) continue;
            EXPECT_LE(glm::distance(results[kParts * i + 7],
                                    sample_lppv_occlusion(texture, constants, at)),
                      1e-2f);
        }
    }

  private:
    GLuint slabs_ = 0;
    GLuint buffer_ = 0;
};

TEST_P(LppvTwins, AgreeInGlsl450) {
    expect_twin(run_compute(task(), ShaderPart::Lppv));
}

TEST_P(LppvTwins, AgreeInGlslEs300) {
    expect_twin(run_fragment(task(), ShaderPart::Lppv));
}

INSTANTIATE_TEST_SUITE_P(
    Layouts, LppvTwins,
    testing::Values(
        LppvCase{"FourHalf", LppvLayout::FourSlabs, LppvTexelFormat::Half, LppvQuality::Normal},
        LppvCase{"FourFloat", LppvLayout::FourSlabs, LppvTexelFormat::Float, LppvQuality::Low},
        LppvCase{"SevenHalf", LppvLayout::SevenSlabs, LppvTexelFormat::Half, LppvQuality::Full},
        LppvCase{"SevenFloat", LppvLayout::SevenSlabs, LppvTexelFormat::Float, LppvQuality::Full}),
    [](const auto& layout) { return std::string(layout.param.name); });

/// The offset that the driver gives a member of a uniform block.
GLint offset_of(const ShaderProgram& program, const std::string& name) {
    const GLuint index = glGetProgramResourceIndex(program.name(), GL_UNIFORM, name.c_str());
    const GLenum property = GL_OFFSET;
    GLint offset = -1;
    if (index == GL_INVALID_INDEX) return offset;
    glGetProgramResourceiv(program.name(), GL_UNIFORM, index, 1, &property, 1, nullptr, &offset);
    return offset;
}

class LppvLayoutInMemory : public test::ShaderRunner {};

TEST_F(LppvLayoutInMemory, IsWhatTheDriverSays) {
    const auto source = compose_shader(
        ShaderLanguage::Glsl450, {ShaderPart::Lppv},
        {"layout.comp",
         "layout(local_size_x = 1) in;\nuniform sampler3D slabs;\n"
         "layout(std140, binding = 1) uniform A { TetralightLppvConstants constants; } a;\n"
         "layout(std140, binding = 2) uniform B { TetralightLppvAtlasConstants constants; } b;\n"
         "layout(std430, binding = 8) buffer Result { vec4 result; };\n"
         "void main() { result = tetralight_sample_lppv_4(slabs, a.constants, vec3(0.0)).sha_r"
         " + tetralight_sample_lppv_atlas_4(slabs, b.constants, vec3(0.0)).shc; }\n"});
    const ShaderStage stage{GL_COMPUTE_SHADER, source};
    const auto program = ShaderProgram::create(std::span(&stage, 1));
    ASSERT_TRUE(program) << error_text(program.error());
    const auto in_a = [&](const char* name) {
        return offset_of(*program, std::string("A.constants.") + name);
    };
    EXPECT_EQ(in_a("local_from_world"), GLint{offsetof(LppvConstants, local_from_world)});
    EXPECT_EQ(in_a("params"), GLint{offsetof(LppvConstants, params)});
    EXPECT_EQ(in_a("low"), GLint{offsetof(LppvConstants, low)});
    EXPECT_EQ(in_a("size_inverse"), GLint{offsetof(LppvConstants, size_inverse)});
    EXPECT_EQ(in_a("shb_r"), GLint{offsetof(LppvConstants, shb_r)});
    EXPECT_EQ(in_a("shc"), GLint{offsetof(LppvConstants, shc)});
    const auto in_b = [&](const char* name) {
        return offset_of(*program, std::string("B.constants.") + name);
    };
    EXPECT_EQ(in_b("texture_from_world"), GLint{offsetof(LppvAtlasConstants, texture_from_world)});
    EXPECT_EQ(in_b("low"), GLint{offsetof(LppvAtlasConstants, low)});
    EXPECT_EQ(in_b("high"), GLint{offsetof(LppvAtlasConstants, high)});
    EXPECT_EQ(in_b("shc"), GLint{offsetof(LppvAtlasConstants, shc)});
}

}  // namespace
}  // namespace tetralight
