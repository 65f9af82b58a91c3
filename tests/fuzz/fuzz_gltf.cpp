// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <vector>

#include <tetralight/bake/scene/read_gltf.h>
#include <tetralight/base/error_text.h>
#include <tetralight/base/str_cat.h>
#include "tests/fuzz/mutator.h"
#include "tests/fuzz/seed_files.h"
#include "tests/fuzz/sound_scene.h"
#include "tests/fuzz/targets.h"
#include "tests/support/temp_folder.h"

namespace tetralight::fuzz {
namespace {

using Json = nlohmann::json;

/// All values of a document, at any depth.
void collect(Json& value, std::vector<Json*>& values) {
    values.push_back(&value);
    if (!value.is_structured()) return;
    for (Json& member : value) collect(member, values);
}

Json odd_value(Mutator& mutator) {
    static const Json kValues[] = {0,
                                   1,
                                   -1,
                                   3,
                                   255,
                                   65536,
                                   4294967295u,
                                   4294967296,
                                   9223372036854775807,
                                   18446744073709551615u,
                                   0.5,
                                   -0.0,
                                   1e-300,
                                   1e38,
                                   1e300,
                                   nullptr,
                                   true,
                                   false,
                                   "",
                                   "POSITION",
                                   "data:,",
                                   "data:application/octet-stream;base64,AAAA",
                                   "../a",
                                   std::string("a\0b", 3),
                                   Json::array(),
                                   Json::object(),
                                   {0, 0, 0},
                                   {{"index", 0}}};
    return kValues[mutator.below(std::size(kValues))];
}

/// Removes an element of a structured value, or puts one beside another.
void change_members(Mutator& mutator, Json& value) {
    if (value.empty()) return;
    const size_t index = mutator.below(value.size());
    const size_t other = mutator.below(value.size());
    const auto at = [&](size_t i) { return std::next(value.begin(), static_cast<ptrdiff_t>(i)); };
    switch (mutator.below(3)) {
        case 0:
            value.erase(at(index));
            return;
        case 1:
            if (value.is_array()) value.push_back(Json(value[index]));
            return;
        default:
            std::swap(*at(index), *at(other));
    }
}

void change_document(Mutator& mutator, Json& document) {
    std::vector<Json*> values;
    collect(document, values);
    Json& value = *values[mutator.below(values.size())];
    switch (mutator.below(5)) {
        case 0:
            value = odd_value(mutator);
            return;
        case 1: {
            const Json other = *values[mutator.below(values.size())];
            value = other;
            return;
        }
        case 2:
            if (value.is_number_integer()) {
                value = value.get<int64_t>() + static_cast<int64_t>(mutator.below(5)) - 2;
            } else if (value.is_number()) {
                value = value.get<double>() * -1e6;
            }
            return;
        default:
            if (value.is_structured()) return change_members(mutator, value);
            value = odd_value(mutator);
    }
}

std::string glb_of(std::string text, const std::string& binary) {
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const std::string chunks =
        GltfBuilder::chunk(0x4e4f534a, text) + GltfBuilder::chunk(0x004e4942, binary);
    return "glTF" + GltfBuilder::u32(2) + GltfBuilder::u32(chunks.size() + 12) + chunks;
}

/// The scene as a .glb file whose document or buffer is changed, or whose bytes are.
std::string changed_scene(Mutator& mutator) {
    static const GltfBuilder sound = sound_scene();
    GltfBuilder gltf = sound;
    gltf.json["buffers"] = {{{"byteLength", gltf.binary.size()}}};
    const size_t kind = mutator.below(8);
    for (size_t count = mutator.below(3) + 1; count > 0; --count) {
        if (kind < 5) change_document(mutator, gltf.json);
        if (kind >= 4 && kind < 7) {
            mutator.change_bytes(std::as_writable_bytes(std::span(gltf.binary)));
        }
    }
    std::string file = glb_of(gltf.json.dump(), gltf.binary);
    if (kind == 7) mutator.change_file(file);
    return file;
}

bool is_finite(const glm::dmat4& matrix) {
    for (int i = 0; i < 16; ++i) {
        if (!std::isfinite(matrix[i / 4][i % 4])) return false;
    }
    return true;
}

bool is_index(uint32_t index, size_t count) {
    return index == kNoIndex || index < count;
}

std::string problem_of(const Material& material, const Scene& scene) {
    for (const TextureUse* use : {&material.base_color_texture, &material.emission_texture,
                                  &material.metallic_roughness_texture}) {
        if (!is_index(use->texture, scene.textures.size())) return "a texture is out of range";
        if (use->uv_set > 1) return "a set of texture coordinates is out of range";
    }
    if (!is_index(material.normal_texture.texture, scene.normal_maps.size()) ||
        material.normal_texture.uv_set > 1) {
        return "a normal map is out of range";
    }
    return {};
}

std::string problem_of(const Mesh& mesh, const Scene& scene) {
    const size_t count = mesh.positions.size();
    const auto fits = [&](const auto& values) { return values.empty() || values.size() == count; };
    if (!fits(mesh.normals) || !fits(mesh.uvs[0]) || !fits(mesh.uvs[1]) || !fits(mesh.colors) ||
        !fits(mesh.tangents)) {
        return "arrays of a mesh differ in length";
    }
    if (mesh.indices.size() % 3 != 0) return "a triangle has no three corners";
    if (!std::ranges::all_of(mesh.indices, [&](uint32_t index) { return index < count; })) {
        return "an index is out of range";
    }
    const auto is_good = [](const glm::vec3& p) {
        return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
    };
    if (!std::ranges::all_of(mesh.positions, is_good)) return "a position is not finite";
    return is_index(mesh.material, scene.materials.size()) ? "" : "a material is out of range";
}

std::string problem_of(const MeshInstance& instance, const Scene& scene) {
    if (instance.mesh >= scene.meshes.size()) return "a mesh is out of range";
    if (!is_index(instance.node, scene.nodes.size())) return "a node is out of range";
    return is_finite(instance.world_from_mesh) ? "" : "a transform is not finite";
}

std::string problem_of(const Texture& texture) {
    const Image8& image = texture.image;
    const bool is_whole =
        !image.pixels.empty() && image.pixels.size() == size_t{image.width} * image.height;
    return is_whole ? "" : "a texture has not all its pixels";
}

std::string problem_of(const Environment& sky) {
    const ImageF& image = sky.image;
    if (image.pixels.size() != size_t{image.width} * image.height) return "a sky is not whole";
    const auto is_light = [](const glm::vec3& p) {
        return std::isfinite(p.x + p.y + p.z) && std::min({p.x, p.y, p.z}) >= 0.0f;
    };
    const bool is_good = is_light(sky.radiance) && std::isfinite(sky.rotation_radians) &&
                         std::ranges::all_of(image.pixels, is_light);
    return is_good ? "" : "a sky is not light";
}

/// The first problem of the elements, empty if there is none.
template <class Elements, class... Context>
std::string first_problem(const Elements& elements, const Context&... context) {
    for (const auto& element : elements) {
        std::string problem = problem_of(element, context...);
        if (!problem.empty()) return problem;
    }
    return {};
}

std::string problem_of(const Scene& scene) {
    for (size_t i = 0; i < scene.nodes.size(); ++i) {
        const SceneNode& node = scene.nodes[i];
        if (node.parent != kNoIndex && node.parent >= i) return "a node stands before its parent";
        if (!is_finite(node.world_from_node)) return "a transform of a node is not finite";
    }
    if (scene.light_names.size() != scene.lights.size()) return "a light has no name";
    for (const std::string& problem :
         {problem_of(scene.environment), first_problem(scene.textures),
          first_problem(scene.normal_maps), first_problem(scene.materials, scene),
          first_problem(scene.meshes, scene), first_problem(scene.instances, scene)}) {
        if (!problem.empty()) return problem;
    }
    return {};
}

/// What is wrong with how a file is taken, and whether it is refused.
struct Verdict {
    std::string problem;
    bool is_refused = false;
};

Verdict judge(const std::string& path, const SceneReading& reading) {
    const auto scene = read_gltf(path, reading);
    if (scene) return {problem_of(*scene)};
    const bool is_named = error_text(scene.error()).starts_with(path);
    return {is_named ? "" : "the error does not name the file: " + error_text(scene.error()), true};
}

}  // namespace

std::string fuzz_gltf(uint64_t seed) {
    static const TempFolder folder;
    Mutator mutator(seed);
    const std::string path = folder.write("a.glb", changed_scene(mutator));
    SceneReading reading{.normal_maps = NormalMaps::Read};
    if (mutator.below(2) == 0) reading.time = 0.5;
    return judge(path, reading).problem;
}

std::string replay_gltf(const std::string& path) {
    const Verdict verdict = judge(path, {.normal_maps = NormalMaps::Read});
    const bool must_be_refused =
        std::filesystem::path(path).filename().string().starts_with("refused_");
    return must_be_refused && !verdict.is_refused ? "is not refused" : verdict.problem;
}

}  // namespace tetralight::fuzz
