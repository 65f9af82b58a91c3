// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/virtual_offset.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <vector>

namespace tetralight {
namespace {

/// A back face, through which a way may lead out.
struct Exit {
    float distance = 0.0f;
    glm::vec3 direction{0.0f};
    glm::vec3 beyond{0.0f};  ///< on its front, where a ray can start
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
            look(glm::normalize(*nearest - position_), exits);
        }
        for (const glm::vec3& direction : probe_visibility_directions()) look(direction, exits);
        std::ranges::stable_sort(exits, {}, &Exit::distance);
        return exits;
    }

    /// The margin beyond an exit, or half of the room where that is less.
    [[nodiscard]] glm::vec3 place_beyond(const Exit& exit) const {
        const auto next =
            trace_scene_.intersect({exit.beyond, exit.direction, 2.0f * settings_.margin});
        const float room =
            next ? 0.5f * glm::distance(next->position, exit.beyond) : settings_.margin;
        return exit.beyond + room * exit.direction;
    }

  private:
    /// Double-sided surfaces count too: those who lie among them are told by `is_inside`.
    void look(glm::vec3 direction, std::vector<Exit>& exits) const {
        const auto surface = trace_scene_.intersect({position_, direction, settings_.max_distance});
        if (!surface || !surface->is_from_behind) return;
        // The normal is on the side that the ray came from.
        const glm::vec3 beyond = TraceScene::ray_origin(*surface, -surface->geometric_normal);
        exits.push_back({glm::distance(position_, surface->position), direction, beyond});
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
        const glm::vec3 place = exit_search.place_beyond(exit);
        if (glm::distance(place, position) > settings.max_distance) continue;
        if (!probe_visibility(trace_scene, place).is_inside(settings.min_validity))
            return place - position;
    }
    return std::nullopt;
}

}  // namespace tetralight
