// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <tetralight/cli/common.h>
#include <tetralight/cli/layer_report.h>
#include <tetralight/cli/walk_facts.h>
#include <tetralight/pipeline/walls_metadata.h>
#include <tetralight/probes/build/store_visibility.h>
#include <tetralight/probes/probe_file.h>

namespace tetralight::cli {

/// Tetrahedra that are nearly flat.
struct Slivers {
    uint64_t below_1e3 = 0;  ///< of quality below 1e-3
    uint64_t below_1e6 = 0;  ///< below 1e-6
};

/// One section of the file.
struct SectionFacts {
    std::string name;
    uint64_t bytes = 0;
    /// Queries read it; the others are for tools and may stay on disk.
    bool is_resident = false;
};

/// What `info` reports of a volume in addition to the counts of every command.
struct VolumeFacts {
    std::string path;
    Json counts;
    Json groups;
    Json lights;
    Json layers;
    /// With the weights that the layers have now.
    NoiseStatistics noise;
    /// Null if all probes are on all rendering layers.
    Json rendering_layers;
    bool has_transfer = false;
    Json bounds;
    Json made_with;
    bool is_baked = false;
    double radial_fraction = 0.0;
    /// None in volumes that have no tetrahedra.
    std::optional<Slivers> slivers;
    /// None in volumes without probes.
    std::optional<WalkFacts> walks;
    /// None in volumes that know no walls.
    std::optional<VisibilityFacts> visibility;
    /// None in volumes whose bake did not record it.
    std::optional<WallsMetadata> walls;
    uint64_t seed_count = 0;
    std::vector<SectionFacts> sections;

    [[nodiscard]] uint64_t bytes() const;
    [[nodiscard]] uint64_t resident_bytes() const;
};

[[nodiscard]] VolumeFacts make_volume_facts(const std::string& path, const ProbeFile& file);

/// For machines.
[[nodiscard]] Json to_json(const VolumeFacts& facts);

/// For people: aligned lines without a line break at the end.
[[nodiscard]] std::string to_text(const VolumeFacts& facts, const ProbeVolumeView& volume);

}  // namespace tetralight::cli
