// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/place_range.h>

#include <tetralight/base/contract.h>
#include <tetralight/base/str_cat.h>

namespace tetralight {

std::string name_of(const PlaceRange& range) {
    return str_cat(range.begin, "..", range.end);
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
    const auto missing = [&](const PlaceRange& range) {
        return str_cat(all.name, "s ", name_of(range), " of ", all.count, " are in no part; the ");
    };
    uint32_t end = 0;
    for (size_t i = 0; i < files.size(); ++i) {
        const auto& [path, range] = files[i];
        if (range.begin < end) {
            const FileRange& before = files[i - 1];
            return Error{ErrorCode::InvalidArgument,
                         str_cat(path, ": ", all.name, "s ", name_of(range), " overlap ", all.name,
                                 "s ", name_of(before.range), " of ", before.path)};
        }
        if (range.begin > end) {
            return Error{ErrorCode::InvalidArgument, str_cat(missing({end, range.begin}), "next, ",
                                                             name_of(range), ", are in ", path)};
        }
        end = range.end;
    }
    if (end >= all.count) return Ok{};
    const FileRange& last = files.back();
    return Error{ErrorCode::InvalidArgument,
                 str_cat(missing({end, static_cast<uint32_t>(all.count)}), "last, ",
                         name_of(last.range), ", are in ", last.path)};
}

}  // namespace tetralight
