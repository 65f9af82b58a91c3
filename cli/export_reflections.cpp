// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/export_reflections.h>

#include <algorithm>
#include <charconv>
#include <system_error>

#include <tetralight/bake/image/write_image.h>
#include <tetralight/base/shown_path.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/cli/paths.h>
#include <tetralight/pipeline/lightmap_images.h>
#include <tetralight/pipeline/reflection_images.h>
#include <tetralight/pipeline/write_reflection_glb.h>
#include <tetralight/reflection/reflection_file.h>

namespace tetralight::cli {
namespace {

/// The probe of a name, or else of a number.
Result<size_t> probe_of(const ReflectionFile& file, const ReflectionExport& what,
                        const std::string& probe) {
    const auto names = file.names();
    const auto found = std::ranges::find(names, probe);
    if (found != names.end()) return static_cast<size_t>(found - names.begin());
    size_t number = 0;
    const char* end = probe.data() + probe.size();
    const auto [next, error] = std::from_chars(probe.data(), end, number);
    const bool is_number = error == std::errc() && next == end;
    if (is_number && number < file.view().probes.size()) return number;
    return Error{ErrorCode::NotFound, "probe", probe,
                 str_cat(shown_path(what.path), ": no reflection probe \"", probe, "\" is there")};
}

/// The indices of the probes that are written as images.
Result<std::vector<size_t>> chosen_probes(const ReflectionFile& file,
                                          const ReflectionExport& what) {
    std::vector<size_t> chosen;
    if (what.probes.empty()) {
        for (size_t i = 0; i < file.view().probes.size(); ++i) chosen.push_back(i);
    }
    for (const std::string& probe : what.probes) {
        const auto index = probe_of(file, what, probe);
        if (!index) return index.error();
        chosen.push_back(*index);
    }
    return chosen;
}

/// The probe whose light is written: that of the sky shines on everything, as such a light does.
Result<size_t> light_probe(const ReflectionFile& file, const ReflectionExport& what) {
    if (!what.probes.empty()) return probe_of(file, what, what.probes.front());
    const auto probes = file.view().probes;
    if (probes.size() == 1) return size_t{0};
    const auto sky = std::ranges::find_if(probes, &ReflectionProbe::is_everywhere);
    if (sky != probes.end()) return static_cast<size_t>(sky - probes.begin());
    return Error{ErrorCode::NotFound, "probe", "",
                 str_cat(shown_path(what.path), ": has ", probes.size(),
                         " reflection probes and no sky; choose one by --probe")};
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

Status export_reflection_scene(const ReflectionExport& what, const CommonOptions& common) {
    const auto file = open_reflection_file(what.path);
    if (!file) return file.error();
    const auto probe = light_probe(*file, what);
    if (!probe) return probe.error();
    auto status = check_output(what.output, {what.path, what.scene_path});
    if (!status) return status;
    const ReflectionsView& all = file->view();
    const auto names = file->names();
    const std::string name = names.empty() ? str_cat("probe ", *probe) : std::string(names[*probe]);
    const auto intensity = write_reflection_glb(what.output, what.scene_path, all, *probe, name);
    if (!intensity) return intensity.error();
    const std::string note = *intensity > 1.0f ? ", because its images hold light up to 255" : "";
    common.report(what.output,
                  {{"output", what.output},
                   {"light", name},
                   {"intensity", *intensity},
                   {"levels", all.level_count},
                   {"face_size", all.size}},
                  str_cat(what.output, ": image-based light \"", printable(name), "\" of ",
                          all.size, " x ", all.size, " texels a face, ",
                          counted(all.level_count, "level"), ", intensity ", *intensity, note));
    return Ok{};
}

}  // namespace tetralight::cli
