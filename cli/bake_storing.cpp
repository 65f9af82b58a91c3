// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/bake_storing.h>

#include <filesystem>
#include <string_view>

#include <tetralight/base/str_cat.h>
#include <tetralight/cli/failure.h>
#include <tetralight/cli/paths.h>
#include <tetralight/pipeline/reuse_probes.h>
#include <tetralight/probes/probe_file.h>

namespace tetralight::cli {
namespace {

/// Seconds between two saves with `chunks`; more if saving takes long.
constexpr double kFrequentSaves = 0.1;

/// The setting for the range of a bake of probes or of texels; empty: it has none.
const char* range_setting(const Values& values) {
    for (const char* setting : {"texels", "probes"}) {
        if (has_setting(values, setting)) return setting;
    }
    return "";
}

/// Refuses a name that is not that of a part for a part, and that of a part for all.
void check_extension(const Values& values, const std::string& output, bool is_part) {
    const std::string extension = std::filesystem::path(output).extension().string();
    const std::string setting = range_setting(values);
    const std::string whole = setting == "texels" ? ".lightmaps" : ".probes";
    if (setting.empty() || extension != (is_part ? whole : ".part")) return;
    refuse(values, "output",
           str_cat("with ", values.shown(setting), " a .part is written, without it ", whole,
                   ", not \"", output, "\""));
}

}  // namespace

BakeStoring::BakeStoring(const Values& values)
    : progress_file(values.text("progress_file")),
      range_setting_(range_setting(values)),
      output_(values.text("output")),
      is_resumed_(values.flag("resume")),
      chunk_folder_(values.text("chunks")),
      cache_folder_(has_setting(values, "cache") ? values.text("cache") : ""),
      store_folder_(values.text("store")),
      store_limit_(values.number("store_limit")),
      reuse_path_(has_setting(values, "reuse") ? values.text("reuse") : "") {
    if (is_resumed_ && output_ == "-") refuse(values, "resume", "nothing is kept beside stdout");
    if (*range_setting_ != '\0') {
        range = place_range(values, range_setting_);
        range_option_ = values.shown(range_setting_);
    }
    check_extension(values, output_, range.has_value());
}

Result<PlaceRange> BakeStoring::range_of(size_t count) const {
    const auto all = static_cast<uint32_t>(count);
    if (!range) return PlaceRange{0, all};
    const bool has_end = range->end != kLastPlace;
    const PlaceRange asked{range->begin, has_end ? range->end : all, range->step};
    if (asked.begin <= asked.end && asked.end <= all) return asked;
    const std::string text = has_end ? name_of(asked) : str_cat(asked.begin, "..");
    return Error{ErrorCode::InvalidArgument, range_setting_, text,
                 str_cat(range_option_, ": ", text, " is not within the ", count, " ",
                         range_setting_, " that are baked, 0..", count)};
}

/// Empty if the output is not a regular file: an interrupted bake is not kept.
std::string BakeStoring::path_beside() const {
    std::error_code error;
    const auto type = std::filesystem::status(output_, error).type();
    const bool is_file = type == std::filesystem::file_type::regular ||
                         type == std::filesystem::file_type::not_found;
    return output_ == "-" || !is_file ? "" : output_ + ".store";
}

Status BakeStoring::check_progress_file(std::vector<std::string> inputs) const {
    if (progress_file.empty()) return Ok{};
    for (const std::string& other : {output_, path_beside(), reuse_path_}) inputs.push_back(other);
    return check_side_file(progress_file, inputs, "progress_file");
}

Status BakeStoring::open() {
    const std::string shared = chunk_folder_.empty() ? store_folder_ : chunk_folder_;
    if (!shared.empty()) {
        auto store = BakeStore::open(shared);
        if (!store) return store.error();
        shared_ = std::move(*store);
    }
    if (!cache_folder_.empty()) {
        auto store = BakeStore::open(cache_folder_);
        if (!store) return store.error();
        cache_ = std::move(*store);
    }
    const std::string beside = path_beside();
    if (beside.empty() || (shared_ && !is_resumed_)) return Ok{};
    auto store = BakeStore::open(beside);
    if (!store) return store.error();
    has_old_entries_ = !store->is_empty();
    beside_ = std::move(*store);
    return Ok{};
}

Status BakeStoring::reuse(PreparedBake& prepared, const CommonOptions& common) const {
    if (reuse_path_.empty()) return Ok{};
    const auto old = open_probe_file(reuse_path_);
    if (!old) return old.error();
    if (const Status status = reuse_probes(old->view(), prepared); !status) {
        common.warn(reuse_path_ + ": nothing is reused: ", status.error(), "");
    }
    return Ok{};
}

BakeStorage BakeStoring::storage() {
    BakeStorage storage;
    if (shared_) storage.sources.push_back(&*shared_);
    if (beside_ && is_resumed_) storage.sources.push_back(&*beside_);
    storage.target = shared_ ? &*shared_ : beside_ ? &*beside_ : nullptr;
    storage.cache = cache_ ? &*cache_ : nullptr;
    storage.is_saved_at_end = shared_.has_value();
    storage.is_required = !chunk_folder_.empty();
    if (storage.is_required) storage.save_seconds = kFrequentSaves;
    return storage;
}

Result<RangeBake> BakeStoring::bake(const Scene& scene, const PreparedBake& prepared,
                                    const BakeCallback& show, const RangePreview& preview) {
    const auto places = range_of(prepared.capture_positions.size());
    if (!places) return places.error();
    const BakeStorage used = storage();
    auto baked = bake_range(scene, prepared, *places, used, show, preview);
    if (baked || baked.error().code != ErrorCode::Cancelled) return baked;
    return interrupted();
}

Error BakeStoring::interrupted() {
    const BakeStore* target = storage().target;
    if (target == nullptr || target->is_empty()) {
        return {ErrorCode::Cancelled, "interrupted; nothing was kept"};
    }
    note_checkpoint();
    return {ErrorCode::Cancelled,
            str_cat("interrupted; ", target->folder(), " keeps what is done",
                    is_resumed_ || shared_ ? "; the same command goes on with it"
                                           : ", --resume goes on with it")};
}

void BakeStoring::warn(const StoredBake& baked, const CommonOptions& common) const {
    std::vector<std::string> lines;
    for (const auto* store : {&shared_, &beside_}) {
        if (!*store || (*store)->damaged_count() == 0) continue;
        lines.push_back(str_cat((*store)->folder(), ": ",
                                counted((*store)->damaged_count(), "damaged record"),
                                "; their probes are baked again"));
    }
    if (has_old_entries_ && !is_resumed_) {
        lines.push_back(beside_->folder() + ": holds an interrupted bake; --resume continues it");
    } else if (has_old_entries_ && baked.earlier_ray_count == 0) {
        lines.push_back(beside_->folder() +
                        ": holds no probe of this bake (scene, probes, settings or program version "
                        "differ) and stays as it is");
    }
    common.warn(lines);
    if (baked.save_failure) common.warn("", *baked.save_failure, "");
}

void BakeStoring::finish(const StoredBake& baked) {
    const bool has_other_work = has_old_entries_ && baked.earlier_ray_count == 0;
    if (beside_ && !has_other_work) BakeStore::remove(beside_->folder());
    if (shared_ && store_limit_ > 0.0) shared_->prune(static_cast<uint64_t>(store_limit_ * 1e9));
}

}  // namespace tetralight::cli
