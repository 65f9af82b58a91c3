// SPDX-License-Identifier: Apache-2.0
#include "tests/cli/bad_files.h"

namespace tetralight::test {
namespace {

std::string gltf(const std::string& body) {
    return R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], )" + body + "}";
}

std::string groups(const std::string& body) {
    return R"({"groups": [)" + body + "]}";
}

/// A group of one probe whose three coordinates are the float NaN.
std::string gltf_with_nan_probe() {
    return gltf(R"(
        "nodes": [{"name": "hall", "mesh": 0, "extras": {"light_probe_group": true}}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "mode": 0}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 1, "type": "VEC3"}],
        "bufferViews": [{"buffer": 0, "byteLength": 12}],
        "buffers": [{"byteLength": 12,
                     "uri": "data:application/octet-stream;base64,AADAfwAAwH8AAMB/"}])");
}

}  // namespace

std::vector<BadFile> bad_scenes(const std::string& sound_glb) {
    std::vector<BadFile> files;
    for (const size_t length : {size_t{0}, size_t{3}, size_t{11}, size_t{12}, size_t{19},
                                size_t{500}, sound_glb.size() / 2, sound_glb.size() - 1}) {
        files.push_back({"cut_" + std::to_string(length) + ".glb", sound_glb.substr(0, length),
                         "cut_" + std::to_string(length) + ".glb: "});
    }
    files.push_back({"text.gltf", "no scene", "text.gltf: "});
    files.push_back({"child.gltf", gltf(R"("nodes": [{"children": [7]}])"), "7"});
    files.push_back({"root.gltf", gltf(R"("nodes": [])"), "out of range"});
    files.push_back({"mesh.gltf", gltf(R"("nodes": [{"mesh": 7}])"), "7"});
    files.push_back({"accessor.gltf", gltf(R"("nodes": [{"mesh": 0}],
                 "meshes": [{"primitives": [{"attributes": {"POSITION": 7}}]}])"),
                     "7"});
    return files;
}

std::vector<BadFile> bad_groups() {
    const std::string overflow = R"({"name": "hall", "positions": [[0, 0, 0], [1e999, 0, 0]]})";
    const std::string nan = R"({"name": "hall", "positions": [[0, 0, 0], [NaN, 0, 0]]})";
    const std::string pair = R"({"name": "hall", "positions": [[0, 0, 0], [1, 2]]})";
    return {{"empty.json", "", "empty.json: "},
            {"overflow.json", groups(overflow), "group \"hall\": probe 1"},
            {"nan.json", groups(nan), "group \"hall\": probe 1"},
            {"pair.json", groups(pair), "group \"hall\": probe 1"},
            {"nameless.json", groups(R"({"positions": [[0, 0, 0]]})"), "name"},
            {"cut.json", R"({"groups": [{"name": "hall")", "cut.json: "},
            {"nan.gltf", gltf_with_nan_probe(), "hall"},
            {"plain.gltf", gltf(R"("nodes": [{}])"), "light_probe_group"}};
}

std::vector<BadFile> bad_volumes(const std::string& sound_volume) {
    std::vector<BadFile> files;
    for (const size_t length : {size_t{0}, size_t{3}, size_t{63}, size_t{64}, size_t{500},
                                sound_volume.size() / 2, sound_volume.size() - 1}) {
        const std::string name = "cut_" + std::to_string(length) + ".probes";
        files.push_back({name, sound_volume.substr(0, length), name + ": "});
    }
    files.push_back({"text.probes", std::string(4096, 'x'), "not a probe file"});
    std::string damaged = sound_volume;
    damaged[damaged.size() / 2] ^= 1;
    files.push_back({"damaged.probes", damaged, "section \""});
    return files;
}

}  // namespace tetralight::test
