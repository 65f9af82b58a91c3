// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bench/gpu_query.h>

#define GL_GLEXT_PROTOTYPES
#include <GL/glcorearb.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <random>

#include <tetralight/base/error_text.h>
#include <tetralight/bench/harness.h>
#include <tetralight/bench/query_subject.h>
#include <tetralight/probes/interpolate.h>
#include <tetralight/render/gl/offscreen_context.h>
#include <tetralight/render/gl/shader_program.h>
#include <tetralight/render/gl/volume_buffers.h>

namespace tetralight::bench {
namespace {

constexpr size_t kCount = 1'000'000;

/// The GPU's result for a position.
struct Answer {
    PackedProbe probe;
    glm::vec4 weights;
    glm::uvec4 cell;
};

constexpr const char* kShader = R"(
layout(local_size_x = 64) in;
layout(std430, binding = 8) readonly buffer Positions { vec4 positions[]; };
struct Answer { TetralightPackedProbe probe; vec4 weights; uvec4 cell; };
layout(std430, binding = 9) writeonly buffer Answers { Answer answers[]; };
void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i >= uint(positions.length())) return;
    TetralightCellLocation location = tetralight_locate(positions[i].xyz, 0xffffffffu);
    answers[i] = Answer(tetralight_interpolate(location), location.weights, uvec4(location.cell));
}
)";

std::vector<Answer> query_gpu(const ShaderVolume& volume, const std::vector<glm::vec3>& positions) {
    const auto source =
        compose_shader(ShaderLanguage::Glsl450, {ShaderPart::Query}, {"query.comp", kShader});
    const ShaderStage stage{GL_COMPUTE_SHADER, source};
    const auto program = ShaderProgram::create(std::span(&stage, 1));
    require(bool(program), program ? "" : error_text(program.error()));
    std::vector<glm::vec4> inputs;
    for (const glm::vec3& position : positions) inputs.emplace_back(position, 0.0f);
    std::vector<Answer> answers(positions.size());
    std::array<GLuint, 2> buffers{};
    glCreateBuffers(2, buffers.data());
    glNamedBufferStorage(buffers[0], static_cast<GLsizeiptr>(16 * inputs.size()), inputs.data(), 0);
    const auto size = static_cast<GLsizeiptr>(sizeof(Answer) * answers.size());
    glNamedBufferStorage(buffers[1], size, nullptr, 0);
    const VolumeBuffers uploaded(volume);
    uploaded.bind();
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 8, buffers[0]);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 9, buffers[1]);
    glUseProgram(program->name());
    glDispatchCompute(static_cast<GLuint>((inputs.size() + 63) / 64), 1, 1);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    glGetNamedBufferSubData(buffers[1], 0, size, answers.data());
    glDeleteBuffers(2, buffers.data());
    require(glGetError() == GL_NO_ERROR, "runtime.gpu_query: OpenGL failed");
    return answers;
}

/// The largest difference, as a fraction of the light.
double difference(const PackedProbe& a, const PackedProbe& b) {
    const auto* x = reinterpret_cast<const float*>(&a);
    const auto* y = reinterpret_cast<const float*>(&b);
    double largest = 0.0, size = 0.0;
    for (size_t i = 0; i < sizeof a / sizeof(float); ++i) {
        const double apart = std::abs(static_cast<double>(x[i]) - static_cast<double>(y[i]));
        if (!(apart <= largest)) largest = apart;  // NaN is the largest
        size = std::max(size, std::abs(static_cast<double>(y[i])));
    }
    return largest / size;
}

/// True if the blended positions of a location's probes give the position.
bool is_blend_at(const ProbeVolumeView& volume, const glm::vec3& position, uint32_t cell,
                 const glm::vec4& weights) {
    if (cell >= volume.cells.size()) return false;
    glm::dvec3 blend = volume.info.world_origin;
    for (int i = 0; i < 4; ++i) {
        if (weights[i] == 0.0f) continue;
        const uint32_t probe = volume.cells[cell].vertices[static_cast<size_t>(i)];
        blend += static_cast<double>(weights[i]) * glm::dvec3(volume.positions[probe]);
    }
    const double rounding = 2e-6 * static_cast<double>(volume.info.extent);
    return glm::distance(blend, glm::dvec3(position)) <= rounding;
}

/// Results over all positions of a volume.
struct Verdict {
    size_t disagreement_count = 0;
    /// Positions on a border where CPU and GPU chose different cells with different light.
    size_t other_cell_count = 0;
    double largest = 0.0;
};

/// Calls `judge(position, answer)` with the GPU's answer for each position.
template <class Judge>
void query_parts(const ShaderVolume& volume, const std::vector<glm::vec3>& positions, Judge judge) {
    constexpr size_t kPart = 500'000;  // OpenGL guarantees buffers of 128 MiB
    for (size_t begin = 0; begin < positions.size(); begin += kPart) {
        const size_t end = std::min(positions.size(), begin + kPart);
        const auto at = [&](size_t i) {
            return positions.begin() + static_cast<std::ptrdiff_t>(i);
        };
        const std::vector<glm::vec3> part(at(begin), at(end));
        const std::vector<Answer> answers = query_gpu(volume, part);
        for (size_t i = 0; i < part.size(); ++i) judge(part[i], answers[i]);
    }
}

constexpr double kTolerance = 1e-3;

Verdict compare(const ProbeVolumeView& view, const std::vector<glm::vec3>& positions) {
    Verdict verdict;
    query_parts(make_shader_volume(view), positions, [&](const glm::vec3& at, const Answer& gpu) {
        const CellLocation cpu = locate(view, at);
        const InterpolatedProbe probe = interpolate(view, cpu);
        const double apart = difference(gpu.probe, {pack_sh(probe.irradiance), probe.occlusion});
        if (apart <= kTolerance) {
            verdict.largest = std::max(verdict.largest, apart);
            return;
        }
        const bool is_between = is_blend_at(view, at, cpu.cell, cpu.weights) &&
                                is_blend_at(view, at, gpu.cell.x, gpu.weights);
        ++(is_between ? verdict.other_cell_count : verdict.disagreement_count);
    });
    return verdict;
}

/// Answers that differ from the CPU's at the cell and the weights that the GPU found: beside a wall
/// light changes a thousand times faster than weights.
size_t count_other_walls(const ProbeVolumeView& view, const std::vector<glm::vec3>& positions) {
    size_t count = 0;
    query_parts(make_shader_volume(view), positions, [&](const glm::vec3&, const Answer& gpu) {
        const InterpolatedProbe probe = interpolate(view, {gpu.cell.x, 0.0f, gpu.weights});
        const double apart = difference(gpu.probe, {pack_sh(probe.irradiance), probe.occlusion});
        count += !(apart <= kTolerance);
    });
    return count;
}

/// Midpoints of the edges of cells.
std::vector<glm::vec3> edge_middles(const ProbeVolume& volume, size_t count) {
    std::mt19937_64 engine(1);
    std::vector<glm::vec3> positions;
    for (size_t i = 0; i < count; ++i) {
        const Cell& cell = volume.cells[engine() % volume.info.inner_cell_count];
        const glm::dvec3 a = volume.exact_positions[cell.vertices[engine() % 4]];
        const glm::dvec3 b = volume.exact_positions[cell.vertices[engine() % 4]];
        positions.emplace_back(0.5 * (a + b));
    }
    return positions;
}

}  // namespace

void bench_gpu_query() {
    const auto context = OffscreenContext::create();
    if (!context) {
        std::fprintf(stderr, "runtime.gpu_query_disagreements: %s\n",
                     error_text(context.error()).c_str());
        return;
    }
    Subject random = make_random_subject("20k", 20'000);
    const Verdict verdict = compare(random.volume.view(), random.positions(kCount));
    report("runtime.gpu_query_disagreements", static_cast<double>(verdict.disagreement_count),
           "of 1000000 beyond 0.001 of the light");
    report("runtime.gpu_query_difference", verdict.largest, "of the light, the largest");
    report("runtime.gpu_query_disagreements.other_cell",
           static_cast<double>(verdict.other_cell_count), "of 1000000 on faces");
    add_random_walls(random.volume, 0.5);
    report("runtime.gpu_query_disagreements.walls",
           static_cast<double>(count_other_walls(random.volume.view(), random.positions(kCount))),
           "of 1000000, half of all edges blocked");
    const Subject lattice = make_lattice_subject("20k", 20'000);
    const Verdict edges = compare(lattice.volume.view(), edge_middles(lattice.volume, kCount / 10));
    report("runtime.gpu_query_disagreements.edges", static_cast<double>(edges.disagreement_count),
           "of 100000 edge middles of a turned lattice");
    report("runtime.gpu_query_disagreements.edges.other_cell",
           static_cast<double>(edges.other_cell_count), "of 100000 on faces");
}

}  // namespace tetralight::bench
