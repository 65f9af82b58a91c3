// SPDX-License-Identifier: Apache-2.0
#include <tetralight/base/str_cat.h>
#include <tetralight/cli/commands.h>
#include <tetralight/cli/common.h>
#include <tetralight/cli/paths.h>
#include <tetralight/cli/scene_reading.h>
#include <tetralight/pipeline/lightmap_settings.h>
#include <tetralight/pipeline/write_lightmap_glb.h>

namespace tetralight::cli {
namespace {

LightmapLayoutSettings layout_settings(const Values& values) {
    BakeLightmapsSettings settings;
    for_each_lightmap_setting(settings, [&](const char* name, auto& member, Recorded) {
        if (has_setting(values, name)) read_if_any(values, name, member);
    });
    settings.layout.thread_count = settings.bake.thread_count;
    return settings.layout;
}

struct Unwrap {
    std::string scene_path;
    SceneReading reading;
    std::string output;
    LightmapLayoutSettings settings;
    CommonOptions common;

    explicit Unwrap(const Values& values)
        : scene_path(values.text("scene")),
          reading(scene_reading(values)),
          output(values.text("output")),
          settings(layout_settings(values)),
          common(values) {}

    Status run() const {
        if (auto status = check_output(output, {scene_path}); !status) return status;
        const auto scene = read_scene(scene_path, reading);
        if (!scene) return scene.error();
        common.warn(scene->warnings);
        const auto layout = make_lightmap_layout(*scene, settings);
        if (!layout) return with_size_hint(layout.error(), *scene).in(scene_path);
        common.warn(in_file(scene_path, layout->warnings));
        if (layout->page_count == 0) {
            return Error{ErrorCode::InvalidArgument, "scene", scene_path,
                         scene_path + ": the scene has no object that takes a lightmap"};
        }
        auto status = write_unwrapped_glb(output, scene_path, *layout, reading);
        if (!status) return status;
        report(*layout);
        return Ok{};
    }

    void report(const LightmapLayout& layout) const {
        size_t charts = 0, objects = 0;
        uint64_t texels = 0;
        for (const LightmapPacking& packing : layout.packings) {
            uint32_t count = 0;
            for (const uint32_t chart : packing.triangle_charts) count = std::max(count, chart + 1);
            charts += count;
        }
        for (const LightmapPlace& place : layout.places) {
            if (!place.has_lightmap()) continue;
            const PackedCharts& packed = layout.packings[place.packing].charts;
            texels += uint64_t{packed.width} * packed.height;
            ++objects;
        }
        common.report(
            output,
            {{"output", output},
             {"objects", objects},
             {"pages", layout.page_count},
             {"page_size", layout.page_size},
             {"charts", charts},
             {"texels", texels},
             {"warnings", layout.warnings.size()}},
            str_cat(output, ": ", counted(objects, "object"), ", ", counted(charts, "chart"), ", ",
                    counted(layout.page_count, "page"), " of ", layout.page_size, " x ",
                    layout.page_size, ", ", counted(texels, "texel"), " in rectangles"));
    }
};

}  // namespace

Status run_unwrap(const Values& values) {
    return Unwrap(values).run();
}

}  // namespace tetralight::cli
