// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
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
#include <tetralight/probes/world_query.h>

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

    /// Answers from the tiles of a world, which are opened as positions need them. Cells and probes
    /// are those of the volume that was cut. Precondition: `world` and `out` outlive this object.
    AnswerWriter(World& world, WorldBatch::Precision precision, const AnswerSettings& settings,
                 FileWriter& out)
        : settings_(settings), out_(out), world_(&world), precision_(precision) {}

    /// Precondition: a unit normal for each position, or none; none for a world.
    [[nodiscard]] Status write(std::span<const glm::vec3> positions,
                               std::span<const glm::vec3> normals = {});

    /// Ends the output. To be called once, after the last chunk.
    [[nodiscard]] Status finish();

    [[nodiscard]] uint64_t answer_count() const { return answer_count_; }

    /// Positions that are not finite, and were answered with ambient light.
    [[nodiscard]] uint64_t not_finite_count() const { return not_finite_count_; }

    /// Positions that their tile could not answer (`WorldState::Lost`): they got ambient light.
    [[nodiscard]] uint64_t lost_count() const { return lost_count_; }

  private:
    /// What one call of one thread answers.
    struct Slice {
        std::vector<RawAnswer> answers;
        std::vector<uint32_t> cells;
        std::vector<CellLocation> locations;
        UniformReceiver receiver;
        std::string text;
        uint64_t not_finite_count = 0;
        uint64_t lost_count = 0;
        Status status = Ok{};
        // Of worlds.
        std::vector<IrradianceSh> irradiance;
        std::vector<glm::vec4> occlusion;
        std::vector<WorldLocation> world_locations;
        std::vector<Cell> shown_cells;
    };

    [[nodiscard]] Status write_header();
    void answer(std::span<const glm::vec3> positions, std::span<const glm::vec3> normals,
                Slice& slice) const;
    [[nodiscard]] Status open_tiles(std::span<const glm::vec3> positions);
    void answer_in_world(std::span<const glm::vec3> positions, Slice& slice) const;
    void name_as_in_volume(size_t query, Slice& slice) const;
    [[nodiscard]] AnswerCell shown_cell(const Slice& slice, size_t query) const;
    void format(std::span<const glm::vec3> positions, Slice& slice) const;

    ProbeVolumeView volume_;
    AnswerSettings settings_;
    FileWriter& out_;
    World* world_ = nullptr;
    WorldBatch::Precision precision_ = WorldBatch::Precision::Full;
    std::shared_ptr<const WorldTiles> tiles_;
    std::vector<Slice> slices_;
    bool has_header_ = false;
    uint64_t answer_count_ = 0;
    uint64_t not_finite_count_ = 0;
    uint64_t lost_count_ = 0;
};

}  // namespace tetralight::cli
