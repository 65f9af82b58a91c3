// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/placement/canonical_scene.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <numeric>
#include <tuple>
#include <utility>

#include <tetralight/probes/content_hash.h>

namespace tetralight {
namespace {

using Corner = std::tuple<float, float, float>;
using Triangle = std::array<uint32_t, 3>;

Corner corner(const Mesh& mesh, uint32_t vertex) {
    const glm::vec3& p = mesh.positions[vertex];
    return {p.x, p.y, p.z};
}

std::array<Corner, 3> corners(const Mesh& mesh, const Triangle& triangle) {
    return {corner(mesh, triangle[0]), corner(mesh, triangle[1]), corner(mesh, triangle[2])};
}

/// Rotates each triangle so that its smallest corner is first, and sorts the triangles.
void sort_triangles(Mesh& mesh) {
    std::vector<Triangle> triangles(mesh.indices.size() / 3);
    for (size_t i = 0; i < triangles.size(); ++i) {
        Triangle& triangle = triangles[i];
        for (int c = 0; c < 3; ++c) triangle[c] = mesh.indices[3 * i + c];
        const auto first = std::ranges::min_element(
            triangle, [&](uint32_t a, uint32_t b) { return corner(mesh, a) < corner(mesh, b); });
        std::ranges::rotate(triangle, first);
    }
    std::ranges::stable_sort(triangles, [&](const Triangle& a, const Triangle& b) {
        return corners(mesh, a) < corners(mesh, b);
    });
    mesh.indices.clear();
    for (const Triangle& triangle : triangles) {
        mesh.indices.insert(mesh.indices.end(), triangle.begin(), triangle.end());
    }
}

/// A hash of an instance's contents, independent of indices. Precondition: the mesh is sorted.
uint64_t hash_of(const Scene& scene, const MeshInstance& instance) {
    const Mesh& mesh = scene.meshes[instance.mesh];
    ContentHash hash;
    hash.add(instance.world_from_mesh);
    for (const uint32_t vertex : mesh.indices) hash.add(mesh.positions[vertex]);
    const Material& material = scene.materials[mesh.material];
    hash.add(material.base_color);
    hash.add(material.emission);
    hash.add(material.alpha_mode);
    hash.add(material.is_double_sided);
    return hash.value();
}

/// Sorts elements by their keys.
template <class T>
void sort_by(std::vector<T>& elements, const std::vector<uint64_t>& keys) {
    std::vector<size_t> order(elements.size());
    std::iota(order.begin(), order.end(), size_t{0});
    std::ranges::stable_sort(order, {}, [&](size_t i) { return keys[i]; });
    std::vector<T> sorted;
    for (const size_t i : order) sorted.push_back(std::move(elements[i]));
    elements = std::move(sorted);
}

template <class T, class Hash>
std::vector<uint64_t> keys_of(const std::vector<T>& elements, const Hash& hash) {
    std::vector<uint64_t> keys;
    for (const T& element : elements) keys.push_back(hash(element));
    return keys;
}

}  // namespace

Scene canonical_scene(const Scene& scene) {
    Scene result = scene;
    std::erase_if(result.instances, [](const MeshInstance& i) { return !i.contributes_gi; });
    for (Mesh& mesh : result.meshes) sort_triangles(mesh);
    sort_by(result.instances, keys_of(result.instances, [&](const MeshInstance& instance) {
                return hash_of(result, instance);
            }));
    const auto light_keys = keys_of(result.lights, [](const Light& light) {
        ContentHash hash;
        hash.add(light);
        return hash.value();
    });
    sort_by(result.lights, light_keys);
    sort_by(result.light_names, light_keys);
    result.cameras.clear();
    result.probe_groups.clear();
    return result;
}

}  // namespace tetralight
