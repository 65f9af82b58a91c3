// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <tetralight/probes/interpolate.h>
#include <tetralight/probes/locate.h>
#include <tetralight/probes/probe_volume.h>
#include <tetralight/probes/receiver.h>

namespace tetralight::conformance {

enum class Precision : uint8_t {
    Half,  ///< as the file has it
    Full,  ///< without `compact`
};

/// Options of a query, as docs/how_to_query.md names them.
struct VectorOptions {
    Precision precision = Precision::Half;
    OutsideHull outside;
    Receiver receiver;
    /// None: positions are not on surfaces.
    std::optional<float> normal_offset;
    /// Empty: the light of the file.
    std::vector<float> layer_weights;

    bool operator==(const VectorOptions&) const = default;
};

/// A position and what it was chosen for.
struct VectorPosition {
    std::string kind;
    glm::vec3 position{0.0f};
    /// Used with `normal_offset`.
    glm::vec3 normal{0.0f};
};

struct VectorAnswer {
    VectorPosition at;
    CellLocation location;
    /// The same with the weights that the light was blended with.
    CellLocation visible;
    InterpolatedProbe light;
    /// One a normal.
    std::vector<glm::vec3> irradiance;
};

/// The normals that answers have irradiance for.
[[nodiscard]] std::span<const glm::vec3> vector_normals();

/// A volume as these options read it. Precondition: as many layer weights as layers, or none.
[[nodiscard]] ProbeVolume volume_with_options(const ProbeVolumeView& volume,
                                              const VectorOptions& options);

/// Precondition: the volume is that of `volume_with_options`.
[[nodiscard]] VectorAnswer answer_vector(const ProbeVolumeView& volume,
                                         const VectorOptions& options, const VectorPosition& at);

/// The vertices of the answer's cell; empty without a cell.
[[nodiscard]] std::vector<uint32_t> probes_of(const ProbeVolumeView& volume,
                                              const CellLocation& location);

}  // namespace tetralight::conformance
