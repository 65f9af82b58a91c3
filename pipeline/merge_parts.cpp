// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/merge_parts.h>

#include <algorithm>
#include <optional>
#include <tuple>
#include <utility>

#include <tetralight/base/contract.h>
#include <tetralight/base/file.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/lightmap/lightmap_file.h>
#include <tetralight/pipeline/finish_bake.h>
#include <tetralight/pipeline/lightmap_part.h>
#include <tetralight/pipeline/partial_bake.h>
#include <tetralight/pipeline/walls_metadata.h>
#include <tetralight/probes/probe_file.h>

namespace tetralight {
namespace {

/// Parts of one bake by their ranges, and what is the same in all of them.
template <class Part>
struct Parts {
    decltype(Part::prepared) prepared;
    std::vector<decltype(Part::partial)> partials;
    std::vector<FileRange> files;
};

template <class Part>
Status check_part(const Part& part, uint64_t key, const std::string& first_path,
                  const char* differences) {
    if (part.prepared.key == key) return Ok{};
    return Error{ErrorCode::InvalidArgument,
                 str_cat(part.path, ": is of another bake than ", first_path, " (", differences,
                         " or program version differ)")};
}

/// Returns invalid_argument if some files are lightmaps and others are not.
Status check_kinds(const std::vector<std::string>& paths) {
    const auto has_lightmaps = [](const std::string& path) {
        const auto file = MappedFile::open(path);
        return file && is_lightmap_file(file->bytes());
    };
    const bool first = has_lightmaps(paths[0]);
    const auto what = [](bool is_lightmap) { return is_lightmap ? "lightmaps" : "probes"; };
    for (const std::string& path : paths) {
        const auto file = MappedFile::open(path);
        if (!file) return file.error();
        if (has_lightmaps(path) == first) continue;
        if (first && !open_probe_file_lazy(path))
            return Error{ErrorCode::InvalidArgument, str_cat(path, ": is not a part of lightmaps")};
        return Error{ErrorCode::InvalidArgument,
                     str_cat(path, ": contains ", what(!first), ", but ", paths[0], " contains ",
                             what(first))};
    }
    return Ok{};
}

/// Reads parts with `read` and sorts them. `differences`: what else can make two bakes differ.
template <class Part>
Result<Parts<Part>> read_parts(const std::vector<std::string>& paths,
                               Result<Part> (*read)(const std::string&), const char* differences) {
    TETRALIGHT_ASSERT(!paths.empty(), "there is nothing to merge");
    if (auto status = check_kinds(paths); !status) return status.error();
    std::vector<Part> all;
    std::optional<decltype(Part::prepared)> first;
    for (const std::string& path : paths) {
        auto part = read(path);
        if (!part) return part.error();
        const uint64_t key = first ? first->key : part->prepared.key;
        if (auto status = check_part(*part, key, paths[0], differences); !status)
            return status.error();
        if (!first) first = std::move(part->prepared);
        part->prepared = {};
        all.push_back(std::move(*part));
    }
    std::ranges::stable_sort(all, {}, [](const Part& part) {
        return std::pair(part.partial.range.begin, part.partial.range.end);
    });
    Parts<Part> parts{std::move(*first), {}, {}};
    for (Part& part : all) {
        parts.files.push_back({part.path, part.partial.range});
        parts.partials.push_back(std::move(part.partial));
    }
    return parts;
}

/// Puts values of a part, the same number of each texel, among those of all `count` texels.
template <class T>
void add(const TexelBake& part, const std::vector<T>& values, size_t count, std::vector<T>& all) {
    if (values.empty()) return;
    const size_t each = values.size() / part.range.count();
    all.resize(each * count);
    put(std::span(values), part.range, std::span(all), each);
}

/// What the volume of a part keeps of the bake's report.
void restore_report(PreparedBake& bake) {
    bake.report.visibility = stored_visibility(bake.volume.view());
    if (const auto walls = read_walls(bake.volume.metadata)) bake.report.unseen = walls->unseen;
}

}  // namespace

Result<BakedVolume> merge_parts(const std::vector<std::string>& paths) {
    auto parts = read_parts<PartFile>(paths, read_part, "scene, groups, settings");
    if (!parts) return parts.error();
    PreparedBake& bake = parts->prepared;
    const size_t count = bake.volume.positions.size();
    if (auto status = check_cover(parts->files, {"probe", count}); !status) return status.error();

    restore_report(bake);
    BakeFinisher finisher(std::move(bake));
    for (const PartialBake& partial : parts->partials) finisher.add(partial);
    return std::move(finisher).finish();
}

Result<BakedVolume> merge_light_parts(const std::string& prepared_path,
                                      const std::vector<std::string>& paths) {
    TETRALIGHT_ASSERT(!paths.empty(), "there is nothing to merge");
    auto prepared = read_prepared_bake(prepared_path);
    if (!prepared) return prepared.error();
    std::vector<FileRange> files;
    for (const std::string& path : paths) {
        const auto range = light_part_range(path, *prepared);
        if (!range) return range.error();
        files.push_back({path, *range});
    }
    std::ranges::sort(files, {}, [](const FileRange& file) {
        return std::tuple(file.range.begin, file.range.end, file.path);
    });
    const size_t count = prepared->volume.positions.size();
    if (auto status = check_cover(files, {"probe", count}); !status) return status.error();
    restore_report(*prepared);
    BakeFinisher finisher(std::move(*prepared));
    for (const FileRange& file : files) {
        const auto light = read_light_part(file.path, finisher.prepared());
        if (!light) return light.error();
        finisher.add(*light);
    }
    return std::move(finisher).finish();
}

Result<BakedLightmaps> merge_lightmap_parts(const std::vector<std::string>& paths,
                                            uint32_t thread_count) {
    auto parts = read_parts<LightmapPartFile>(paths, read_lightmap_part, "scene, settings");
    if (!parts) return parts.error();
    PreparedLightmaps& prepared = parts->prepared;
    if (auto status = check_cover(parts->files, {"texel", prepared.baked.size()}); !status)
        return status.error();

    TexelBake bake;
    for (const TexelBake& partial : parts->partials) {
        add(partial, partial.accumulators, prepared.baked.size(), bake.accumulators);
        add(partial, partial.rows, prepared.baked.size(), bake.rows);
        add(partial, partial.normals, prepared.baked.size(), bake.normals);
        add(partial, partial.mapped_normals, prepared.baked.size(), bake.mapped_normals);
    }
    prepared.settings.bake.thread_count = thread_count;
    return finish_lightmaps(std::move(prepared), bake);
}

}  // namespace tetralight
