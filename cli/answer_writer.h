// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <vector>

#include <tetralight/base/file_writer.h>
#include <tetralight/base/result.h>
#include <tetralight/cli/answer.h>
#include <tetralight/cli/query_formats.h>
#include <tetralight/probes/locate.h>
#include <tetralight/probes/probe_volume.h>
#include <tetralight/probes/receiver.h>
#include <tetralight/probes/uniform_receiver.h>

namespace tetralight::cli {

struct AnswerSettings {
    AnswerFormat format = AnswerFormat::Text;
    OutsideHull outside;
    /// What is at every position.
    Receiver receiver;
    /// Of positions with normals: how far they are pushed (`InterpolationBatch`).
    float normal_offset = kNormalOffset;
    uint32_t thread_count = 0;  ///< 0 = all
};

/// Answers positions chunk by chunk, on many threads, and writes the answers in their order.
/// An answer depends on its position alone, not on those around it.
class AnswerWriter {
  public:
    /// Precondition: `out` outlives this object.
    AnswerWriter(const ProbeVolumeView& volume, const AnswerSettings& settings, FileWriter& out)
        : volume_(volume), settings_(settings), out_(out) {}

    /// Precondition: a unit normal for each position, or none.
    [[nodiscard]] Status write(std::span<const glm::vec3> positions,
                               std::span<const glm::vec3> normals = {});

    /// Ends the output. To be called once, after the last chunk.
    [[nodiscard]] Status finish();

    [[nodiscard]] uint64_t answer_count() const { return answer_count_; }

    /// Positions that are not finite, and were answered with ambient light.
    [[nodiscard]] uint64_t not_finite_count() const { return not_finite_count_; }

  private:
    /// What one call of one thread answers.
    struct Slice {
        std::vector<RawAnswer> answers;
        std::vector<uint32_t> cells;
        std::vector<CellLocation> locations;
        UniformReceiver receiver;
        std::string text;
        uint64_t not_finite_count = 0;
        Status status = Ok{};
    };

    [[nodiscard]] Status write_header();
    void answer(std::span<const glm::vec3> positions, std::span<const glm::vec3> normals,
                Slice& slice) const;
    void format(std::span<const glm::vec3> positions, Slice& slice) const;

    ProbeVolumeView volume_;
    AnswerSettings settings_;
    FileWriter& out_;
    std::vector<Slice> slices_;
    bool has_header_ = false;
    uint64_t answer_count_ = 0;
    uint64_t not_finite_count_ = 0;
};

}  // namespace tetralight::cli
