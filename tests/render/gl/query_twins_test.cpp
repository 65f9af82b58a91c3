// SPDX-License-Identifier: Apache-2.0
// locate and interpolate on OpenGL against their twin in C++ and the queries of the CPU.
#include <cstring>
#include <random>

#include <tetralight/base/error_text.h>
#include <tetralight/runtime/shader_query.h>
#include "tests/render/gl/shader_runner.h"
#include "tests/runtime/shader_query_cases.h"

namespace tetralight {
namespace {

constexpr uint32_t kParts = 10;

/// Part 0..7: the probe; 8: the cell, as what tells the twins apart; 9: its weights.
constexpr const char* kShader = R"(
vec4 result(uint index, uint part) {
    vec4 at = input_at(index);
    TetralightCellLocation location = tetralight_locate(at.xyz, uint(at.w));
    if (part == 8u) return vec4(float(location.cell & 0xffffffu), 0.0, 0.0, 0.0);
    if (part == 9u) return location.weights;
    TetralightPackedProbe probe = tetralight_interpolate(location);
    if (part == 0u) return probe.sh.sha_r;
    if (part == 1u) return probe.sh.sha_g;
    if (part == 2u) return probe.sh.sha_b;
    if (part == 3u) return probe.sh.shb_r;
    if (part == 4u) return probe.sh.shb_g;
    if (part == 5u) return probe.sh.shb_b;
    return part == 6u ? probe.sh.shc : probe.occlusion;
}
)";

PackedProbe probe_at(const std::vector<glm::vec4>& results, size_t index) {
    PackedProbe probe;
    std::memcpy(static_cast<void*>(&probe), &results[kParts * index], sizeof probe);
    return probe;
}

class QueryTwins : public test::ShaderRunner {
  protected:
    /// Positions, and as w hints: half of them no cell's index.
    static std::vector<glm::vec4> make_inputs(const test::ShaderQueryVolume& subject,
                                              size_t count) {
        std::mt19937_64 engine(8);
        std::vector<glm::vec4> inputs;
        for (const glm::vec3& position : subject.make_positions(count)) {
            const auto hint = static_cast<float>(engine() % (2 * subject.volume.cells.size()));
            inputs.emplace_back(position, hint);
        }
        return inputs;
    }

    static void expect_twin(const ShaderVolume& volume, const std::vector<glm::vec4>& inputs,
                            const std::vector<glm::vec4>& results) {
        ASSERT_EQ(results.size(), kParts * inputs.size());
        size_t other_cell_count = 0;
        for (size_t i = 0; i < inputs.size() && !HasFailure(); ++i) {
            const CellLocation location =
                locate(volume, glm::vec3(inputs[i]), static_cast<uint32_t>(inputs[i].w));
            EXPECT_LE(test::difference(probe_at(results, i), interpolate(volume, location)),
                      test::kShaderTolerance)
                << "position " << i;
            other_cell_count += results[kParts * i + 8].x != static_cast<float>(location.cell);
        }
        // The drivers' rounding may choose the other cell of a shared face alone.
        EXPECT_LE(other_cell_count, inputs.size() / 100);
    }
};

class QueryTwinsOnVolumes : public QueryTwins,
                            public testing::WithParamInterface<test::ShaderQueryCase> {};

TEST_P(QueryTwinsOnVolumes, AgreeInGlsl450) {
    const test::ShaderQueryVolume subject(GetParam());
    const ShaderVolume volume = make_shader_volume(subject.volume.view());
    const auto inputs = make_inputs(subject, 4000);
    const test::ShaderTask task{kShader, inputs, static_cast<uint32_t>(inputs.size()), kParts};
    expect_twin(volume, inputs, run_compute(task, ShaderPart::Query, &volume));
}

TEST_P(QueryTwinsOnVolumes, AgreeInGlslEs300) {
    const test::ShaderQueryVolume subject(GetParam());
    const ShaderVolume volume = make_shader_volume(subject.volume.view());
    const auto inputs = make_inputs(subject, 4000);
    const test::ShaderTask task{kShader, inputs, static_cast<uint32_t>(inputs.size()), kParts};
    expect_twin(volume, inputs, run_fragment(task, ShaderPart::Query, &volume));
}

TEST_P(QueryTwinsOnVolumes, HideProbesBehindWalls) {
    test::ShaderQueryVolume subject(GetParam());
    subject.add_random_walls();
    const ShaderVolume volume = make_shader_volume(subject.volume.view());
    const auto inputs = make_inputs(subject, 4000);
    const test::ShaderTask task{kShader, inputs, static_cast<uint32_t>(inputs.size()), kParts};
    for (const auto& results : {run_compute(task, ShaderPart::Query, &volume),
                                run_fragment(task, ShaderPart::Query, &volume)}) {
        ASSERT_EQ(results.size(), kParts * inputs.size());
        size_t hidden_count = 0;
        for (size_t i = 0; i < inputs.size() && !HasFailure(); ++i) {
            const auto cell = static_cast<uint32_t>(results[kParts * i + 8].x);
            const CellLocation location{cell, 0.0f, results[kParts * i + 9]};
            EXPECT_LE(test::difference(probe_at(results, i), interpolate(volume, location)),
                      test::kShaderTolerance)
                << "position " << i;
            hidden_count += visible_location(volume, location) != location;
        }
        EXPECT_EQ(hidden_count > 500, subject.volume.info.dimension > Dimension::Point);
    }
}

class QueryTwinsOnFaces : public QueryTwins,
                          public testing::WithParamInterface<test::ShaderQueryCase> {};

TEST_P(QueryTwinsOnFaces, AnswerAsSomeCell) {
    const test::ShaderQueryVolume subject(GetParam());
    const ShaderVolume volume = make_shader_volume(subject.volume.view());
    std::vector<glm::vec4> inputs;
    for (const glm::vec3& position : subject.make_edge_middles(2000)) {
        inputs.emplace_back(position, 16'000'000.0f);  // no cell's index
    }
    const test::ShaderTask task{kShader, inputs, static_cast<uint32_t>(inputs.size()), kParts};
    const auto results = run_compute(task, ShaderPart::Query, &volume);
    ASSERT_EQ(results.size(), kParts * inputs.size());
    for (size_t i = 0; i < inputs.size() && !HasFailure(); ++i) {
        const auto cell = static_cast<uint32_t>(results[kParts * i + 8].x);
        const CellLocation location{cell, 0.0f, results[kParts * i + 9]};
        test::expect_answer_of_a_cell(subject.volume.view(), glm::vec3(inputs[i]), location,
                                      probe_at(results, i));
    }
}

INSTANTIATE_TEST_SUITE_P(Volumes, QueryTwinsOnFaces,
                         testing::Values(test::ShaderQueryCase{"lattice", 1728},
                                         test::ShaderQueryCase{"turned_lattice", 1728},
                                         test::ShaderQueryCase{"plane", 500}),
                         [](const auto& param) { return param.param.family; });

INSTANTIATE_TEST_SUITE_P(Volumes, QueryTwinsOnVolumes,
                         testing::ValuesIn(test::shader_query_cases()),
                         [](const auto& param) { return param.param.family; });

TEST_F(QueryTwins, StartAtTheCellThatTheSeedGridNames) {
    const test::ShaderQueryVolume subject({"clusters", 2000});  // grids inside each other
    const ShaderVolume volume = make_shader_volume(subject.volume.view());
    std::vector<glm::vec4> inputs;
    for (const glm::vec3& local : subject.make_seed_positions(4000)) inputs.emplace_back(local, 0);
    const char* const shader = R"(
vec4 result(uint index, uint part) {
    return vec4(float(tetralight_seed_cell(input_at(index).xyz)), 0.0, 0.0, 0.0);
}
)";
    const test::ShaderTask task{shader, inputs, static_cast<uint32_t>(inputs.size()), 1};
    for (const auto& results : {run_compute(task, ShaderPart::Query, &volume),
                                run_fragment(task, ShaderPart::Query, &volume)}) {
        ASSERT_EQ(results.size(), inputs.size());
        for (size_t i = 0; i < inputs.size(); ++i) {
            EXPECT_EQ(results[i].x, static_cast<float>(seed_cell(volume, glm::vec3(inputs[i]))));
        }
    }
}

TEST_F(QueryTwins, AgreeWithTheCpuAtAHundredThousandPositions) {
    const test::ShaderQueryVolume subject({"random", 5000});
    const ShaderVolume volume = make_shader_volume(subject.volume.view());
    const auto inputs = make_inputs(subject, 100'000);
    const char* const shader = R"(
vec4 result(uint index, uint part) {
    vec3 at = input_at(index).xyz;
    TetralightPackedProbe probe = tetralight_interpolate(tetralight_locate(at, 0xffffffffu));
    return vec4(tetralight_sample_sh9(probe.sh, normalize(at)), probe.occlusion.y);
}
)";
    const test::ShaderTask task{shader, inputs, static_cast<uint32_t>(inputs.size()), 1};
    const auto results = run_compute(task, ShaderPart::Query, &volume);
    ASSERT_EQ(results.size(), inputs.size());
    for (size_t i = 0; i < inputs.size() && !HasFailure(); ++i) {
        const glm::vec3 at(inputs[i]);
        const InterpolatedProbe cpu =
            interpolate(subject.volume.view(), locate(subject.volume.view(), at));
        const glm::vec3 light = sample_sh9(pack_sh(cpu.irradiance), glm::normalize(at));
        EXPECT_LE(glm::distance(results[i], glm::vec4(light, cpu.occlusion.y)),
                  test::kShaderTolerance)
            << "position " << i;
    }
}

TEST_F(QueryTwins, NoProbesAndPositionsThatAreNotFiniteGetTheAmbientLight) {
    ProbeVolume empty;
    empty.info.ambient.coefficients[0] = glm::vec3(2.0f);
    const ShaderVolume nothing = make_shader_volume(empty.view());
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    const std::vector<glm::vec4> inputs{{1, 2, 3, 0}, {kNan, 0, 0, 0}, {0, 0, -INFINITY, 0}};
    const test::ShaderTask task{kShader, inputs, 3, kParts};
    const auto none = run_compute(task, ShaderPart::Query, &nothing);
    const test::ShaderQueryVolume subject({"random", 100});
    const ShaderVolume volume = make_shader_volume(subject.volume.view());
    const auto some = run_compute(task, ShaderPart::Query, &volume);
    ASSERT_EQ(some.size(), 3 * kParts);
    for (size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(probe_at(none, i).sh, pack_sh(empty.info.ambient));
        EXPECT_EQ(probe_at(some, i).sh == volume.constants.ambient, i > 0);
    }
}

class QueryTwinsOfEveryDimension : public QueryTwins,
                                   public testing::WithParamInterface<test::ShaderQueryCase> {};

TEST_P(QueryTwinsOfEveryDimension, PositionsThatAreNotFiniteGetTheAmbientLight) {
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    const test::ShaderQueryVolume subject(GetParam());
    const ShaderVolume volume = make_shader_volume(subject.volume.view());
    std::vector<glm::vec4> inputs;
    for (const float wrong : {kNan, -kNan, INFINITY, -INFINITY}) {
        for (int axis = 0; axis < 3; ++axis) {
            inputs.emplace_back(0.1f, 0.2f, 0.3f, 0.0f);
            inputs.back()[axis] = wrong;
        }
    }
    const auto count = static_cast<uint32_t>(inputs.size());
    const test::ShaderTask task{kShader, inputs, count, kParts};
    for (const auto& results : {run_compute(task, ShaderPart::Query, &volume),
                                run_fragment(task, ShaderPart::Query, &volume)}) {
        ASSERT_EQ(results.size(), kParts * inputs.size());
        for (size_t i = 0; i < inputs.size(); ++i) {
            EXPECT_EQ(probe_at(results, i),
                      (PackedProbe{volume.constants.ambient, glm::vec4(1.0f)}))
                << "position " << i;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Dimensions, QueryTwinsOfEveryDimension,
                         testing::Values(test::ShaderQueryCase{"few", 1},
                                         test::ShaderQueryCase{"line", 20},
                                         test::ShaderQueryCase{"plane", 50},
                                         test::ShaderQueryCase{"random", 50}),
                         [](const auto& param) { return param.param.family; });

/// The offset that the driver gives a member of a block.
GLint offset_of(const ShaderProgram& program, GLenum interface, const char* name) {
    const GLuint index = glGetProgramResourceIndex(program.name(), interface, name);
    const GLenum property = GL_OFFSET;
    GLint offset = -1;
    if (index == GL_INVALID_INDEX) return offset;
    glGetProgramResourceiv(program.name(), interface, index, 1, &property, 1, nullptr, &offset);
    return offset;
}

TEST_F(QueryTwins, StructsLieInMemoryAsTheDriverSays) {
    const std::string own =
        std::string("layout(local_size_x = 1) in;\n") +
        "layout(std430, binding = 8) buffer Probes {\n"
        "    TetralightPackedProbe probes[];\n"
        "};\n"
        "void main() {\n"
        "    vec3 position = probes[1].sh.shc.xyz;\n"
        "    probes[0] = tetralight_interpolate(tetralight_locate(position, 0u));\n"
        "}\n";
    const auto source =
        compose_shader(ShaderLanguage::Glsl450, {ShaderPart::Query}, {"layout.comp", own});
    const ShaderStage stage{GL_COMPUTE_SHADER, source};
    const auto program = ShaderProgram::create(std::span(&stage, 1));
    ASSERT_TRUE(program) << error_text(program.error());
    const auto fact = [&](const std::string& member) {
        const std::string name = "tetralight_volume." + member;
        return offset_of(*program, GL_UNIFORM, name.c_str());
    };
    using Facts = ShaderVolumeConstants;
    EXPECT_EQ(fact("origin"), GLint{offsetof(Facts, origin)});
    EXPECT_EQ(fact("origin_rest"), GLint{offsetof(Facts, origin_rest)});
    EXPECT_EQ(fact("axis"), GLint{offsetof(Facts, axis)});
    EXPECT_EQ(fact("seed_min"), GLint{offsetof(Facts, seed_min)});
    EXPECT_EQ(fact("seed_scale"), GLint{offsetof(Facts, seed_scale)});
    EXPECT_EQ(fact("seed_size"), GLint{offsetof(Facts, seed_size)});
    EXPECT_EQ(fact("counts"), GLint{offsetof(Facts, counts)});
    EXPECT_EQ(fact("walls"), GLint{offsetof(Facts, walls)});
    EXPECT_EQ(fact("ambient.sha_r"), GLint{offsetof(Facts, ambient.sha_r)});
    EXPECT_EQ(fact("ambient.shc"), GLint{offsetof(Facts, ambient.shc)});
    const auto buffer = [&](const char* name) {
        return offset_of(*program, GL_BUFFER_VARIABLE, name);
    };
    EXPECT_EQ(buffer("probes[0].sh.sha_r"), GLint{offsetof(PackedProbe, sh.sha_r)});
    EXPECT_EQ(buffer("probes[0].sh.shb_r"), GLint{offsetof(PackedProbe, sh.shb_r)});
    EXPECT_EQ(buffer("probes[0].sh.shc"), GLint{offsetof(PackedProbe, sh.shc)});
    EXPECT_EQ(buffer("probes[0].occlusion"), GLint{offsetof(PackedProbe, occlusion)});
}

TEST_F(QueryTwins, CompileErrorsShowFileAndLine) {
    const auto source = compose_shader(ShaderLanguage::Glsl450, {ShaderPart::Sh},
                                       {"broken.comp",
                                        "layout(local_size_x = 1) in;\n"
                                        "void main() {\n    no_such_thing();\n}\n"});
    const ShaderStage stage{GL_COMPUTE_SHADER, source};
    const auto program = ShaderProgram::create(std::span(&stage, 1));
    ASSERT_FALSE(program);
    EXPECT_TRUE(error_text(program.error()).find("broken.comp:3") != std::string::npos)
        << error_text(program.error());
}

}  // namespace
}  // namespace tetralight
