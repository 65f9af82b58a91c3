// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <tetralight/bake/scene/scene.h>
#include <tetralight/base/result.h>
#include <tetralight/lppv/lppv_grid.h>

namespace tetralight {

/// An object of a scene that a proxy volume wraps.
struct SceneObject {
    /// The name in messages: `node "ship"`.
    std::string place;
    glm::dmat4 world_from_object{1.0};
    /// Boxes of `instances`.
    std::vector<LppvPart> parts;
    std::vector<uint32_t> instances;

    [[nodiscard]] LppvObject view() const { return {world_from_object, parts}; }
};

/// The grid that wraps an object. Errors of `make_lppv_grid`, with the object's place before them.
[[nodiscard]] Result<LppvGrid> make_object_grid(const SceneObject& object,
                                                const LppvSettings& settings);

/// The node of that name with its meshes, and those of its children whose `light_probes` is
/// `proxy_volume`. Returns not_found if there is no node of that name, invalid_argument if there
/// are several.
[[nodiscard]] Result<SceneObject> find_object(const Scene& scene, const std::string& name);

/// All moving objects with `light_probes` = `proxy_volume`: the topmost such node, with those of
/// its children that share the volume.
[[nodiscard]] std::vector<SceneObject> find_proxy_objects(const Scene& scene);

}  // namespace tetralight
