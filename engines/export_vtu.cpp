// SPDX-License-Identifier: Apache-2.0
// VTK's XML format of unstructured grids, with appended raw data: "VTK File Formats for VTK Version
// 4.2", and the compatible version 1.0 with 64-bit sizes.
#include <array>
#include <cmath>
#include <numbers>

#include <tetralight/base/str_cat.h>
#include <tetralight/engines/detail/probe_light.h>
#include <tetralight/engines/detail/targets.h>

namespace tetralight::detail {
namespace {

template <class Number>
constexpr const char* kVtkType = nullptr;
template <>
constexpr const char* kVtkType<float> = "Float32";
template <>
constexpr const char* kVtkType<double> = "Float64";
template <>
constexpr const char* kVtkType<int64_t> = "Int64";
template <>
constexpr const char* kVtkType<int32_t> = "Int32";
template <>
constexpr const char* kVtkType<uint8_t> = "UInt8";

/// The elements of a file, and the data that they refer to.
struct VtuFile {
    std::string elements;
    std::string data;

    template <class Number>
    void array(const char* name, size_t components, const std::vector<Number>& values) {
        elements += str_cat("        <DataArray type=\"", kVtkType<Number>, "\" Name=\"", name,
                            "\" NumberOfComponents=\"", components,
                            "\" format=\"appended\" offset=\"", data.size(), "\"/>\n");
        const uint64_t size = values.size() * sizeof(Number);
        data.append(reinterpret_cast<const char*>(&size), sizeof size);
        data.append(reinterpret_cast<const char*>(values.data()), size);
    }
};

/// VTK's number of a cell by its vertices: vertex, line, triangle, tetrahedron.
uint8_t vtk_cell_type(int vertex_count) {
    constexpr std::array<uint8_t, 5> kTypes{0, 1, 3, 5, 10};
    return kTypes[static_cast<size_t>(vertex_count)];
}

void add_points(const ProbeVolumeView& volume, VtuFile& file) {
    const auto light = probe_light(volume);
    std::vector<float> sh;
    std::vector<float> mean;
    for (const IrradianceSh& probe : light) {
        const auto* numbers = &probe.coefficients[0].x;
        sh.insert(sh.end(), numbers, numbers + 3 * kShCoefficientCount);
        const float y0 = 0.5f * std::sqrt(std::numbers::inv_pi_v<float>);
        for (int i = 0; i < 3; ++i) mean.push_back(y0 * probe.coefficients[0][i]);
    }
    file.elements += "      <PointData Scalars=\"mean_irradiance\">\n";
    file.array("mean_irradiance", 3, mean);
    file.array("irradiance_sh", 3 * kShCoefficientCount, sh);
    file.array("validity", 1,
               volume.validity.empty()
                   ? std::vector(volume.positions.size(), 1.0f)
                   : std::vector(volume.validity.begin(), volume.validity.end()));
    std::vector<float> errors;
    for (const ProbeHealth& health : volume.health) errors.push_back(health.standard_error);
    if (!errors.empty()) file.array("standard_error", 1, errors);
    std::vector<float> occlusion;
    for (const glm::vec4& o : volume.occlusion) {
        occlusion.insert(occlusion.end(), {o.x, o.y, o.z, o.w});
    }
    if (!occlusion.empty()) file.array("occlusion", 4, occlusion);
    std::vector<int32_t> groups;
    for (const uint32_t group : probe_groups(volume)) groups.push_back(static_cast<int32_t>(group));
    file.array("group", 1, groups);
    file.elements += "      </PointData>\n      <Points>\n";
    std::vector<double> positions;
    for (uint32_t probe = 0; probe < volume.probe_count(); ++probe) {
        const glm::dvec3 p = world_position(volume, probe);
        positions.insert(positions.end(), {p.x, p.y, p.z});
    }
    file.array("Points", 3, positions);
    file.elements += "      </Points>\n";
}

void add_cells(const ProbeVolumeView& volume, VtuFile& file) {
    const int vertex_count = cell_vertex_count(volume.info.dimension);
    std::vector<int64_t> vertices;
    std::vector<int64_t> ends;
    for (uint32_t cell = 0; cell < volume.info.inner_cell_count; ++cell) {
        const auto& corners = volume.cells[cell].vertices;
        vertices.insert(vertices.end(), corners.begin(), corners.begin() + vertex_count);
        ends.push_back(static_cast<int64_t>(vertices.size()));
    }
    file.elements += "      <Cells>\n";
    file.array("connectivity", 1, vertices);
    file.array("offsets", 1, ends);
    file.array("types", 1, std::vector(ends.size(), vtk_cell_type(vertex_count)));
    file.elements += "      </Cells>\n";
}

/// What VTK's probe filter shows: the light of a tetrahedron without walls.
LightDifference difference(const ProbeVolumeView& volume) {
    return measure_difference(
        volume, random_places(volume, kDifferencePlaces),
        [&](const glm::dvec3& position) { return light_at(volume, position, Walls::Ignore); });
}

}  // namespace

Result<ExportedVolume> export_vtu(const ProbeVolumeView& volume, const ExportSettings& settings) {
    VtuFile file;
    add_points(volume, file);
    add_cells(volume, file);
    std::string text = str_cat(
        "<?xml version=\"1.0\"?>\n"
        "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
        "header_type=\"UInt64\">\n"
        "  <UnstructuredGrid>\n    <Piece NumberOfPoints=\"",
        volume.probe_count(), "\" NumberOfCells=\"", volume.info.inner_cell_count, "\">\n",
        file.elements, "    </Piece>\n  </UnstructuredGrid>\n  <AppendedData encoding=\"raw\">\n_",
        file.data, "\n  </AppendedData>\n</VTKFile>\n");
    return ExportedVolume{{{settings.name + ".vtu", std::move(text)}}, {}, difference(volume)};
}

}  // namespace tetralight::detail
