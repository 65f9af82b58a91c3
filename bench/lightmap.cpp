// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bench/lightmap.h>

#include <tetralight/bake/scene/read_gltf.h>
#include <tetralight/bench/bake_scenes.h>

namespace tetralight::bench {
namespace {

void bench_scene(const std::string& path, const std::string& name, const Options& options) {
    if (!is_selected(options, name)) return;
    const bool is_directional = !options.figure || *options.figure == "directional";
    auto scene = read_gltf(path);
    require(bool(scene), "the scene " + path);
    light_if_dark(*scene);
    if (is_directional) bench_lightmap_directional(*scene, name);
    if (options.figure) return;
    bench_lightmap_layout(*scene, name, options);
    bench_lightmap_texels(*scene, name, options);
    bench_lightmap_cache(*scene, name);
    bench_lightmap_filter(*scene, name);
    bench_shadow_mask(*scene, name);
    bench_lightmap_layers(*scene, name);
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
