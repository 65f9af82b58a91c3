// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/virtual_offset.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <vector>

namespace tetralight {
namespace {

/// A surface that is hit from behind: its front side may be outside geometry.
struct Exit {
    float distance = 0.0f;
    glm::vec3 direction{0.0f};
    glm::vec3 front{0.0f};  ///< on the front side, where a ray can start
};

class ExitSearch {
  public:
    ExitSearch(const TraceScene& trace_scene, glm::vec3 position,
               const VirtualOffsetSettings& settings)
        : trace_scene_(trace_scene), position_(position), settings_(settings) {}

    [[nodiscard]] std::vector<Exit> exits() const {
        std::vector<Exit> exits;
        const auto nearest = trace_scene_.nearest_surface(position_);
        if (nearest && *nearest != position_) {
            add_exit(glm::normalize(*nearest - position_), exits);
        }
        for (const glm::vec3& direction : probe_visibility_directions()) add_exit(direction, exits);
        std::ranges::stable_sort(exits, {}, &Exit::distance);
        return exits;
    }

    /// The position at the margin in front of an exit, or half way to the next surface if nearer.
    [[nodiscard]] glm::vec3 position_at(const Exit& exit) const {
        const auto next =
            trace_scene_.intersect({exit.front, exit.direction, 2.0f * settings_.margin});
        const float distance =
            next ? 0.5f * glm::distance(next->position, exit.front) : settings_.margin;
        return exit.front + distance * exit.direction;
    }

  private:
    /// Includes double-sided surfaces: `is_inside` rejects positions between them.
    void add_exit(glm::vec3 direction, std::vector<Exit>& exits) const {
        const auto surface = trace_scene_.intersect({position_, direction, settings_.max_distance});
        if (!surface || !surface->is_from_behind) return;
        // The normal points to the side that the ray came from.
        const glm::vec3 front = TraceScene::ray_origin(*surface, -surface->geometric_normal);
        exits.push_back({glm::distance(position_, surface->position), direction, front});
    }

    const TraceScene& trace_scene_;
    glm::vec3 position_;
    const VirtualOffsetSettings& settings_;
};

}  // namespace

std::optional<glm::vec3> find_virtual_offset(const TraceScene& trace_scene, glm::vec3 position,
                                             const VirtualOffsetSettings& settings) {
    const ExitSearch exit_search(trace_scene, position, settings);
    for (const Exit& exit : exit_search.exits()) {
        const glm::vec3 candidate = exit_search.position_at(exit);
        if (glm::distance(candidate, position) > settings.max_distance) continue;
        if (!probe_visibility(trace_scene, candidate).is_inside(settings.min_validity))
            return candidate - position;
    }
    return std::nullopt;
}

}  // namespace tetralight
