// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bench/lightmap.h>

#include <tetralight/bake/scene/read_gltf.h>
#include <tetralight/bench/bake_scenes.h>

namespace tetralight::bench {
namespace {

void bench_scene(const std::string& path, const std::string& name, const Options& options) {
    if (!is_selected(options, name)) return;
    auto scene = read_gltf(path);
    require(bool(scene), "the scene " + path);
    light_if_dark(*scene);
    const auto is_asked = [&](const char* figure) {
        return !options.figure || *options.figure == figure;
    };
    if (is_asked("directional")) bench_lightmap_directional(*scene, name);
    if (is_asked("shadowmask")) bench_shadow_mask(*scene, name);
    if (is_asked("layers")) bench_lightmap_layers(*scene, name);
    if (options.figure) return;
    bench_lightmap_layout(*scene, name, options);
    bench_lightmap_texels(*scene, name, options);
    bench_lightmap_cache(*scene, name);
    bench_lightmap_filter(*scene, name);
}

}  // namespace

void bench_lightmap(const Options& options) {
    bench_scene(TETRALIGHT_SOURCE_DIR "/examples/scenes/courtyard.glb", "courtyard", options);
    if (options.scene) bench_scene(*options.scene, "scene", options);
    if (options.only || options.figure) return;
    bench_contact_shadow();
    bench_dark_room();
    bench_lightmap_samples(options);
}

}  // namespace tetralight::bench
