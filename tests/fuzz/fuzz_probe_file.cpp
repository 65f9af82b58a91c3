// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <vector>

#include <tetralight/base/error_text.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/probes/build/validate.h>
#include <tetralight/probes/interpolate.h>
#include <tetralight/probes/is_finite.h>
#include <tetralight/probes/probe_file.h>
#include <tetralight/probes/recombine.h>
#include "tests/fuzz/mutator.h"
#include "tests/fuzz/sound_file.h"
#include "tests/fuzz/targets.h"
#include "tests/support/layered_volume.h"
#include "tests/support/temp_folder.h"

namespace tetralight::fuzz {
namespace {

/// Changes bytes of sections, not of the layout; makes all checksums right.
std::vector<std::byte> changed_file(Mutator& mutator) {
    SoundFile file(mutator.below(kVolumeKinds));
    for (size_t change = mutator.below(3) + 1; change > 0; --change) {
        mutator.change_bytes(file.section(mutator.below(file.section_count())));
    }
    return file.finish();
}

std::vector<glm::vec3> query_positions() {
    std::vector<glm::vec3> positions{glm::vec3(0.0f), glm::vec3(1e18f), glm::vec3(-3e38f, 0, 0)};
    for (const glm::dvec3& p : test::random_positions(29, 3, 3.0)) positions.emplace_back(p);
    return positions;
}

/// The largest |coefficient| that an answer may have: answers are weighted means.
float largest_light(const ProbeVolumeView& volume) {
    return std::max(largest_coefficient(volume.irradiance),
                    largest_coefficient(std::span(&volume.info.ambient, 1)));
}

std::string problem_of(const CellLocation& location, const InterpolatedProbe& answer,
                       float largest) {
    const glm::vec4& w = location.weights;
    const float sum = location.ambient + w.x + w.y + w.z + w.w;
    if (!(std::abs(sum - 1.0f) < 1e-3f)) return str_cat("the weights have the sum ", sum);
    if (!(std::min({w.x, w.y, w.z, w.w, location.ambient}) >= 0.0f)) return "a weight is negative";
    if (!is_finite(answer.irradiance)) return "the light is not finite";
    const float found = largest_coefficient(std::span(&answer.irradiance, 1));
    if (found > largest * 1.001f) return str_cat("light of ", found, " from at most ", largest);
    return {};
}

/// Queries of one position and of a batch. The answers count only if `is_valid`.
std::string query_all(const ProbeVolumeView& volume, bool is_valid) {
    const std::vector<glm::vec3> positions = query_positions();
    const float largest = is_valid ? largest_light(volume) : 0.0f;
    for (const glm::vec3& position : positions) {
        const CellLocation location = locate(volume, position);
        const InterpolatedProbe answer = interpolate(volume, location);
        if (!is_valid) continue;
        const std::string problem = problem_of(location, answer, largest);
        if (!problem.empty())
            return str_cat("at ", position.x, ", ", position.y, ", ", position.z, ": ", problem);
    }
    std::vector<IrradianceSh> light(positions.size());
    std::vector<uint64_t> memory(2 * positions.size());
    const auto report =
        interpolate(volume, {.positions = positions, .irradiance = light, .sort_memory = memory});
    if (!report) return "the batch was refused";
    const auto finite = [](const IrradianceSh& sh) { return is_finite(sh); };
    if (is_valid && !std::ranges::all_of(light, finite)) return "light of a batch is not finite";
    return {};
}

/// What passes `verify` can be relit, and then passes it again.
std::string relight(const ProbeVolumeView& volume) {
    ProbeVolume copy = copy_volume(volume);
    const std::vector<float> weights(volume.layers.size(), 2.0f);
    if (!recombine(copy, weights)) return {};
    const Status status = verify(copy.view());
    return status ? "" : "relit: " + error_text(status.error());
}

/// What is wrong with how a file is taken, and whether it is taken for valid.
struct Verdict {
    std::string problem;
    bool is_valid = false;
};

Verdict judge(std::span<const std::byte> bytes) {
    static const TempFolder folder;
    const auto file = open_probe_file_lazy(folder.write("a.probes", bytes));
    if (!file) return {};
    const bool is_verified = static_cast<bool>(verify(*file));
    const bool is_valid = is_verified && validate(file->view()).problems().empty();
    std::string problem = query_all(file->view(), is_valid);
    if (problem.empty() && is_valid) problem = query_all(file->view().without_compact(), true);
    if (problem.empty() && is_verified && !file->view().layers.empty()) {
        problem = relight(file->view());
    }
    return {problem, is_valid};
}

}  // namespace

std::string fuzz_probe_file(uint64_t seed) {
    Mutator mutator(seed);
    return judge(changed_file(mutator)).problem;
}

std::string replay_probe_file(const std::string& path) {
    const Verdict verdict = judge(file_of_changes(path));
    return verdict.problem.empty() && verdict.is_valid ? "is taken for valid" : verdict.problem;
}

}  // namespace tetralight::fuzz
