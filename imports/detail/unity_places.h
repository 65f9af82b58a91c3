// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/mat4x4.hpp>
#include <string>
#include <unordered_map>
#include <vector>

#include <tetralight/base/result.h>
#include <tetralight/imports/detail/unity_file.h>

namespace tetralight::detail {

/// An object of Unity in the world.
struct UnityPlace {
    /// In Unity's axes.
    glm::dmat4 world_from_object{1.0};
    /// False if the object or a parent is not active.
    bool is_active = true;
    /// False if the object or a parent belongs to a prefab instance.
    bool is_in_file = true;
};

/// Places objects of a file, following their parents.
class UnityPlaces {
  public:
    /// Precondition: the file outlives this object.
    explicit UnityPlaces(const UnityFile& file) : file_(file) {}

    /// Where an object is. Returns corrupt, with the IDs, if the object, its transform or a parent
    /// is not in the file, or if parents form a circle. Each transform is followed once.
    [[nodiscard]] Result<UnityPlace> place(UnityId object);

    /// The names of the parents and of the object: "Level/Hall". At most a little more than
    /// `kLongestGroupName` bytes. Precondition: `place(object)` has a value.
    [[nodiscard]] std::string path_of(UnityId object) const;

  private:
    [[nodiscard]] Result<UnityPlace> place_transform(UnityId transform);
    [[nodiscard]] Result<std::vector<UnityId>> unplaced_parents(UnityId transform) const;
    [[nodiscard]] Result<UnityPlace> place_in(const UnityPlace& parent,
                                              const UnityTransform& transform) const;

    const UnityFile& file_;
    std::unordered_map<UnityId, UnityPlace> placed_;
};

}  // namespace tetralight::detail
