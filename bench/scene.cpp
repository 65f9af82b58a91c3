// SPDX-License-Identifier: Apache-2.0

#include <cstdlib>
#include <cstring>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include <tetralight/bake/image/read_image.h>
#include <tetralight/bake/scene/read_gltf.h>
#include <tetralight/base/error_text.h>
#include <tetralight/base/file.h>
#include <tetralight/bench/harness.h>

namespace tetralight::bench {
namespace {

using nlohmann::json;
using Bytes = std::span<const std::byte>;

Scene read_whole(const std::string& path) {
    auto scene = read_gltf(path, {.normal_maps = NormalMaps::Read});
    require(bool(scene), scene ? "" : error_text(scene.error()));
    return std::move(*scene);
}

/// The 32-bit number at this place of a GLB file.
uint32_t number_at(Bytes bytes, size_t place) {
    uint32_t number = 0;
    std::memcpy(&number, bytes.data() + place, sizeof number);
    return number;
}

/// What no reader of a GLB file can do without: parses its JSON, copies its buffer, decodes its
/// images. Returns the decoded pixels, for a check.
size_t decode_alone(Bytes bytes) {
    constexpr size_t kHeader = 12, kChunkHeader = 8;
    const size_t json_size = number_at(bytes, kHeader);
    const Bytes text = bytes.subspan(kHeader + kChunkHeader, json_size);
    const json document = json::parse(reinterpret_cast<const char*>(text.data()),
                                      reinterpret_cast<const char*>(text.data() + text.size()));
    const Bytes chunk = bytes.subspan(kHeader + 2 * kChunkHeader + json_size);
    const std::vector<std::byte> buffer(chunk.begin(), chunk.end());
    size_t pixels = 0;
    for (const json& image : document.value("images", json::array())) {
        const json& view = document["bufferViews"][image.at("bufferView").get<size_t>()];
        const Bytes encoded = Bytes(buffer).subspan(view.value("byteOffset", size_t{0}),
                                                    view.at("byteLength").get<size_t>());
        const auto decoded = decode_image8(encoded, "image");
        require(bool(decoded), "an image of the scene");
        pixels += decoded->pixels.size();
    }
    return pixels;
}

void bench_load(const std::string& path, const std::string& name, const Options& options) {
    const auto file = MappedFile::open(path);
    require(bool(file), "the scene " + path);
    Contest contest;
    contest.figure = "scene.load." + name;
    contest.unit = "MB/s";
    contest.baseline_is = "JSON parsed and all images decoded, nothing else";
    contest.work = static_cast<double>(file->bytes().size()) * 1e-6;
    contest.ours = [&] { return seconds([&] { (void)read_whole(path); }); };
    contest.baseline = [&] { return seconds([&] { (void)decode_alone(file->bytes()); }); };
    run(contest, options);
}

/// The peak of a process that reads the scene, as a part of what the headers announce and the
/// program itself has.
void bench_memory(const std::string& path, const std::string& name) {
    const auto announced = static_cast<double>(read_whole(path).memory.peak_bytes());
    report("scene.memory." + name,
           peak_memory({"scene", "--only", "read", "--scene", path}) /
               (peak_memory({"scene", "--only", "nothing", "--scene", path}) + announced),
           "peak / announced");
}

}  // namespace

void bench_scene(const Options& options) {
    if (options.only == "read" && options.scene) (void)read_whole(*options.scene);
    if (options.only) return;  // a process of bench_memory()
    const std::string courtyard = TETRALIGHT_SOURCE_DIR "/examples/scenes/courtyard.glb";
    bench_memory(courtyard, "courtyard");
    bench_load(courtyard, "courtyard", options);
    if (!options.scene) return;
    bench_memory(*options.scene, "scene");
    bench_load(*options.scene, "scene", options);
}

}  // namespace tetralight::bench
