// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include <tetralight/probes/interpolate.h>

namespace tetralight {

/// The arrays of a batch that has one object at all of its positions.
class UniformReceiver {
  public:
    /// Sets walls, rendering layers and radii of a batch for its positions. Its arrays are valid
    /// until the next call, which reuses their memory.
    void set(const Receiver& receiver, InterpolationBatch& batch) {
        const size_t count = batch.positions.size();
        const bool has_layers = receiver.rendering_layers != kAllRenderingLayers;
        rendering_layers_.assign(has_layers ? count : 0, receiver.rendering_layers);
        radii_.assign(receiver.radius != 0.0f ? count : 0, receiver.radius);
        batch.walls = receiver.walls;
        batch.rendering_layers = rendering_layers_;
        batch.radii = radii_;
    }

  private:
    std::vector<uint32_t> rendering_layers_;
    std::vector<float> radii_;
};

}  // namespace tetralight
