// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/place_range.h>

#include <algorithm>

#include <tetralight/base/contract.h>
#include <tetralight/base/str_cat.h>

namespace tetralight {

std::string name_of(const PlaceRange& range) {
    const std::string ends = str_cat(range.begin, "..", range.end);
    return range.step == 1 ? ends : str_cat(ends, "x", range.step);
}

Status check_range(const PlaceRange& range, const AllPlaces& all) {
    if (range.begin <= range.end && range.end <= all.count) return Ok{};
    const std::string asked = range.begin > all.count ? str_cat(all.name, " ", range.begin)
                                                      : str_cat(all.name, "s ", name_of(range));
    return Error{ErrorCode::InvalidArgument, all.name + "s", name_of(range),
                 str_cat(asked, ": there are ", all.count, " ", all.name, "s")};
}

Status check_cover(std::span<const FileRange> files, const AllPlaces& all) {
    TETRALIGHT_ASSERT(!files.empty(), "there is a file");
    constexpr uint32_t kNone = UINT32_MAX;
    std::vector<uint32_t> file_of(all.count, kNone);
    for (uint32_t i = 0; i < files.size(); ++i) {
        const auto& [path, range] = files[i];
        for (uint32_t k = 0; k < range.count(); ++k) {
            uint32_t& file = file_of[range[k]];
            if (file != kNone) {
                return Error{
                    ErrorCode::InvalidArgument,
                    str_cat(path, ": ", all.name, "s ", name_of(range), " overlap ", all.name, "s ",
                            name_of(files[file].range), " of ", files[file].path)};
            }
            file = i;
        }
    }
    const auto first = std::ranges::find(file_of, kNone);
    if (first == file_of.end()) return Ok{};
    const auto next =
        std::find_if(first, file_of.end(), [](uint32_t file) { return file != kNone; });
    const PlaceRange missing{static_cast<uint32_t>(first - file_of.begin()),
                             static_cast<uint32_t>(next - file_of.begin())};
    const auto others = static_cast<size_t>(std::count(next, file_of.end(), kNone));
    const bool is_last = next == file_of.end();
    const FileRange& beside = is_last ? files.back() : files[*next];
    return Error{ErrorCode::InvalidArgument,
                 str_cat(all.name, "s ", name_of(missing),
                         others > 0 ? str_cat(" and ", others, " others") : "", " of ", all.count,
                         " are in no part; the ", is_last ? "last, " : "next, ",
                         name_of(beside.range), ", are in ", beside.path)};
}

std::vector<PlaceRange> spread_ranges(size_t place_count, size_t count) {
    const auto step =
        static_cast<uint32_t>(std::clamp<size_t>(count, 1, std::max<size_t>(place_count, 1)));
    std::vector<PlaceRange> ranges;
    for (uint32_t first = 0; first < step; ++first)
        ranges.push_back({first, static_cast<uint32_t>(place_count), step});
    return ranges;
}

}  // namespace tetralight
