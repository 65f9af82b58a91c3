// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>

#include <tetralight/bake/scene/scene.h>
#include <tetralight/bake/scene/scene_bounds.h>

namespace tetralight::bench {

/// Appends a quad whose front faces along u × v.
void append_quad(Mesh& mesh, glm::vec3 corner, glm::vec3 u, glm::vec3 v);

/// A closed box as one mesh, with faces towards the outside.
[[nodiscard]] Mesh box_mesh(const WorldBox& box);

/// Adds an instance of a mesh, in place, with a material of its own.
void add_mesh(Scene& scene, Mesh mesh, const Material& material);

}  // namespace tetralight::bench
