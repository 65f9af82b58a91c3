// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include <tetralight/probes/detail/query_kernels.h>
#include <tetralight/probes/interpolate.h>

namespace tetralight::detail {

/// Locates many positions, a block at a time:
///
///     BatchQueries queries(volume, positions, hints, outside, order, query_kernels());
///     while (queries.locate_block()) ... // queries.block().location, queries.source()
class BatchQueries {
  public:
    struct Input {
        std::span<const glm::vec3> positions;
        /// As in `InterpolationBatch`; written to when a block is located.
        std::span<uint32_t> hints;
        /// Low 32 bits: the index of the position to answer next. Empty: in the order of
        /// `positions`.
        std::span<const uint64_t> order;
        OutsideHull outside;
    };

    BatchQueries(const ProbeVolumeView& volume, const Input& input, const QueryKernels& kernels);

    /// Locates the next block. False if all positions are located.
    [[nodiscard]] bool locate_block();

    [[nodiscard]] const QueryBlock& block() const { return block_; }

    /// For each query of the block the index of its position.
    [[nodiscard]] std::span<const uint32_t> source() const { return source_; }

    [[nodiscard]] const BatchReport& report() const { return report_; }

  private:
    void fill();
    void fill_query(size_t query, size_t index);
    void choose_starts(size_t stream);
    void prefetch_starts() const;
    void walk();
    void resolve_remaining();
    void apply_policy();
    [[nodiscard]] bool has_tetrahedra() const;
    [[nodiscard]] uint32_t start_near(uint32_t cell) const;
    [[nodiscard]] double square_reach(uint32_t cell) const;

    const ProbeVolumeView& volume_;
    Input input_;
    const QueryKernels& kernels_;
    size_t stream_length_;
    size_t done_ = 0;                                          ///< of each stream
    std::array<glm::dvec3, QueryBlock::kStreamCount> last_{};  ///< position of each stream
    BatchReport report_;
    QueryBlock block_;
    std::array<uint32_t, QueryBlock::kSize> source_;
    std::array<uint32_t, QueryBlock::kSize> not_finite_;
    size_t not_finite_count_ = 0;
};

/// Answers positions [begin, begin + count) of a checked batch.
[[nodiscard]] BatchReport answer(const ProbeVolumeView& volume, const InterpolationBatch& batch,
                                 size_t begin, size_t count,
                                 const QueryKernels& kernels = query_kernels());

}  // namespace tetralight::detail
