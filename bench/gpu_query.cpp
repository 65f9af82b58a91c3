// SPDX-License-Identifier: Apache-2.0
#include "bench/gpu_query.h"

#define GL_GLEXT_PROTOTYPES
#include <GL/glcorearb.h>

#include <array>
#include <cmath>
#include <cstdio>

#include "bench/harness.h"
#include "bench/query_subject.h"
#include "probes/interpolate.h"
#include "runtime/gl/offscreen_context.h"
#include "runtime/gl/shader_program.h"
#include "runtime/gl/volume_buffers.h"

namespace tetralight::bench {
namespace {

constexpr size_t kCount = 1'000'000;

/// Each answer: PackedSh, occlusion.
constexpr const char* kShader = R"(
layout(local_size_x = 64) in;
layout(std430, binding = 8) readonly buffer Positions { vec4 positions[]; };
layout(std430, binding = 9) writeonly buffer Answers { PackedProbe answers[]; };
void main() {
    uint i = gl_GlobalInvocationID.x;
    if (i < uint(positions.length())) answers[i] = interpolate(locate(positions[i].xyz, 0xffffffffu));
}
)";

std::vector<PackedProbe> query_gpu(const ShaderVolume& volume,
                                   const std::vector<glm::vec3>& positions) {
    const auto source =
        compose_shader(ShaderLanguage::Glsl450, {ShaderPart::Query}, {"query.comp", kShader});
    const ShaderStage stage{GL_COMPUTE_SHADER, source};
    const auto program = ShaderProgram::create(std::span(&stage, 1));
    require(bool(program), program ? "" : program.error().message);
    std::vector<glm::vec4> inputs;
    for (const glm::vec3& position : positions) inputs.emplace_back(position, 0.0f);
    std::vector<PackedProbe> answers(positions.size());
    std::array<GLuint, 2> buffers{};
    glCreateBuffers(2, buffers.data());
    glNamedBufferStorage(buffers[0], static_cast<GLsizeiptr>(16 * inputs.size()), inputs.data(), 0);
    const auto size = static_cast<GLsizeiptr>(sizeof(PackedProbe) * answers.size());
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

/// The largest difference, as a share of the light.
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

}  // namespace

void bench_gpu_query() {
    const auto context = OffscreenContext::create();
    if (!context) {
        std::fprintf(stderr, "runtime.gpu_query_disagreements: %s\n",
                     context.error().message.c_str());
        return;
    }
    Subject subject = make_random_subject("20k", 20'000);
    const ProbeVolumeView view = subject.volume.view();
    const std::vector<glm::vec3> positions = subject.positions(kCount);
    // Half a batch each: OpenGL promises 128 MiB a buffer.
    const std::vector<glm::vec3> halves[] = {{positions.begin(), positions.begin() + kCount / 2},
                                             {positions.begin() + kCount / 2, positions.end()}};
    const ShaderVolume volume = make_shader_volume(view);
    constexpr double kTolerance = 1e-3;
    size_t disagreement_count = 0;
    double largest = 0.0;
    for (const std::vector<glm::vec3>& half : halves) {
        const std::vector<PackedProbe> answers = query_gpu(volume, half);
        for (size_t i = 0; i < half.size(); ++i) {
            const InterpolatedProbe cpu = interpolate(view, locate(view, half[i]));
            const double apart = difference(answers[i], {pack_sh(cpu.irradiance), cpu.occlusion});
            largest = std::max(largest, apart);
            disagreement_count += !(apart <= kTolerance);
        }
    }
    report("runtime.gpu_query_disagreements", static_cast<double>(disagreement_count),
           "of 1000000 beyond 0.001 of the light");
    report("runtime.gpu_query_difference", largest, "of the light, the largest");
}

}  // namespace tetralight::bench
