// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tetralight/bake/scene/detail/gltf_document.h>
#include <tetralight/bake/scene/detail/part_list.h>
#include <tetralight/base/result.h>

namespace tetralight::detail {

struct GltfSky {
    Environment environment;
    PartList parts;
};

/// Texels along a side of the largest faces that are read.
inline constexpr uint32_t kLargestSkyFace = 4096;

/// Rows of the sky that faces of this size become.
[[nodiscard]] uint32_t sky_rows(uint32_t face_size);

/// The sky of an image-based light: the faces of its sharpest level; without images that can be
/// decoded, its irradiance coefficients, which is told in `parts`. Faces, coefficients and rotation
/// are in the frame in which Babylon.js reads them: x of glTF's world is mirrored, and images start
/// with their last row (docs/reflections.md).
///
/// Returns corrupt if faces are not squares of one size, numbers are out of range, or there are
/// neither images nor nine coefficients; unsupported for too large faces; the errors of reading the
/// images, but for formats that are not known.
[[nodiscard]] Result<GltfSky> read_image_based_light(const GltfDocument& document,
                                                     const GltfImageBasedLight& light);

}  // namespace tetralight::detail
