// SPDX-License-Identifier: Apache-2.0
// Every variant of the shader library goes through glslang: GLSL 4.50, GLSL ES 3.00 and HLSL.
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <tetralight/runtime/shader_library.h>
#include "tests/support/temp_folder.h"

namespace tetralight {
namespace {

/// A way to use the library: what a shader's own text calls.
struct Use {
    std::string name;
    ShaderPart part;
    std::string glsl;  ///< the body of a function that gives a vec3
    std::string hlsl;
    /// What is declared before.
    std::string glsl_globals = {};
    std::string hlsl_globals = {};
};

const std::vector<Use>& uses() {
    static const std::vector<Use> all{
        {"sh", ShaderPart::Sh,
         R"(TetralightPackedSh sh = TetralightPackedSh(v, v, v, v, v, v, v);
            sh = tetralight_add_layer(sh, sh, v.xyz);
            vec3 normal = tetralight_instance_normal(v.xyz, v.yzx, v.zxy, v.xyz);
            normal = tetralight_mapped_normal(normal, v, v.xy, v.z);
            float lit = tetralight_mix_occlusion(v.x, tetralight_probe_occlusion(v, 2), 0.5);
            return lit * (tetralight_sample_sh9(sh, normal) +
                          tetralight_sample_sh4(tetralight_first_bands(sh), normal));)",
         R"(TetralightPackedSh sh;
            sh.sha_r = v; sh.sha_g = v; sh.sha_b = v;
            sh.shb_r = v; sh.shb_g = v; sh.shb_b = v; sh.shc = v;
            sh = tetralight_add_layer(sh, sh, v.xyz);
            float3 normal = tetralight_instance_normal(v.xyz, v.yzx, v.zxy, v.xyz);
            normal = tetralight_mapped_normal(normal, v, v.xy, v.z);
            float lit = tetralight_mix_occlusion(v.x, tetralight_probe_occlusion(v, 2), 0.5);
            return lit * (tetralight_sample_sh9(sh, normal) +
                          tetralight_sample_sh4(tetralight_first_bands(sh), normal));)"},
        {"lppv", ShaderPart::Lppv,
         R"(vec4 occlusion = tetralight_sample_lppv_occlusion(slabs, constants, v.xyz) *
                tetralight_sample_lppv_atlas_occlusion(slabs, atlas_constants, v.xyz);
            TetralightPackedSh sh = tetralight_sample_lppv_4(slabs, constants, v.xyz);
            TetralightPackedSh sh_7 = tetralight_sample_lppv_7(slabs, constants, v.xyz);
            TetralightPackedSh atlas =
                tetralight_sample_lppv_atlas_4(slabs, atlas_constants, v.xyz);
            TetralightPackedSh atlas_7 =
                tetralight_sample_lppv_atlas_7(slabs, atlas_constants, v.xyz);
            sh = tetralight_add_layer(tetralight_add_layer(sh, sh_7, v.xyz), atlas, v.xyz);
            sh = tetralight_add_layer(sh, atlas_7, v.xyz);
            return occlusion.x * tetralight_sample_sh9(sh, v.xyz);)",
         R"(float4 occlusion =
                tetralight_sample_lppv_occlusion(slabs, slabs_sampler, constants, v.xyz);
            occlusion *= tetralight_sample_lppv_atlas_occlusion(slabs, slabs_sampler,
                                                                atlas_constants, v.xyz);
            TetralightPackedSh sh =
                tetralight_sample_lppv_4(slabs, slabs_sampler, constants, v.xyz);
            TetralightPackedSh sh_7 =
                tetralight_sample_lppv_7(slabs, slabs_sampler, constants, v.xyz);
            TetralightPackedSh atlas =
                tetralight_sample_lppv_atlas_4(slabs, slabs_sampler, atlas_constants, v.xyz);
            TetralightPackedSh atlas_7 =
                tetralight_sample_lppv_atlas_7(slabs, slabs_sampler, atlas_constants, v.xyz);
            sh = tetralight_add_layer(tetralight_add_layer(sh, sh_7, v.xyz), atlas, v.xyz);
            sh = tetralight_add_layer(sh, atlas_7, v.xyz);
            return occlusion.x * tetralight_sample_sh9(sh, v.xyz);)",
         "#ifdef VULKAN\n#define AT(number) binding = number,\n#else\n#define AT(number)\n#endif\n"
         "layout(AT(6) std140) uniform Volumes { TetralightLppvConstants constants;"
         " TetralightLppvAtlasConstants atlas_constants; };\n"
         "#ifdef VULKAN\nlayout(binding = 7)\n#endif\nuniform sampler3D slabs;\n",
         "cbuffer Volumes : register(b6) {\n"
         "TetralightLppvConstants constants; TetralightLppvAtlasConstants atlas_constants; };\n"
         "Texture3D<float4> slabs : register(t7);\nSamplerState slabs_sampler : register(s8);\n"},
        {"query", ShaderPart::Query,
         R"(TetralightCellLocation location = tetralight_locate(v.xyz, uint(v.w));
            TetralightPackedProbe probe = tetralight_interpolate(location);
            return tetralight_sample_sh9(probe.sh, vec3(0.0, 1.0, 0.0)) * probe.occlusion.x;)",
         R"(TetralightCellLocation location = tetralight_locate(v.xyz, uint(v.w));
            TetralightPackedProbe probe = tetralight_interpolate(location);
            return tetralight_sample_sh9(probe.sh, float3(0.0, 1.0, 0.0)) * probe.occlusion.x;)"},
        {"lightmap", ShaderPart::Lightmap,
         R"(vec2 uv = tetralight_page_uv(v, v.xy);
            vec4 mask = tetralight_lightmap_shadow_mask(pages, uv, v.z);
            float open = tetralight_lightmap_ambient_occlusion(pages, uv, v.z);
            return tetralight_lightmap_irradiance(pages, uv, v.z, v.w) *
                   tetralight_mono_ratio(v.xyz, v.yzx, v.zxy) +
                   tetralight_lightmap_directional(pages, uv, v.z, v.w, v.xyz, v.yzx) +
                   tetralight_subtract_shadow(mask.xyz, v.xyz, open, v.zyx);)",
         R"(float2 uv = tetralight_page_uv(v, v.xy);
            float4 mask = tetralight_lightmap_shadow_mask(pages, pages_sampler, uv, v.z);
            float open = tetralight_lightmap_ambient_occlusion(pages, pages_sampler, uv, v.z);
            return tetralight_lightmap_irradiance(pages, pages_sampler, uv, v.z, v.w) *
                   tetralight_mono_ratio(v.xyz, v.yzx, v.zxy) +
                   tetralight_lightmap_directional(pages, pages_sampler, uv, v.z, v.w, v.xyz,
                                                   v.yzx) +
                   tetralight_subtract_shadow(mask.xyz, v.xyz, open, v.zyx);)",
         "#ifdef VULKAN\nlayout(binding = 7)\n#endif\nuniform sampler2DArray pages;\n",
         "Texture2DArray<float4> pages : register(t7);\n"
         "SamplerState pages_sampler : register(s8);\n"},
        {"reflection", ShaderPart::Reflection,
         R"(TetralightReflectionChoice choice = tetralight_no_reflection();
            float influence = tetralight_reflection_influence(blend.first, v.xyz);
            choice = tetralight_add_reflection(choice, 0.0, influence);
            vec3 weights = tetralight_reflection_weights(choice);
            vec2 scale_and_bias = tetralight_split_sum(table, v.x, v.w);
            vec3 f0 = tetralight_specular_f0(v.xyz, v.w);
            vec3 light = tetralight_sample_reflection_cube(cube, blend.first, v.xyz, v.yzx, 0.5);
            #ifdef TETRALIGHT_HAS_CUBE_ARRAYS
            light += tetralight_sample_reflections(cubes, blend, v.xyz, v.zxy, v.w);
            #endif
            light *= tetralight_reflection_occlusion(v.xyz, v.zxy, v.w) * weights.x;
            return light * (f0 * scale_and_bias.x + scale_and_bias.y);)",
         R"(TetralightReflectionChoice choice = tetralight_no_reflection();
            float influence = tetralight_reflection_influence(blend.first, v.xyz);
            choice = tetralight_add_reflection(choice, 0.0, influence);
            float3 weights = tetralight_reflection_weights(choice);
            float2 scale_and_bias = tetralight_split_sum(table, table_sampler, v.x, v.w);
            float3 f0 = tetralight_specular_f0(v.xyz, v.w);
            float3 light = tetralight_sample_reflection_cube(cube, cube_sampler, blend.first,
                                                             v.xyz, v.yzx, 0.5);
            light += tetralight_sample_reflections(cubes, cubes_sampler, blend, v.xyz, v.zxy, v.w);
            light *= tetralight_reflection_occlusion(v.xyz, v.zxy, v.w) * weights.x;
            return light * (f0 * scale_and_bias.x + scale_and_bias.y);)",
         "#ifdef VULKAN\n#define AT(number) layout(binding = number)\n#else\n#define AT(number)\n"
         "#endif\n#ifdef VULKAN\nlayout(binding = 6, std140)\n#else\nlayout(std140)\n#endif\n"
         "uniform Blend { TetralightReflectionBlend blend; };\n"
         "AT(7) uniform sampler2D table;\nAT(8) uniform samplerCube cube;\n"
         "#ifdef TETRALIGHT_HAS_CUBE_ARRAYS\nAT(9) uniform highp samplerCubeArray cubes;\n"
         "#endif\n",
         "cbuffer Blend : register(b6) { TetralightReflectionBlend blend; };\n"
         "Texture2D<float4> table : register(t7);\nSamplerState table_sampler : register(s7);\n"
         "TextureCube<float4> cube : register(t8);\nSamplerState cube_sampler : register(s8);\n"
         "TextureCubeArray<float4> cubes : register(t9);\n"
         "SamplerState cubes_sampler : register(s9);\n"},
    };
    return all;
}

struct Variant {
    std::string name;
    ShaderLanguage language;
    std::string stage;
    std::string options;
    std::string wrap_begin, wrap_end;
    /// What takes the place of the language's own `#version`.
    std::string version = {};
};

const std::vector<Variant>& variants() {
    static const std::vector<Variant> all{
        {"GLSL 4.50 fragment", ShaderLanguage::Glsl450, "frag", "",
         "layout(location = 0) in vec4 v_in;\nlayout(location = 0) out vec4 color;\n"
         "vec3 shade(vec4 v) {\n",
         "}\nvoid main() { color = vec4(shade(v_in), 1.0); }\n"},
        {"GLSL 4.50 vertex", ShaderLanguage::Glsl450, "vert", "",
         "layout(location = 0) in vec4 v_in;\nlayout(location = 0) out vec3 color;\n"
         "vec3 shade(vec4 v) {\n",
         "}\nvoid main() { color = shade(v_in); gl_Position = v_in; }\n"},
        {"GLSL 4.50 compute", ShaderLanguage::Glsl450, "comp", "",
         "layout(local_size_x = 64) in;\n"
         "layout(std430, binding = 8) buffer Values { vec4 values[]; };\nvec3 shade(vec4 v) {\n",
         "}\nvoid main() { uint i = gl_GlobalInvocationID.x;"
         " values[i] = vec4(shade(values[i]), 1.0); }\n"},
        {"GLSL ES 3.00 fragment", ShaderLanguage::GlslEs300, "frag", "",
         "in vec4 v_in;\nout vec4 color;\nvec3 shade(vec4 v) {\n",
         "}\nvoid main() { color = vec4(shade(v_in), 1.0); }\n"},
        {"GLSL ES 3.00 vertex", ShaderLanguage::GlslEs300, "vert", "",
         "in vec4 v_in;\nout vec3 color;\nvec3 shade(vec4 v) {\n",
         "}\nvoid main() { color = shade(v_in); gl_Position = v_in; }\n"},
        {"GLSL 3.30 fragment", ShaderLanguage::Glsl450, "frag", "",
         "in vec4 v_in;\nout vec4 color;\nvec3 shade(vec4 v) {\n",
         "}\nvoid main() { color = vec4(shade(v_in), 1.0); }\n", "#version 330\n"},
        {"GLSL ES 3.10 compute", ShaderLanguage::GlslEs300, "comp", "",
         "layout(local_size_x = 64) in;\n"
         "layout(std430, binding = 3) buffer Values { vec4 values[]; };\nvec3 shade(vec4 v) {\n",
         "}\nvoid main() { uint i = gl_GlobalInvocationID.x;"
         " values[i] = vec4(shade(values[i]), 1.0); }\n",
         "#version 310 es\n"},
        {"GLSL ES 3.20 fragment", ShaderLanguage::GlslEs300, "frag", "",
         "in vec4 v_in;\nout vec4 color;\nvec3 shade(vec4 v) {\n",
         "}\nvoid main() { color = vec4(shade(v_in), 1.0); }\n", "#version 320 es\n"},
        {"GLSL for Vulkan", ShaderLanguage::Glsl450, "frag", "-V ",
         "layout(location = 0) in vec4 v_in;\nlayout(location = 0) out vec4 color;\n"
         "vec3 shade(vec4 v) {\n",
         "}\nvoid main() { color = vec4(shade(v_in), 1.0); }\n"},
        {"HLSL pixel", ShaderLanguage::Hlsl, "frag", "-D -V -e shade --auto-map-locations ", "",
         ""},
        {"HLSL vertex", ShaderLanguage::Hlsl, "vert", "-D -V -e shade --auto-map-locations ", "",
         ""},
    };
    return all;
}

std::string own_text(const Variant& variant, const Use& use) {
    if (variant.language != ShaderLanguage::Hlsl) {
        return use.glsl_globals + variant.wrap_begin + use.glsl + variant.wrap_end;
    }
    const bool is_vertex = variant.stage == "vert";
    return use.hlsl_globals + "float3 light(float4 v) {\n" + use.hlsl +
           "\n}\nfloat4 shade(float4 v : TEXCOORD0) : " +
           (is_vertex ? "SV_Position" : "SV_Target") + " { return float4(light(v), 1.0); }\n";
}

struct Compiled {
    bool is_right = false;
    std::string log;
};

std::string with_version(const Variant& variant, const std::string& text) {
    if (variant.version.empty()) return text;
    return variant.version + text.substr(text.find('\n') + 1);
}

/// Runs glslangValidator, the reference compiler, on a shader.
Compiled compile(const Variant& variant, const ShaderSource& source) {
    const TempFolder folder;
    const std::string path = folder.path("shader." + variant.stage);
    std::ofstream(path) << with_version(variant, source.text);
    const bool writes = !variant.options.empty();
    const std::string command = std::string(TETRALIGHT_GLSLANG) + " " + variant.options + "-S " +
                                variant.stage + (writes ? " -o " + folder.path("out.spv") : "") +
                                " " + path + " 2>&1";
    FILE* pipe = popen(command.c_str(), "r");
    Compiled compiled;
    std::array<char, 4096> part;
    while (std::fgets(part.data(), part.size(), pipe)) compiled.log += part.data();
    compiled.is_right = pclose(pipe) == 0;
    return compiled;
}

class ShaderCompile : public testing::TestWithParam<Variant> {
  protected:
    void SetUp() override {
        if (std::string_view(TETRALIGHT_GLSLANG).ends_with("NOTFOUND")) {
            GTEST_SKIP() << "glslangValidator is not here: install glslang-tools to run this test";
        }
    }
};

TEST_P(ShaderCompile, TakesEveryPart) {
    for (const Use& use : uses()) {
        const auto source = compose_shader(GetParam().language, {use.part},
                                           {"own.glsl", own_text(GetParam(), use)});
        const Compiled compiled = compile(GetParam(), source);
        EXPECT_TRUE(compiled.is_right) << use.name << "\n"
                                       << name_shader_lines(source, compiled.log);
    }
}

TEST_P(ShaderCompile, ErrorsShowFileAndLine) {
    const auto source = compose_shader(GetParam().language, {ShaderPart::Query},
                                       {"broken.glsl", "\n\nthis is no shader\n"});
    const Compiled compiled = compile(GetParam(), source);
    EXPECT_FALSE(compiled.is_right);
    EXPECT_NE(name_shader_lines(source, compiled.log).find("broken.glsl:3"), std::string::npos)
        << compiled.log;
}

/// Where a compiler's reflection (-q) says that a block or a buffer is bound; -1: nowhere.
int binding_of(const std::string& log, const std::string& name) {
    const size_t line = log.find("\n" + name + ": ");
    if (line == std::string::npos) return -1;
    const size_t at = log.find("binding ", line);
    return at == std::string::npos ? -1 : std::atoi(&log[at + 8]);
}

class ShaderBindings : public ShaderCompile {};

TEST_P(ShaderBindings, DifferFromEachOther) {
    const Use& query = uses()[2];
    const auto source = compose_shader(GetParam().language, {query.part},
                                       {"own.glsl", own_text(GetParam(), query)});
    const Compiled compiled = compile(GetParam(), source);
    ASSERT_TRUE(compiled.is_right) << compiled.log;
    const bool is_hlsl = GetParam().language == ShaderLanguage::Hlsl;
    const std::vector<std::string> names =
        is_hlsl
            ? std::vector<std::string>{"tetralight_positions", "tetralight_light",
                                       "tetralight_cells",     "tetralight_hull_rays",
                                       "tetralight_seeds",     "tetralight_walls",
                                       "TetralightVolume"}
            : std::vector<std::string>{"TetralightPositions", "TetralightLight", "TetralightCells",
                                       "TetralightHullRays",  "TetralightSeeds", "TetralightWalls",
                                       "TetralightVolume"};
    for (size_t i = 0; i < names.size(); ++i) {
        EXPECT_EQ(binding_of(compiled.log, names[i]), static_cast<int>(i)) << compiled.log;
    }
}

INSTANTIATE_TEST_SUITE_P(Languages, ShaderBindings,
                         testing::Values(Variant{"GLSL", ShaderLanguage::Glsl450, "frag", "-V -q ",
                                                 "layout(location = 0) in vec4 v_in;\n"
                                                 "layout(location = 0) out vec4 color;\n"
                                                 "vec3 shade(vec4 v) {\n",
                                                 "}\nvoid main() {"
                                                 " color = vec4(shade(v_in), 1.0); }\n"},
                                         Variant{"HLSL", ShaderLanguage::Hlsl, "frag",
                                                 "-D -V -q -e shade --auto-map-locations ", "",
                                                 ""}),
                         [](const auto& variant) { return variant.param.name; });

TEST_F(ShaderBindings, AreThoseThatTheShaderChooses) {
    const Use& query = uses()[2];
    const Variant hlsl{
        "", ShaderLanguage::Hlsl, "frag", "-D -V -q -e shade --auto-map-locations ", "", ""};
    auto source = compose_shader(hlsl.language, {query.part}, {"own.glsl", own_text(hlsl, query)});
    source.text =
        "#define TETRALIGHT_POSITIONS_BINDING 20\n#define TETRALIGHT_LIGHT_BINDING 21\n"
        "#define TETRALIGHT_CELLS_BINDING 22\n#define TETRALIGHT_HULL_RAYS_BINDING 23\n"
        "#define TETRALIGHT_SEEDS_BINDING 24\n#define TETRALIGHT_WALLS_BINDING 25\n"
        "#define TETRALIGHT_VOLUME_BINDING 9\n" +
        source.text;
    const Compiled compiled = compile(hlsl, source);
    EXPECT_EQ(binding_of(compiled.log, "tetralight_seeds"), 24) << compiled.log;
    EXPECT_EQ(binding_of(compiled.log, "tetralight_walls"), 25) << compiled.log;
    EXPECT_EQ(binding_of(compiled.log, "TetralightVolume"), 9) << compiled.log;
}

TEST_F(ShaderBindings, HlslHasNoTextures) {
    const Use& query = uses()[2];
    const Variant hlsl{"", ShaderLanguage::Hlsl, "frag", "-D -V -e shade ", "", ""};
    auto source = compose_shader(hlsl.language, {query.part}, {"own.glsl", own_text(hlsl, query)});
    source.text = "#define TETRALIGHT_TEXTURES\n" + source.text;
    const Compiled compiled = compile(hlsl, source);
    EXPECT_NE(compiled.log.find("do not define TETRALIGHT_TEXTURES"), std::string::npos)
        << compiled.log;
}

INSTANTIATE_TEST_SUITE_P(Variants, ShaderCompile, testing::ValuesIn(variants()),
                         [](const auto& variant) {
                             std::string name = variant.param.name;
                             std::erase_if(name, [](char c) { return !std::isalnum(c); });
                             return name;
                         });

}  // namespace
}  // namespace tetralight
