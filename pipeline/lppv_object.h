// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <tetralight/bake/scene/scene.h>
#include <tetralight/base/result.h>
#include <tetralight/lppv/lppv_grid.h>

namespace tetralight {

/// What a proxy volume wraps in a scene.
struct SceneObject {
    /// For messages: `node "ship"`.
    std::string place;
    glm::dmat4 world_from_object{1.0};
    /// Boxes of `instances`.
    std::vector<LppvPart> parts;
    std::vector<uint32_t> instances;

    [[nodiscard]] LppvObject view() const { return {world_from_object, parts}; }
};

/// The grid that wraps an object. Errors as `make_lppv_grid`; they begin with the object's place.
[[nodiscard]] Result<LppvGrid> make_object_grid(const SceneObject& object,
                                                const LppvSettings& settings);

/// The node of that name with its meshes, and those of its children whose `light_probes` is
/// `proxy_volume`. Errors: there is no such node, or several of that name.
[[nodiscard]] Result<SceneObject> find_object(const Scene& scene, const std::string& name);

/// All things that move and ask for a proxy volume, each with the children that share it: the
/// topmost node of those that ask is the object.
[[nodiscard]] std::vector<SceneObject> find_proxy_objects(const Scene& scene);

}  // namespace tetralight
