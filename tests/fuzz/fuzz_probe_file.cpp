// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <vector>

#include <tetralight/base/error_text.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/probes/build/validate.h>
#include <tetralight/probes/compact_probes.h>
#include <tetralight/probes/detail/probe_file_layout.h>
#include <tetralight/probes/interpolate.h>
#include <tetralight/probes/is_finite.h>
#include <tetralight/probes/probe_file.h>
#include <tetralight/probes/recombine.h>
#include "tests/fuzz/mutator.h"
#include "tests/fuzz/targets.h"
#include "tests/support/layered_volume.h"
#include "tests/support/temp_folder.h"

namespace tetralight::fuzz {
namespace {

/// Tetrahedra with layers and lights, triangles, segments, one probe.
ProbeVolume make_volume(size_t kind) {
    if (kind == 0) {
        ProbeVolume volume = test::make_layered_volume(24, 3, 7);
        volume.lights.resize(2);
        volume.light_names = "sun\nlamp\n";
        volume.light_states.resize(2);
        volume.occlusion_lights.assign(24, {0, 1, kNoIndex, kNoIndex});
        volume.occlusion.assign(24, glm::vec4(0.5f));
        volume.validity.assign(24, 1.0f);
        volume.health.resize(24);
        make_compact_probes(volume);
        return volume;
    }
    std::vector<glm::dvec3> positions = test::random_positions(kind == 3 ? 1 : 12, kind);
    for (glm::dvec3& p : positions) {
        p.y = 0.0;
        if (kind == 2) p.z = 0.0;
    }
    return test::make_lit_volume(positions);
}

const std::vector<std::byte>& sound_file(size_t kind) {
    static const auto files = [] {
        std::array<std::vector<std::byte>, 4> all;
        for (size_t k = 0; k < all.size(); ++k) all[k] = probe_file_bytes(make_volume(k).view());
        return all;
    }();
    return files[kind];
}

/// Changes bytes of sections, not of the layout; makes all checksums right.
std::vector<std::byte> changed_file(Mutator& mutator) {
    std::vector<std::byte> bytes = sound_file(mutator.below(4));
    detail::FileHeader header;
    std::memcpy(&header, bytes.data(), sizeof header);
    std::vector<detail::SectionEntry> table(header.section_count);
    std::memcpy(table.data(), bytes.data() + sizeof header, table.size() * sizeof table[0]);
    for (size_t change = mutator.below(3) + 1; change > 0; --change) {
        detail::SectionEntry& entry = table[mutator.below(table.size())];
        const auto section = std::span(bytes).subspan(entry.offset, entry.size());
        mutator.change_bytes(section);
        entry.checksum = detail::checksum(section);
    }
    std::memcpy(bytes.data() + sizeof header, table.data(), table.size() * sizeof table[0]);
    header.checksum = detail::header_checksum(header, table);
    std::memcpy(bytes.data(), &header, sizeof header);
    return bytes;
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

}  // namespace

std::string fuzz_probe_file(uint64_t seed) {
    static const TempFolder folder;
    Mutator mutator(seed);
    const auto file = open_probe_file_lazy(folder.write("a.probes", changed_file(mutator)));
    if (!file) return {};
    const bool is_verified = static_cast<bool>(verify(*file));
    const bool is_valid = is_verified && validate(file->view()).problems().empty();
    std::string problem = query_all(file->view(), is_valid);
    if (problem.empty() && is_valid) problem = query_all(file->view().without_compact(), true);
    if (problem.empty() && is_verified && !file->view().layers.empty()) {
        problem = relight(file->view());
    }
    return problem;
}

}  // namespace tetralight::fuzz
