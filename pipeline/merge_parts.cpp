// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/merge_parts.h>

#include <algorithm>
#include <optional>
#include <utility>

#include <tetralight/base/contract.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/pipeline/partial_bake.h>
#include <tetralight/pipeline/walls_metadata.h>

namespace tetralight {
namespace {

/// A part without its volume, which is the same in all parts.
struct Piece {
    std::string path;
    PartialBake partial;
};

std::string name(const ProbeRange& range) {
    return str_cat(range.begin, "..", range.end);
}

/// Returns invalid_argument for the first probes in no part or in two. `pieces` are sorted.
Status check_cover(const std::vector<Piece>& pieces, uint32_t probe_count) {
    uint32_t end = 0;
    for (size_t i = 0; i < pieces.size(); ++i) {
        const ProbeRange& range = pieces[i].partial.range;
        if (range.begin < end) {
            const Piece& before = pieces[i - 1];
            return Error{ErrorCode::InvalidArgument,
                         str_cat(pieces[i].path, ": probes ", name(range), " overlap probes ",
                                 name(before.partial.range), " of ", before.path)};
        }
        if (range.begin > end) {
            return Error{
                ErrorCode::InvalidArgument,
                str_cat("probes ", name({end, range.begin}), " of ", probe_count,
                        " are in no part; the next, ", name(range), ", are in ", pieces[i].path)};
        }
        end = range.end;
    }
    if (end < probe_count) {
        return Error{ErrorCode::InvalidArgument,
                     str_cat("probes ", name({end, probe_count}), " of ", probe_count,
                             " are in no part; the last, ", name(pieces.back().partial.range),
                             ", are in ", pieces.back().path)};
    }
    return Ok{};
}

Status check_part(const PartFile& part, const PreparedBake& bake, const std::string& first_path) {
    if (part.prepared.key != bake.key) {
        return Error{ErrorCode::InvalidArgument,
                     str_cat(part.path, ": is of another bake than ", first_path,
                             " (scene, groups, settings or program version differ)")};
    }
    return Ok{};
}

}  // namespace

Result<BakedVolume> merge_parts(const std::vector<std::string>& paths) {
    TETRALIGHT_ASSERT(!paths.empty(), "there is nothing to merge");
    std::optional<PreparedBake> bake;
    std::vector<Piece> pieces;
    for (const std::string& path : paths) {
        auto part = read_part(path);
        if (!part) return part.error();
        const PreparedBake& first = bake ? *bake : part->prepared;
        if (auto status = check_part(*part, first, paths[0]); !status) return status.error();
        if (!bake) bake = std::move(part->prepared);
        pieces.push_back({path, std::move(part->partial)});
    }
    std::ranges::stable_sort(pieces, {}, [](const Piece& piece) {
        return std::pair(piece.partial.range.begin, piece.partial.range.end);
    });
    const auto probe_count = static_cast<uint32_t>(bake->volume.positions.size());
    if (auto status = check_cover(pieces, probe_count); !status) return status.error();

    std::vector<ProbeAccumulator> accumulators;
    std::vector<double> rows;
    for (const Piece& piece : pieces) {
        const auto& some = piece.partial.accumulators;
        accumulators.insert(accumulators.end(), some.begin(), some.end());
        const auto& some_rows = piece.partial.split_rows;
        rows.insert(rows.end(), some_rows.begin(), some_rows.end());
        bake->reused.append(piece.partial.reused);
    }
    const ProbeVolume& volume = bake->volume;
    bake->report.visibility = stored_visibility(volume.view());
    if (const auto walls = read_walls(volume.metadata)) bake->report.unseen = walls->unseen;
    return finish_bake(std::move(*bake), accumulators, rows);
}

}  // namespace tetralight
