// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include <tetralight/cli/common.h>
#include <tetralight/cli/view_options.h>
#include <tetralight/render/ball_view.h>
#include <tetralight/render/mesh_ball.h>

namespace tetralight::cli {

/// The ball, its light, and its position.
struct BallOptions {
    MeshBallSettings settings;
    BallLight light = BallLight::Probes;
    Specular specular = Specular::Off;

    /// Keeps a reference.
    explicit BallOptions(const Values& values);

    /// Puts the ball at the center of the probes unless the user placed it, and returns a camera
    /// that sees the ball unless the user placed the camera. `scene` may be null.
    [[nodiscard]] Camera place(const ProbeVolumeView& volume, const SceneShader* scene,
                               const ViewOptions& view);

  private:
    void check_center() const;
    [[nodiscard]] std::vector<glm::dvec3> centers(const ProbeVolumeView& volume,
                                                  const Box<glm::vec3>& bounds) const;
    [[nodiscard]] std::vector<double> radii(const ProbeVolumeView& volume,
                                            const Box<glm::vec3>& bounds) const;

    const Values* values_;
    bool has_center_;
    bool has_radius_;
};

}  // namespace tetralight::cli
