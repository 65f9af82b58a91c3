// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/programs/tetrahedralize_with_program.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

#include <tetralight/base/process/process.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/probes/build/check_tetrahedra.h>
#include <tetralight/probes/programs/stream.h>

namespace tetralight {
namespace {

using programs::StreamHeader;
using programs::StreamTetrahedron;

using Bytes = std::span<const std::byte>;

static_assert(sizeof(glm::dvec3) == 3 * sizeof(double));
static_assert(sizeof(Cell) == sizeof(StreamTetrahedron) && programs::kStreamNoNeighbor == kNoIndex);

/// The header of the output. Precondition: it is long enough.
StreamHeader header_of(Bytes output) {
    StreamHeader header;
    std::memcpy(&header, output.data(), sizeof header);
    return header;
}

/// Returns corrupt if output that begins like this cannot hold tetrahedra of so many positions.
Status check_output(Bytes output, uint64_t position_count) {
    const size_t magic_size = std::min(output.size(), programs::kTetrahedraMagic.size());
    if (std::memcmp(output.data(), programs::kTetrahedraMagic.data(), magic_size) != 0) {
        return Error{ErrorCode::Corrupt, "its output has an unknown format or version"};
    }
    if (output.size() < sizeof(StreamHeader)) return Ok{};
    const uint64_t count = header_of(output).count;
    const uint64_t limit = position_count * (position_count - 3) / 2;  // of any tetrahedralization
    if (count > std::min<uint64_t>(limit, kNoIndex / 4)) {
        return Error{ErrorCode::Corrupt,
                     str_cat("its output has ", count, " tetrahedra over ", position_count,
                             " probes: more than there can be")};
    }
    if (output.size() <= sizeof(StreamHeader) + count * sizeof(StreamTetrahedron)) return Ok{};
    return Error{ErrorCode::Corrupt,
                 str_cat("its output is longer than its ", count, " tetrahedra")};
}

Result<std::vector<Cell>> cells_of(Bytes output) {
    if (output.size() < sizeof(StreamHeader)) {
        return Error{ErrorCode::Corrupt,
                     str_cat("its output ends after ", output.size(), " bytes")};
    }
    const uint64_t count = header_of(output).count;
    const Bytes payload = output.subspan(sizeof(StreamHeader));
    if (payload.size() != count * sizeof(Cell)) {
        return Error{ErrorCode::Corrupt,
                     str_cat("its output ends after ", payload.size() / sizeof(Cell), " of ", count,
                             " tetrahedra")};
    }
    std::vector<Cell> cells(count);
    if (count > 0) std::memcpy(cells.data(), payload.data(), payload.size());
    return cells;
}

/// Why the program gave no output, with its own last words.
Error failure_of(const ProcessCommand& command, const ProcessResult& result) {
    const std::string prefix = command.name() + ": ";
    if (result.end == ProcessResult::End::TimedOut) {
        const std::chrono::duration<double> limit = command.time_limit;
        return {ErrorCode::OutOfResources,
                str_cat(prefix, "did not end within ", limit.count(), " s")};
    }
    std::string line = result.last_error_line();
    if (line.starts_with(prefix)) line.erase(0, prefix.size());
    if (!line.empty()) line.insert(0, ": ");
    return {ErrorCode::Unsupported, prefix + result.failure() + line};
}

}  // namespace

Result<Tetrahedralization> tetrahedralize_with_program(std::span<const glm::dvec3> positions,
                                                       double flatness,
                                                       const TetrahedraProgram& program) {
    auto ours = tetrahedralize(positions, flatness);
    if (ours.dimension != Dimension::Space) return ours;

    const StreamHeader header{programs::kPositionsMagic, positions.size()};
    const std::array<Bytes, 2> input{std::as_bytes(std::span(&header, 1)),
                                     std::as_bytes(positions)};
    const ProcessCommand command{
        .program = program.path,
        .input = input,
        .time_limit = program.time_limit,
        .error_limit = 4096,
        .check_output = [&](Bytes output) { return check_output(output, positions.size()); }};
    const auto process = run_process(command);
    if (!process) return process.error();
    if (!process->succeeded()) return failure_of(command, *process);
    auto cells = cells_of(process->output);
    if (!cells) return cells.error().in(command.name());
    auto result = check_tetrahedra(std::move(*cells), positions);
    if (!result) return result.error().in(command.name());
    return result;
}

}  // namespace tetralight
