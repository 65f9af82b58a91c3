// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/part_sections.h>

#include <cmath>

#include <tetralight/bake/round_plan.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/pipeline/check_accumulator.h>
#include <tetralight/probes/section_error.h>

namespace tetralight {
namespace {

using detail::section_error;

/// Returns unsupported if the accumulators are of an earlier or later version of the program.
Status check_version(std::span<const FileSection> table) {
    for (const FileSection& section : table) {
        if (section.name != "tallies" || section.element_size == sizeof(ProbeAccumulator)) continue;
        return Error{ErrorCode::Unsupported, section.name, str_cat(section.element_size),
                     str_cat("another version of the program wrote this part (its elements have ",
                             section.element_size, " bytes instead of ", sizeof(ProbeAccumulator),
                             "); bake it again")};
    }
    return Ok{};
}

Status check_rows(const PartSums& sums, const AllPlaces& all) {
    const size_t count = sums.accumulators.size();
    if (sums.rows.size() != sums.row_size * count) {
        return section_error("split_rows", str_cat(sums.rows.size(), " numbers for ", count, " ",
                                                   all.name, "s of ", sums.row_size));
    }
    for (size_t i = 0; i < sums.rows.size(); ++i) {
        if (std::isfinite(sums.rows[i])) continue;
        return section_error(
            "split_rows",
            str_cat("row of ", all.name, " ", sums.range[i / sums.row_size], " is not finite"));
    }
    return Ok{};
}

}  // namespace

PartInfo::PartInfo(uint64_t bake_key, const PlaceRange& range, const BakeSettings& settings)
    : key(bake_key),
      begin(range.begin),
      end(range.end),
      target_error(settings.target_error),
      time_budget_seconds(settings.time_budget_seconds),
      max_sample_count(settings.max_sample_count),
      sample_count(settings.sample_count),
      step(range.step),
      target_layer_error(static_cast<float>(settings.target_layer_error)) {}

BakeSettings PartInfo::bake_settings() const {
    BakeSettings settings;
    settings.sample_count = sample_count;
    settings.target_error = target_error;
    settings.target_layer_error = static_cast<double>(target_layer_error);
    settings.time_budget_seconds = time_budget_seconds;
    settings.max_sample_count = max_sample_count;
    return settings;
}

bool PartSections::is_part() const {
    return find_("part", sizeof(PartInfo)).has_value();
}

Result<PartInfo> PartSections::info(std::string_view writer) const {
    const auto infos = read<PartInfo>("part");
    if (infos.size() != 1) return not_a_part(writer);
    const PartInfo& info = infos[0];
    if (auto status = check_version(table_); !status) return status.error();
    if (info.step == 0) return Error{ErrorCode::InvalidArgument, "is not finished"};
    if (auto status = RoundPlan::check(info.bake_settings()); !status) return status.error();
    return info;
}

Error not_a_part(std::string_view writer) {
    return {ErrorCode::InvalidArgument,
            str_cat("is not a part of a bake (", writer, " writes parts)")};
}

Status check_part_range(const PlaceRange& range, const AllPlaces& all) {
    if (range.begin <= range.end && range.end <= all.count) return Ok{};
    return Error{ErrorCode::Corrupt, str_cat(all.name, "s ", name_of(range),
                                             " are out of range (there are ", all.count, ")")};
}

Status check_sums(const PartSums& sums, const AllPlaces& all, const BakeSettings& settings,
                  const std::vector<bool>& is_reused) {
    const RoundPlan plan(settings);
    const auto& [range, accumulators, rows, row_size] = sums;
    if (auto status = check_part_range(range, all); !status) return status;
    if (accumulators.size() != range.count()) {
        return section_error("tallies", str_cat(accumulators.size(), " elements for ",
                                                range.count(), " ", all.name, "s"));
    }
    if (auto status = check_rows(sums, all); !status) return status;
    for (size_t i = 0; i < accumulators.size(); ++i) {
        const bool is_empty = !is_reused.empty() && is_reused[range[i]];
        const bool has_rounds = accumulators[i].round_count > 0;
        if (has_rounds != is_empty && is_possible(accumulators[i], plan)) continue;
        return section_error("tallies",
                             str_cat("element of ", all.name, " ", range[i], " is out of range"));
    }
    return Ok{};
}

}  // namespace tetralight
