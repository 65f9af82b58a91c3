// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <tetralight/base/box.h>
#include <tetralight/base/result.h>
#include <tetralight/engines/light_difference.h>
#include <tetralight/probes/probe_volume.h>

// Probe volumes in the formats of engines and tools.
//
//     const ExportTarget* target = find_export_target("godot");
//     auto exported = target->make(volume, {.name = "court"});
//     if (!exported) return exported.error();
//     for (const ExportedFile& file : exported->files) ...

namespace tetralight {

struct ExportSettings {
    /// Of the files, without extension: files that name each other use it.
    std::string name = "probes";
    /// World box of grids; the box of the probes if absent.
    std::optional<Box<glm::dvec3>> bounds = {};
    /// Cells of grids along each axis; 0: by `spacing`.
    std::array<uint32_t, 3> resolution{};
    /// Largest distance between the centers of a grid's cells, metres; 0: the mean spacing of the
    /// probes.
    double spacing = 0.0;
    /// World positions of targets that hold the light of places; empty: of every probe, or of the
    /// center of the probes' box where the format holds one place.
    std::vector<glm::dvec3> places = {};
};

struct ExportedFile {
    /// With its extension. That of the first file is replaced by the output the user names.
    std::string name;
    std::string content;
};

struct ExportedVolume {
    std::vector<ExportedFile> files;
    /// What the format does not hold of this volume, beside `ExportTarget::loses`: sentences.
    std::vector<std::string> notes;
    /// Of targets that show other light than the volume's.
    std::optional<LightDifference> difference;
};

/// What an export can be made for.
struct ExportTarget {
    const char* name;
    /// Of the first file, such as ".tres".
    const char* extension;
    const char* help;
    /// What is lost of any volume; empty if nothing is that the target could show.
    const char* loses;
    /// Whether `bounds`, `resolution` and `spacing` count.
    bool has_grid = false;
    /// Whether `places` counts.
    bool has_places = false;
    /// Light is what queries of this view read: without its compact probes, the floats.
    /// Returns invalid_argument if the volume cannot be written in this format, or a setting does
    /// not fit; `Error::field` is the member of `ExportSettings`, or empty.
    Result<ExportedVolume> (*make)(const ProbeVolumeView& volume, const ExportSettings& settings);
};

/// All targets, in the order of the choices of `tetralight export --as`.
[[nodiscard]] std::span<const ExportTarget> export_targets() noexcept;

/// None if no target has this name.
[[nodiscard]] const ExportTarget* find_export_target(std::string_view name) noexcept;

}  // namespace tetralight
