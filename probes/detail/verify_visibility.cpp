// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/detail/verify_visibility.h>

#include <bit>
#include <string>

#include <tetralight/base/str_cat.h>
#include <tetralight/probes/edge_visibility.h>
#include <tetralight/probes/section_error.h>

namespace tetralight::detail {
namespace {

constexpr const char* kBlocks = "visibility_blocks";
constexpr const char* kElements = "cell_visibility";

/// What is wrong with the splits of a cell. Empty: nothing.
std::string splits_problem(const CellVisibility& cell) {
    uint32_t possible = 0;
    for_each_blocked_pair(
        cell, [&](size_t from, size_t a, size_t b) { possible |= split_bit(from, a, b); });
    return (split_bits(cell) & ~possible) == 0 ? "" : "splits edges that are not blocked";
}

/// What is wrong with the codes of a cell with so many vertices. Empty: nothing.
std::string codes_problem(const CellVisibility& cell, size_t vertex_count) {
    bool is_stored = false;
    for (size_t from = 0; from < 4; ++from) {
        for (size_t to = 0; to < 4; ++to) {
            if (from == to) continue;
            const uint8_t code = cell.codes[edge_place(from, to)];
            const bool is_edge = from < vertex_count && to < vertex_count;
            if (!is_edge && code != 0) return "has a code for an edge that does not exist";
            is_stored |= code >= kUnknownEdge;
        }
    }
    return is_stored ? splits_problem(cell) : "has free edges only";
}

size_t vertex_count(const VolumeInfo& info, size_t cell) {
    return static_cast<size_t>(cell_vertex_count(info.dimension)) -
           (cell < info.inner_cell_count ? 0 : 1);
}

/// Checks the cells of one block, whose first element is `element`, and moves `element` on.
Status check_block(const ProbeVolumeView& volume, size_t block_index, size_t& element) {
    const VisibilityBlock& block = volume.visibility_blocks[block_index];
    if (block.first != element) {
        return element_error(kBlocks, block_index,
                             str_cat("begins at ", block.first, " instead of ", element));
    }
    for (uint32_t marked = block.cells; marked != 0; marked &= marked - 1, ++element) {
        const size_t cell = 32 * block_index + static_cast<size_t>(std::countr_zero(marked));
        if (cell >= volume.cells.size()) {
            return element_error(kBlocks, block_index, "marks a cell that does not exist");
        }
        if (element >= volume.cell_visibility.size()) {
            return section_error(kElements, str_cat(element, " elements are too few"));
        }
        const auto problem =
            codes_problem(volume.cell_visibility[element], vertex_count(volume.info, cell));
        if (!problem.empty()) return element_error(kElements, element, problem);
    }
    return Ok{};
}

}  // namespace

Status check_visibility(const ProbeVolumeView& volume) {
    if (volume.visibility_blocks.empty() && volume.cell_visibility.empty()) return Ok{};
    const size_t count = (volume.cells.size() + 31) / 32;
    if (volume.visibility_blocks.size() != count) {
        return section_error(
            kBlocks, str_cat(volume.visibility_blocks.size(), " elements instead of ", count));
    }
    size_t element = 0;
    for (size_t block = 0; block < count; ++block) {
        if (auto status = check_block(volume, block, element); !status) return status;
    }
    if (element == volume.cell_visibility.size()) return Ok{};
    return section_error(kElements,
                         str_cat(volume.cell_visibility.size(), " elements instead of ", element));
}

}  // namespace tetralight::detail
