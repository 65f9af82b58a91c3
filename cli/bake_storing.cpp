// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/bake_storing.h>

#include <filesystem>

#include <tetralight/base/str_cat.h>
#include <tetralight/cli/failure.h>
#include <tetralight/cli/paths.h>
#include <tetralight/pipeline/bake_chunks.h>
#include <tetralight/pipeline/reuse_probes.h>
#include <tetralight/probes/probe_file.h>

namespace tetralight::cli {
namespace {

ProbeRange range_of(const std::optional<IndexRange>& probes, const PreparedBake& prepared) {
    const auto count = static_cast<uint32_t>(prepared.capture_positions.size());
    if (!probes) return {0, count};
    return {probes->begin, probes->end == IndexRange{}.end ? count : probes->end};
}

Error interrupted(const std::string& what) {
    note_checkpoint();
    return {ErrorCode::Cancelled, "interrupted; " + what};
}

}  // namespace

BakeStoring::BakeStoring(const Values& values)
    : output(values.text("output")),
      probes(index_range(values, "probes")),
      is_resumed(values.flag("resume")),
      chunk_folder(values.text("chunks")),
      reuse_path(values.text("reuse")),
      progress_file(values.text("progress_file")) {
    if (is_resumed && output == "-") refuse(values, "resume", "nothing is kept beside stdout");
    const std::string extension = std::filesystem::path(output).extension().string();
    if (extension == (probes ? ".probes" : ".part")) {
        refuse(values, "output",
               str_cat("with ", values.shown("probes"),
                       " a .part is written, without it .probes, not \"", output, "\""));
    }
}

/// Beside the output, if that is a file; empty: an interrupted bake is not kept.
std::string BakeStoring::kept_path() const {
    std::error_code error;
    if (!chunk_folder.empty() || !reuse_path.empty()) return "";
    const auto type = std::filesystem::status(output, error).type();
    const bool is_file = type == std::filesystem::file_type::regular ||
                         type == std::filesystem::file_type::not_found;
    return output == "-" || !is_file ? "" : output + ".part";
}

Status BakeStoring::check(const std::vector<std::string>& inputs,
                          const CommonOptions& common) const {
    const std::string path = kept_path();
    if (path.empty()) return Ok{};
    if (auto status = check_output(path, inputs); !status) {
        return status.error().in("an interrupted bake would be kept there");
    }
    std::error_code error;
    if (is_resumed || !std::filesystem::exists(path, error)) return Ok{};
    const auto file = open_probe_file_lazy(path);
    if (!file || !is_part(*file)) {
        return Error{ErrorCode::InvalidArgument, "output", output,
                     path +
                         ": is no interrupted bake and would be replaced by one; move it away, "
                         "or write elsewhere"};
    }
    common.warn({path +
                 ": this interrupted bake, which --resume can continue, is lost if this bake "
                 "is interrupted too"});
    return Ok{};
}

Status BakeStoring::reuse(PreparedBake& prepared, const CommonOptions& common) const {
    if (reuse_path.empty()) return Ok{};
    const auto old = open_probe_file(reuse_path);
    if (!old) return old.error();
    if (const Status status = reuse_probes(old->view(), prepared); !status) {
        common.warn(reuse_path + ": nothing is re-used: ", status.error(), "");
    }
    return Ok{};
}

Result<RangeBake> BakeStoring::bake(const Scene& scene, const PreparedBake& prepared,
                                    const BakeCallback& show) const {
    const BakeKeeping kept{kept_path(), is_resumed};
    const auto bake_all = [&](const PreparedBake& some) {
        return chunk_folder.empty() ? bake_range(scene, some, range_of(probes, some), kept, show)
                                    : bake_in_chunks(scene, some, chunk_folder, show);
    };
    auto baked = reuse_path.empty() ? bake_all(prepared) : bake_all(bake_of_others(prepared));
    if (baked && !reuse_path.empty()) baked->partial = spread_others(prepared, baked->partial);
    if (baked || baked.error().code != ErrorCode::Cancelled) return baked;
    if (!chunk_folder.empty()) return interrupted(chunk_folder + " keeps what is done");
    if (kept.path.empty()) return Error{ErrorCode::Cancelled, "interrupted"};
    return interrupted(kept.path + " keeps what is done, --resume goes on with it");
}

void BakeStoring::remove_kept(const RangeBake& baked) const {
    std::error_code error;
    if (baked.is_kept) std::filesystem::remove(kept_path(), error);
}

}  // namespace tetralight::cli
