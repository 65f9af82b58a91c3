// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/answer_writer.h>

#include <algorithm>
#include <cfenv>
#include <cstddef>

#include <tetralight/bake/parallel.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/probes/interpolate.h>

namespace tetralight::cli {
namespace {

/// Enough for some hundred microseconds, and answers that stay in the cache until they are written.
constexpr size_t kSliceSize = 2048;

std::span<const std::byte> bytes_of(const std::string& text) {
    return std::as_bytes(std::span(text));
}

}  // namespace

Status AnswerWriter::write_header() {
    if (has_header_ || settings_.format != AnswerFormat::Csv) return Ok{};
    has_header_ = true;
    return out_.write(bytes_of(csv_header()));
}

void AnswerWriter::answer(std::span<const glm::vec3> positions, std::span<const glm::vec3> normals,
                          Slice& slice) const {
    slice.answers.resize(positions.size());
    slice.locations.resize(positions.size());
    // Hints that name no cell: each walk begins at the seed of its own position.
    slice.cells.assign(positions.size(), kNoIndex);
    const std::span<std::byte> memory = std::as_writable_bytes(std::span(slice.answers));
    InterpolationBatch batch;
    batch.positions = positions;
    batch.hints = slice.cells;
    batch.irradiance = strided(memory, ShFormat::Coefficients, sizeof(RawAnswer));
    batch.occlusion =
        strided_occlusion(memory.subspan(offsetof(RawAnswer, occlusion)), sizeof(RawAnswer));
    batch.outside = settings_.outside;
    slice.receiver.set(settings_.receiver, batch);
    batch.normals = normals;
    batch.normal_offset = settings_.normal_offset;
    // Raw answers and CSV have no weights.
    const bool has_weights =
        settings_.format == AnswerFormat::Text || settings_.format == AnswerFormat::JsonLines;
    if (has_weights) batch.locations = slice.locations;
    const auto report = interpolate(volume_, batch);
    slice.status = report ? Status(Ok{}) : Status(report.error());
    if (has_weights) hide_probes(volume_, slice.locations, settings_.receiver);
    slice.not_finite_count = report ? report->not_finite_count : 0;
    for (size_t i = 0; i < positions.size(); ++i) slice.answers[i].cell = slice.cells[i];
}

/// Opens what answers these positions, and closes the rest.
Status AnswerWriter::open_tiles(std::span<const glm::vec3> positions) {
    std::vector<uint32_t> needed = tiles_of(world_->index(), positions);
    const auto outside = static_cast<uint32_t>(world_->index().tiles.size() - 1);
    if (settings_.outside.policy != OutsidePolicy::Extrapolate) needed.push_back(outside);
    const WorldMove move = world_->open_only(needed);
    if (!move.failures.empty()) return move.failures[0];
    tiles_ = world_->tiles();
    for (const uint32_t tile : needed) {
        const ProbeVolumeView& view = tiles_->find(tile)->view();
        if (tiles_->volume_cells(tile).size() == view.cells.size() &&
            tiles_->volume_probes(tile).size() == view.positions.size()) {
            continue;
        }
        return Error{ErrorCode::Corrupt, std::string(kWorldCellsSection), "",
                     str_cat("tile ", tile, " does not say which cells and probes it holds")};
    }
    return Ok{};
}

void AnswerWriter::answer_in_world(std::span<const glm::vec3> positions, Slice& slice) const {
    const size_t count = positions.size();
    slice.answers.resize(count);
    slice.locations.resize(count);
    slice.irradiance.resize(count);
    slice.occlusion.resize(count);
    slice.world_locations.resize(count);
    slice.shown_cells.resize(count);
    const auto report = interpolate(*tiles_, {.positions = positions,
                                              .irradiance = slice.irradiance,
                                              .occlusion = slice.occlusion,
                                              .locations = slice.world_locations,
                                              .outside = settings_.outside,
                                              .receiver = settings_.receiver,
                                              .precision = precision_});
    slice.status = report ? Status(Ok{}) : Status(report.error());
    slice.not_finite_count = report ? report->not_finite_count : 0;
    slice.lost_count = report ? report->lost_count : 0;
    for (size_t i = 0; i < count; ++i) name_as_in_volume(i, slice);
}

/// Cell and probes of an answer by their indices in the volume that was cut.
void AnswerWriter::name_as_in_volume(size_t query, Slice& slice) const {
    const auto& [tile, found] = slice.world_locations[query];
    CellLocation& location = slice.locations[query];
    location = found;
    if (found.cell != kNoIndex) {
        const ProbeVolumeView& view = tiles_->find(tile)->view();
        location = visible_location(view, found, settings_.receiver);
        location.cell = tiles_->volume_cells(tile)[found.cell];
        Cell& shown = slice.shown_cells[query];
        shown = view.cells[found.cell];
        const auto probes = tiles_->volume_probes(tile);
        for (uint32_t& vertex : shown.vertices) {
            if (vertex < probes.size()) vertex = probes[vertex];
        }
    }
    slice.answers[query] = {slice.irradiance[query], slice.occlusion[query], location.cell};
}

AnswerCell AnswerWriter::shown_cell(const Slice& slice, size_t query) const {
    const uint32_t cell = slice.locations[query].cell;
    if (world_ == nullptr) return answer_cell(volume_, cell);
    if (cell == kNoIndex) return {};
    const bool is_hull_cell = cell >= world_->index().info.inner_cell_count;
    return {&slice.shown_cells[query], is_hull_cell, Dimension::Space};
}

void AnswerWriter::format(std::span<const glm::vec3> positions, Slice& slice) const {
    slice.text.clear();
    if (settings_.format == AnswerFormat::Raw) return;
    for (size_t i = 0; i < positions.size(); ++i) {
        const RawAnswer& answer = slice.answers[i];
        if (settings_.format == AnswerFormat::Csv) {
            append_csv(slice.text, positions[i], answer);
            continue;
        }
        const auto append = settings_.format == AnswerFormat::JsonLines ? append_json : append_text;
        append(slice.text, positions[i], slice.locations[i], answer, shown_cell(slice, i));
    }
}

Status AnswerWriter::write(std::span<const glm::vec3> positions,
                           std::span<const glm::vec3> normals) {
    const size_t slice_count = (positions.size() + kSliceSize - 1) / kSliceSize;
    slices_.resize(std::max(slices_.size(), slice_count));
    if (world_ != nullptr) {
        if (auto status = open_tiles(positions); !status) return status;
    }
    parallel_for(slice_count, settings_.thread_count, [&](size_t i) {
        std::fesetenv(FE_DFL_ENV);  // denormal numbers count, as in a query of the library
        const size_t begin = i * kSliceSize;
        const size_t count = std::min(kSliceSize, positions.size() - begin);
        const auto part = positions.subspan(begin, count);
        if (world_ != nullptr) {
            answer_in_world(part, slices_[i]);
        } else {
            answer(part, normals.empty() ? normals : normals.subspan(begin, count), slices_[i]);
        }
        format(part, slices_[i]);
    });
    if (auto status = write_header(); !status) return status;
    for (const Slice& slice : std::span(slices_).first(slice_count)) {
        if (!slice.status) return slice.status;
        auto status = out_.write(settings_.format == AnswerFormat::Raw
                                     ? std::as_bytes(std::span(slice.answers))
                                     : bytes_of(slice.text));
        if (!status) return status;
        not_finite_count_ += slice.not_finite_count;
        lost_count_ += slice.lost_count;
    }
    answer_count_ += positions.size();
    return Ok{};
}

Status AnswerWriter::finish() {
    if (auto status = write_header(); !status) return status;
    return out_.commit();
}

}  // namespace tetralight::cli
