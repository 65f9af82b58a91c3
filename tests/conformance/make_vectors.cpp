// SPDX-License-Identifier: Apache-2.0
#include "tests/conformance/make_vectors.h"

#include <cstdint>
#include <span>
#include <utility>

#include <tetralight/probes/probe_file.h>
#include "tests/conformance/numbers.h"
#include "tests/conformance/settled_answer.h"
#include "tests/conformance/vector_json.h"
#include "tests/conformance/vector_positions.h"
#include "tests/conformance/vector_volumes.h"

namespace tetralight::conformance {
namespace {

/// Adds cases of one volume.
class CaseMaker {
  public:
    CaseMaker(const ProbeVolumeView& volume, uint64_t seed)
        : volume_(volume), largest_light_(largest_light(volume)), numbers_(seed) {}

    std::vector<VectorCase> cases;

    /// Answers all positions that are settled.
    void add(const VectorOptions& options, const std::vector<VectorPosition>& positions) {
        const ProbeVolume volume = volume_with_options(volume_, options);
        VectorCase made{options, {}};
        for (const VectorPosition& at : positions) {
            VectorAnswer answer = answer_vector(volume.view(), options, at);
            if (is_settled(volume.view(), options, answer, largest_light_)) {
                made.answers.push_back(std::move(answer));
            }
        }
        cases.push_back(std::move(made));
    }

    void add_everywhere(const VectorOptions& options) {
        add(options, make_vector_positions(volume_, numbers_));
    }

    void add_hidden(const VectorOptions& options, size_t count) {
        add(options, make_hidden_positions(volume_, count, numbers_));
    }

    void add_outside(const VectorOptions& options, size_t count) {
        add(options, make_outside_positions(volume_, count, numbers_));
    }

  private:
    const ProbeVolumeView& volume_;
    float largest_light_;
    Numbers numbers_;
};

void add_policies(CaseMaker& maker, size_t count) {
    VectorOptions options;
    options.outside.policy = OutsidePolicy::Clamp;
    maker.add_outside(options, count);
    options.outside = {OutsidePolicy::Ambient, 6.0f};
    maker.add_outside(options, count);
}

void add_receivers(CaseMaker& maker) {
    VectorOptions options;
    options.receiver.walls = Walls::Ignore;
    maker.add_hidden(options, 3);
    options.receiver = {Walls::HideProbes, 0b1, 0.0f};
    maker.add_hidden(options, 4);
    options.receiver = {Walls::HideProbes, 0b100, 0.5f};
    maker.add_hidden(options, 4);
    options.receiver = {Walls::HideProbes, kAllRenderingLayers, 0.5f};
    maker.add_hidden(options, 6);
    options.receiver = {};
    options.normal_offset = 0.1f;
    maker.add_hidden(options, 6);
}

void add_light(CaseMaker& maker) {
    VectorOptions options;
    options.precision = Precision::Full;
    maker.add_outside(options, 3);
    options.layer_weights = {0.0f, 3.0f, 0.25f};
    maker.add_outside(options, 3);
    options.precision = Precision::Half;
    maker.add_everywhere(options);
}

void add_cases(CaseMaker& maker, const VectorVolume& source) {
    maker.add_everywhere({});
    const bool is_flat = source.name == "line" || source.name == "plane";
    const bool has_walls = !source.volume.visibility_blocks.empty();
    if (has_walls) maker.add_hidden({}, is_flat ? 4 : 10);
    if (is_flat) add_policies(maker, 3);
    if (source.name == "space") add_policies(maker, 8);
    if (source.name == "walls") add_receivers(maker);
    if (source.name == "layers") add_light(maker);
}

std::vector<std::byte> bytes_of(const std::string& text) {
    const auto bytes = std::as_bytes(std::span(text));
    return {bytes.begin(), bytes.end()};
}

}  // namespace

std::vector<VectorFile> make_vector_files() {
    std::vector<VectorFile> files;
    uint64_t seed = 100;
    for (const VectorVolume& source : make_vector_volumes()) {
        const ProbeVolumeView volume = source.volume.view();
        CaseMaker maker(volume, ++seed);
        add_cases(maker, source);
        const VectorText vectors{source.name + ".probes", source.about, largest_light(volume),
                                 std::move(maker.cases)};
        files.push_back({vectors.volume, probe_file_bytes(volume)});
        files.push_back({source.name + ".json", bytes_of(write_vectors(vectors, volume))});
    }
    return files;
}

}  // namespace tetralight::conformance
