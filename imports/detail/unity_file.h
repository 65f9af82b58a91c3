// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include <tetralight/base/result.h>

namespace tetralight::detail {

/// What objects of a file are called by; 0 is none.
using UnityId = int64_t;

struct UnityObject {
    std::string name;
    bool is_active = true;
    /// The object belongs to a prefab instance, and the file has nothing of it.
    bool is_stripped = false;
};

/// Parts of the transform of an object in its parent, in Unity's axes.
struct UnityTransform {
    UnityId object = 0;
    UnityId parent = 0;
    glm::dvec3 position{0.0};
    /// A unit quaternion: x, y, z, w.
    glm::dvec4 rotation{0.0, 0.0, 0.0, 1.0};
    glm::dvec3 scale{1.0};
    bool is_stripped = false;
    size_t line = 0;
};

/// A LightProbeGroup.
struct UnityProbes {
    UnityId id = 0;
    UnityId object = 0;
    bool is_enabled = true;
    bool dering = false;
    /// In the space of the object, in Unity's axes.
    std::vector<glm::dvec3> positions;
    size_t line = 0;
};

/// What probes need of a scene or prefab of Unity.
struct UnityFile {
    std::unordered_map<UnityId, UnityObject> objects;
    std::unordered_map<UnityId, UnityTransform> transforms;
    /// The transform of each object that has one.
    std::unordered_map<UnityId, UnityId> transform_of_object;
    std::vector<UnityProbes> probes;
    size_t prefab_instance_count = 0;
};

/// Reads the text of a scene or prefab. Errors begin with the line.
[[nodiscard]] Result<UnityFile> parse_unity_file(std::string_view text);

}  // namespace tetralight::detail
