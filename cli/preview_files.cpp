// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/preview_files.h>

#include <algorithm>

#include <tetralight/bake/image/write_image.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/cli/failure.h>
#include <tetralight/cli/paths.h>
#include <tetralight/lightmap/lightmap_file.h>
#include <tetralight/pipeline/lightmap_images.h>
#include <tetralight/render/page_preview.h>

namespace tetralight::cli {
namespace {

constexpr const char* kSetting = "preview";

bool has_all_pages(const std::string& path) {
    return path.ends_with(".lightmaps");
}

/// The files of a path.
std::vector<std::string> page_paths(const std::string& path, uint32_t page_count) {
    if (has_all_pages(path) || page_count <= 1) return {path};
    std::vector<std::string> paths;
    for (uint32_t page = 0; page < page_count; ++page)
        paths.push_back(page_path(path, page, page_count));
    return paths;
}

Status write_preview(const std::string& path, const LightmapsView& maps) {
    if (has_all_pages(path)) return write_lightmap_file(path, maps);
    const auto irradiance = map_values(maps, LightmapMap::Irradiance);
    if (!irradiance) return irradiance.error();
    if (path.ends_with(".exr")) return write_exr_pages(path, *irradiance);
    const std::vector<bool> is_marked(maps.rectangles.size());
    for (uint32_t page = 0; page < maps.info.page_count; ++page) {
        const std::string to = page_path(path, page, maps.info.page_count);
        if (auto status = write_png(to, page_preview(maps, *irradiance, page, is_marked)); !status)
            return status;
    }
    return Ok{};
}

}  // namespace

PreviewFiles::PreviewFiles(const Values& values) : paths_(values.texts(kSetting)) {
    for (const std::string& path : paths_) {
        const auto has = [&](const char* extension) { return path.ends_with(extension); };
        if (has(".png") || has(".exr") || has(".lightmaps")) continue;
        refuse(values, kSetting,
               str_cat("expected a .png, .exr or .lightmaps file, not \"", path, "\""));
    }
}

Status PreviewFiles::check(const std::vector<std::string>& others, uint32_t page_count) const {
    std::vector<std::string> known = others;
    for (const std::string& path : paths_) {
        for (const std::string& page : page_paths(path, page_count)) {
            if (auto status = check_side_file(page, known, kSetting); !status) return status;
            known.push_back(page);
        }
    }
    return Ok{};
}

void PreviewFiles::write(const LightmapsView& lightmaps) {
    if (!status_) return;
    for (const std::string& path : paths_) {
        status_ = write_preview(path, lightmaps);
        if (!status_) return;
    }
    ++revision_;
}

void PreviewFiles::warn(const CommonOptions& common) const {
    if (!status_) common.warn("the preview is not up to date: ", status_.error(), "");
}

}  // namespace tetralight::cli
