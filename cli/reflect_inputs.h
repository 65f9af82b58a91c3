// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <tetralight/base/result.h>
#include <tetralight/cli/scene_options.h>
#include <tetralight/pipeline/bake_reflections.h>

namespace tetralight::cli {

/// What a bake of reflection probes reads, from the settings of `reflect`.
struct ReflectInputs {
    SceneOptions scene_options;
    BakeReflectionsSettings settings;
    std::vector<std::string> names;  ///< empty: all places
    std::string places_path;         ///< empty: those of the scene
    std::string lightmaps_path;      ///< empty: none
    std::vector<ReflectionPlace> given_places;

    /// Throws a `UsageError` if settings do not go together.
    explicit ReflectInputs(const Values& values);

    /// The files that are read; empty ones are none.
    [[nodiscard]] std::vector<std::string> paths() const;

    /// The places to bake. Returns not_found if none has one of the names.
    [[nodiscard]] Result<std::vector<ReflectionPlace>> places(const Scene& scene) const;

    /// With the name of the file that an error of the bake is about.
    [[nodiscard]] Error in_file(const Error& error) const;

  private:
    [[nodiscard]] Result<std::vector<ReflectionPlace>> read_places() const;
};

}  // namespace tetralight::cli
