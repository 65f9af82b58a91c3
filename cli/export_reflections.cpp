// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/export_reflections.h>

#include <algorithm>

#include <tetralight/bake/image/write_image.h>
#include <tetralight/base/shown_path.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/cli/paths.h>
#include <tetralight/pipeline/lightmap_images.h>
#include <tetralight/pipeline/reflection_images.h>
#include <tetralight/reflection/reflection_file.h>

namespace tetralight::cli {
namespace {

/// The indices of the probes of these names, or of all.
Result<std::vector<size_t>> chosen_probes(const ReflectionFile& file,
                                          const ReflectionExport& what) {
    std::vector<size_t> chosen;
    if (what.names.empty()) {
        for (size_t i = 0; i < file.view().probes.size(); ++i) chosen.push_back(i);
    }
    const auto names = file.names();
    for (const std::string& name : what.names) {
        const auto found = std::ranges::find(names, name);
        if (found == names.end()) {
            return Error{
                ErrorCode::NotFound, "probe", name,
                str_cat(shown_path(what.path), ": no reflection probe \"", name, "\" is there")};
        }
        chosen.push_back(static_cast<size_t>(found - names.begin()));
    }
    return chosen;
}

/// The files that are written, checked.
Result<std::vector<std::string>> image_paths(const ReflectionExport& what, size_t count) {
    if (what.output == "-" && count > 1) {
        return Error{ErrorCode::InvalidArgument, "output", what.output,
                     str_cat("-: cannot write ", count, " cubes to stdout; choose one by --probe")};
    }
    std::vector<std::string> paths;
    for (size_t i = 0; i < count; ++i) {
        paths.push_back(
            page_path(what.output, static_cast<uint32_t>(i), static_cast<uint32_t>(count)));
        if (auto status = check_output(paths.back(), {what.path}); !status) return status.error();
    }
    return paths;
}

Status check_level(const ReflectionsView& all, const ReflectionExport& what) {
    if (what.level < all.level_count) return Ok{};
    return Error{ErrorCode::NotFound, "level", str_cat(what.level),
                 str_cat(shown_path(what.path), ": has levels 0 to ", all.level_count - 1, ", not ",
                         what.level)};
}

}  // namespace

Status export_reflection_images(const ReflectionExport& what, const CommonOptions& common) {
    const auto file = open_reflection_file(what.path);
    if (!file) return file.error();
    const ReflectionsView& all = file->view();
    if (auto status = check_level(all, what); !status) return status;
    const auto chosen = chosen_probes(*file, what);
    if (!chosen) return chosen.error();
    const auto paths = image_paths(what, chosen->size());
    if (!paths) return paths.error();
    for (size_t i = 0; i < chosen->size(); ++i) {
        auto status = write_exr((*paths)[i], cube_strip(all, (*chosen)[i], what.level));
        if (!status) return status;
    }
    const uint32_t size = all.size >> what.level;
    const std::string files =
        paths->size() == 1 ? "" : str_cat(" (", counted(paths->size(), "file"), ")");
    common.report(what.output,
                  {{"output", what.output},
                   {"files", *paths},
                   {"probes", chosen->size()},
                   {"level", what.level},
                   {"face_size", size}},
                  str_cat(paths->front(), files, ": ", counted(chosen->size(), "cube"),
                          ", six faces of ", size, " x ", size, " one below the other"));
    return Ok{};
}

}  // namespace tetralight::cli
