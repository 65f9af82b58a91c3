// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/lightmap/lightmap_texels.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <optional>
#include <utility>

#include <tetralight/bake/parallel.h>
#include <tetralight/bake/probe_visibility.h>
#include <tetralight/bake/sampling/sampling.h>
#include <tetralight/bake/scene/scene_bounds.h>
#include <tetralight/base/str_cat.h>

namespace tetralight {
namespace {

/// Of the rays that hit a surface from behind, double-sided ones included, inside geometry. Higher
/// than the limit of single-sided surfaces, because backs of leaves are seen from free space too.
constexpr float kMaxBehindFraction = 0.75f;

/// Every second of the directions above a surface tells whether it is inside geometry.
constexpr size_t kDirectionStep = 2;

/// A place of a texel, in render space.
struct Place {
    glm::dvec3 position{0.0};  ///< on the triangle, world
    glm::vec3 origin{0.0f};    ///< in front of it, where rays start
    glm::vec3 normal{0.0f};    ///< shading normal
};

/// Fractions of rays above a place.
struct PlaceValidity {
    float front = 1.0f;   ///< that hit front faces, blended ones or nothing
    float behind = 0.0f;  ///< that hit a surface from behind, double-sided ones included
    bool is_inside = false;
};

class InstanceTexels {
  public:
    InstanceTexels(const Scene& scene, const TraceScene& trace_scene, uint32_t instance,
                   const LightmapLayout& layout, const LightmapTexelSettings& settings)
        : scene_(scene),
          trace_scene_(trace_scene),
          instance_(scene.instances[instance]),
          mesh_(scene.meshes[instance_.mesh]),
          settings_(settings),
          texel_size_(1.0 / (layout.texels_per_meter * double{instance_.lightmap.scale})),
          linear_(instance_.world_from_mesh),
          handedness_(glm::determinant(linear_) < 0.0 ? -1.0 : 1.0) {}

    /// Appends the texels [begin, end) of the map.
    void add(const TexelMap& map, size_t begin, size_t end, LightmapTexels& texels) const {
        for (size_t i = begin; i < end; ++i) add(map, map.texels[i], texels);
    }

  private:
    using Corners = std::array<glm::dvec3, 3>;

    [[nodiscard]] Corners corners_of(uint32_t triangle) const {
        const uint32_t* indices = mesh_.indices.data() + size_t{3} * triangle;
        return {world_position(instance_, mesh_.positions[indices[0]]),
                world_position(instance_, mesh_.positions[indices[1]]),
                world_position(instance_, mesh_.positions[indices[2]])};
    }

    /// Unit vertex normals in the world; the normal of the triangle where there is none that points
    /// to its front.
    [[nodiscard]] std::array<glm::dvec3, 3> normals_of(uint32_t triangle,
                                                       glm::dvec3 geometric) const {
        std::array<glm::dvec3, 3> normals{geometric, geometric, geometric};
        if (mesh_.normals.empty()) return normals;
        const glm::dmat3 cofactor = glm::transpose(glm::inverse(linear_));
        const uint32_t* indices = mesh_.indices.data() + size_t{3} * triangle;
        for (size_t i = 0; i < 3; ++i) {
            const glm::dvec3 normal = cofactor * glm::dvec3(mesh_.normals[indices[i]]);
            const double length = glm::length(normal);
            if (glm::dot(normal, geometric) > 0.01 * length) normals[i] = normal / length;
        }
        return normals;
    }

    [[nodiscard]] Place place_at(const ChartPoint& point) const {
        const Corners corners = corners_of(point.triangle);
        const glm::dvec3 u = corners[1] - corners[0], v = corners[2] - corners[0];
        const glm::dvec3 geometric = handedness_ * glm::normalize(glm::cross(u, v));
        const glm::dvec2 weights(point.barycentric);
        const std::array<double, 3> w{1.0 - weights.x - weights.y, weights.x, weights.y};
        const std::array<glm::dvec3, 3> normals = normals_of(point.triangle, geometric);
        Place place;
        place.position = corners[0] + weights.x * u + weights.y * v;
        glm::dvec3 normal(0.0), raised(0.0);
        for (size_t i = 0; i < 3; ++i) {
            normal += w[i] * normals[i];
            // Onto the tangent plane of the vertex, if the surface lies above the triangle.
            const double below = std::min(0.0, glm::dot(place.position - corners[i], normals[i]));
            raised -= w[i] * below * normals[i];
        }
        place.normal = glm::vec3(glm::normalize(normal));
        place.origin = in_front(place.position, corners, glm::vec3(geometric));
        const glm::vec3 smooth(raised);
        if (smooth != glm::vec3(0.0f) &&
            !trace_scene_.occluded({place.origin, 1.01f * smooth, 1.0f})) {
            place.origin += smooth;
        }
        return place;
    }

    /// A position of a triangle, moved by the bound of its rounding error as a ray sees it.
    [[nodiscard]] glm::vec3 in_front(const glm::dvec3& position, const Corners& corners,
                                     glm::vec3 normal) const {
        float extent = 0.0f;
        for (const glm::dvec3& corner : corners) {
            const glm::vec3 local = glm::abs(trace_scene_.render_from_world(corner));
            extent = std::max({extent, local.x, local.y, local.z});
        }
        return trace_scene_.render_from_world(position) + extent * 0x1p-20f * normal;
    }

    /// True for glass and decals, whose backs bound nothing that is solid.
    [[nodiscard]] bool is_blended(uint32_t geometry) const {
        const uint32_t material = trace_scene_.material(geometry);
        return material != kNoIndex && scene_.materials[material].alpha_mode == AlphaMode::Blend;
    }

    [[nodiscard]] PlaceValidity validity_at(glm::vec3 origin, glm::vec3 normal) const {
        uint32_t count = 0, back_faces = 0, behind = 0;
        const auto directions = probe_visibility_directions();
        for (size_t i = 0; i < directions.size(); i += kDirectionStep) {
            const float side_of = glm::dot(directions[i], normal) > 0.0f ? 1.0f : -1.0f;
            const auto side = trace_scene_.intersect_side({origin, side_of * directions[i]});
            ++count;
            if (!side || is_blended(side->geometry)) continue;
            back_faces += side->is_back_face;
            behind += side->is_from_behind;
        }
        const auto total = static_cast<float>(count);
        PlaceValidity validity;
        validity.front = 1.0f - static_cast<float>(back_faces) / total;
        validity.behind = static_cast<float>(behind) / total;
        validity.is_inside =
            validity.front < settings_.min_validity || validity.behind > kMaxBehindFraction;
        return validity;
    }

    /// The nearest place in front of a back face that the texel meets along its surface.
    [[nodiscard]] std::optional<glm::vec3> pushed_out(const Place& center, float reach) const {
        const glm::mat3 frame = frame_around(center.normal);
        std::optional<glm::vec3> best;
        float best_distance = std::numeric_limits<float>::infinity();
        constexpr int kDirections = 8;
        for (int i = 0; i < kDirections; ++i) {
            const float angle = 6.2831853f * static_cast<float>(i) / kDirections;
            const glm::vec3 direction = std::cos(angle) * frame[0] + std::sin(angle) * frame[1];
            const auto surface = trace_scene_.intersect({center.origin, direction, reach});
            if (!surface || !surface->is_from_behind) continue;
            const glm::vec3 front = TraceScene::ray_origin(*surface, -surface->geometric_normal);
            const float distance = glm::distance(front, center.origin);
            if (distance >= best_distance) continue;
            const glm::vec3 beyond = front + 0.05f * reach * direction;
            if (trace_scene_.occluded({front, beyond - front, 1.0f})) continue;
            if (validity_at(beyond, center.normal).is_inside) continue;
            best = beyond;
            best_distance = distance;
        }
        return best;
    }

    /// The places of a texel outside geometry, and the fraction of its rays that hit front faces.
    struct FreePlaces {
        std::vector<glm::vec3> origins;
        float front = 0.0f;
    };

    /// Those on one side of the walls in the texel: the side that sees fewer surfaces from behind.
    [[nodiscard]] FreePlaces free_places(const TexelMap& map, const TexelMap::Texel& texel,
                                         const Place& center) const {
        FreePlaces found;
        size_t first = 0;
        float least_behind = 2.0f;
        const auto add_place = [&](const Place& place) {
            const PlaceValidity validity = validity_at(place.origin, place.normal);
            found.front += validity.front;
            if (validity.is_inside) return;
            if (validity.behind < least_behind) {
                least_behind = validity.behind;
                first = found.origins.size();
            }
            found.origins.push_back(place.origin);
        };
        const auto samples = map.samples(texel);
        if (samples.empty()) add_place(center);
        for (const ChartPoint& sample : samples) add_place(place_at(sample));
        found.front /= static_cast<float>(std::max<size_t>(1, samples.size()));
        if (found.origins.empty()) return found;
        const glm::vec3 seen_from = found.origins[first];
        std::erase_if(found.origins, [&](const glm::vec3& origin) {
            return origin != seen_from &&
                   trace_scene_.occluded({seen_from, origin - seen_from, 1.0f});
        });
        return found;
    }

    void add(const TexelMap& map, const TexelMap::Texel& texel, LightmapTexels& texels) const {
        const Place center = place_at(map.center(texel));
        const glm::vec3 position = trace_scene_.render_from_world(center.position);
        FreePlaces free = free_places(map, texel, center);
        if (free.origins.empty()) {
            const auto reach = static_cast<float>(0.75 * texel_size_);
            if (const auto out = pushed_out(center, reach)) free.origins.push_back(*out);
        }
        texels.positions.push_back(center.position);
        texels.surfaces.push_back({center.normal, static_cast<uint32_t>(texels.origins.size()),
                                   static_cast<uint32_t>(free.origins.size())});
        for (const glm::vec3& origin : free.origins) texels.origins.push_back(origin - position);
        texels.validity.push_back(free.front);
    }

    const Scene& scene_;
    const TraceScene& trace_scene_;
    const MeshInstance& instance_;
    const Mesh& mesh_;
    const LightmapTexelSettings& settings_;
    double texel_size_;  ///< metres
    glm::dmat3 linear_;
    double handedness_;
};

/// A part of the texels of an instance.
struct Block {
    uint32_t instance = 0;
    size_t begin = 0, end = 0;
};

constexpr size_t kBlockSize = 1024;

void append(const LightmapTexels& part, LightmapTexels& all) {
    const auto first_origin = static_cast<uint32_t>(all.origins.size());
    for (TexelSurfaces::Texel surface : part.surfaces) {
        surface.first_origin += first_origin;
        all.surfaces.push_back(surface);
    }
    all.positions.insert(all.positions.end(), part.positions.begin(), part.positions.end());
    all.origins.insert(all.origins.end(), part.origins.begin(), part.origins.end());
    all.validity.insert(all.validity.end(), part.validity.begin(), part.validity.end());
}

}  // namespace

std::vector<TexelMap> make_texel_maps(const Scene& scene, const LightmapLayout& layout,
                                      const LightmapTexelSettings& settings) {
    std::vector<TexelMap> maps(layout.packings.size());
    parallel_for(maps.size(), settings.thread_count, [&](size_t i) {
        const LightmapPacking& packing = layout.packings[i];
        maps[i] = make_texel_map(scene.meshes[packing.mesh], packing, settings.grid);
    });
    return maps;
}

Result<LightmapTexels> make_lightmap_texels(const Scene& scene, const TraceScene& trace_scene,
                                            const LightmapLayout& layout,
                                            std::span<const TexelMap> maps,
                                            const LightmapTexelSettings& settings) {
    LightmapTexels texels;
    std::vector<Block> blocks;
    uint64_t count = 0;
    for (uint32_t i = 0; i < layout.places.size(); ++i) {
        texels.first_texel.push_back(static_cast<uint32_t>(count));
        if (!layout.places[i].has_lightmap()) continue;
        const size_t size = maps[layout.places[i].packing].texels.size();
        for (size_t begin = 0; begin < size; begin += kBlockSize) {
            blocks.push_back({i, begin, std::min(size, begin + kBlockSize)});
        }
        count += size;
        if (count * settings.grid * settings.grid >= kNoIndex) {
            return Error{ErrorCode::OutOfResources, "texels_per_meter", "",
                         str_cat("the lightmaps have more than ", kNoIndex,
                                 " places where light is sampled; lower the texels per metre")};
        }
    }
    texels.first_texel.push_back(static_cast<uint32_t>(count));
    std::vector<LightmapTexels> parts(blocks.size());
    parallel_for(blocks.size(), settings.thread_count, [&](size_t i) {
        const Block& block = blocks[i];
        const InstanceTexels instance(scene, trace_scene, block.instance, layout, settings);
        instance.add(maps[layout.places[block.instance].packing], block.begin, block.end, parts[i]);
    });
    for (const LightmapTexels& part : parts) append(part, texels);
    return texels;
}

}  // namespace tetralight
