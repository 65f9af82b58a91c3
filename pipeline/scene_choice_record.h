// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tetralight/bake/scene/scene.h>

namespace tetralight {

/// Records in metadata which scene of its file was read, in which pose and unit, by the names of
/// the command's settings. What has its default is left out.
template <class Json>
void record_scene_choice(const SceneChoice& choice, Json& metadata) {
    if (!choice.scene_name.empty()) metadata["scene_name"] = choice.scene_name;
    if (choice.time_seconds) metadata["time"] = *choice.time_seconds;
    if (!choice.animation.empty()) metadata["animation"] = choice.animation;
    if (choice.is_in_watts) metadata["light_unit"] = "watt";
}

/// The members that `record_scene_choice` sets: the hash of the scene tells scenes apart.
inline constexpr const char* kSceneChoiceMembers[] = {"scene_name", "time", "animation",
                                                      "light_unit"};

}  // namespace tetralight
