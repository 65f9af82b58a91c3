// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

#include <tetralight/base/result.h>
#include <tetralight/reflection/reflections.h>

namespace tetralight {

/// Writes the scene at `scene_path` with the cube of a probe as its image-based light
/// (EXT_lights_image_based), a .glb file; the old file stays whole on failure. Faces, rows and
/// coefficients are as Babylon.js shows them at the right places, in its left-handed scenes
/// (docs/reflections.md).
///
/// Returns the light's intensity, by which its images and coefficients are divided: 1, or a power
/// of two if the brightest channel is above 255, the most that the images hold; and the errors of
/// `make_image_based_light_glb` and of writing. Precondition: the probe exists.
[[nodiscard]] Result<float> write_reflection_glb(const std::string& path,
                                                 const std::string& scene_path,
                                                 const ReflectionsView& reflections, size_t probe,
                                                 const std::string& light_name);

}  // namespace tetralight
