// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include <tetralight/probes/detail/query_kernels.h>
#include <tetralight/probes/detail/tetrahedron_test.h>
#include <tetralight/probes/interpolate.h>

namespace tetralight::detail {

/// Locates many positions, a block at a time:
///
///     BatchQueries queries(volume, {positions, hints, order, outside}, query_kernels());
///     while (queries.locate_block()) ... // queries.locations(), queries.source()
///
/// Each answer is that of `walk_one`, to the bit. A block takes about 60 KiB of the stack.
class BatchQueries {
  public:
    enum class Unresolved : uint8_t {
        Walk,
        KeepCell,  ///< the location names the cell that the query reached, without weights
    };

    struct Input {
        std::span<const glm::vec3> positions;
        /// As in `InterpolationBatch`; written to when a block is located.
        std::span<uint32_t> hints;
        /// Low 32 bits: the index of the position to answer next. Empty: in the order of
        /// `positions`.
        std::span<const uint64_t> order;
        OutsideHull outside;
        /// Tests of a query in passes. What is left then walks on alone, or stays where it is.
        uint32_t pass_limit = kPassLimit;
        Unresolved unresolved = Unresolved::Walk;
    };

    BatchQueries(const ProbeVolumeView& volume, const Input& input, const QueryKernels& kernels);

    /// Locates the next block. False if all positions are located.
    [[nodiscard]] bool locate_block();

    [[nodiscard]] std::span<const CellLocation> locations() const {
        return std::span(block_.location).first(block_.count);
    }

    /// For each query of the block the index of its position.
    [[nodiscard]] std::span<const uint32_t> source() const {
        return std::span(source_).first(block_.count);
    }

    [[nodiscard]] const BatchReport& report() const { return report_; }

  private:
    void load_positions();
    void place();
    void find_starts();
    void begin_walks();
    void fetch_corners() const;
    void walk();
    void resolve_doubtful();
    void apply_policy();
    void write_hints();
    [[nodiscard]] uint32_t seed_of(size_t query) const;

    [[nodiscard]] const glm::vec3& position_of(size_t query) const {
        return input_.positions[source_[query]];
    }

    const ProbeVolumeView& volume_;
    Input input_;
    const QueryKernels& kernels_;
    bool has_tetrahedra_;
    size_t done_ = 0;
    BatchReport report_;
    QueryBlock block_;
    std::array<uint32_t, kBlockSize> source_;
    /// Positions of the block, where those of the input are in another order.
    BlockArray<glm::vec3> position_;
};

/// Answers a checked batch.
[[nodiscard]] BatchReport answer(const ProbeVolumeView& volume, const InterpolationBatch& batch,
                                 const QueryKernels& kernels = query_kernels());

}  // namespace tetralight::detail
