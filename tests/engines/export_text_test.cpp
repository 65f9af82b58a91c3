// SPDX-License-Identifier: Apache-2.0
// The formats that hold probes and cells: JSON, CSV, VTK.
#include <gtest/gtest.h>
#include <cstring>
#include <nlohmann/json.hpp>
#include <sstream>

#include <tetralight/engines/export_target.h>
#include "tests/support/random_probes.h"

namespace tetralight {
namespace {

std::string content_of(const char* target, const ProbeVolume& volume) {
    const auto exported = find_export_target(target)->make(volume.view(), {.name = "v"});
    EXPECT_TRUE(exported);
    EXPECT_EQ(exported->files.size(), 1u);
    return exported->files[0].content;
}

/// Far from the origin, with names that formats could take for syntax.
ProbeVolume hostile_volume() {
    std::vector<ProbeGroup> groups(2);
    groups[0].name = "=cmd|' /C calc'!A0";
    groups[1].name = "a,\"b\" <c> & \\";
    for (const glm::dvec3& p : test::random_positions(20, 1)) {
        groups[p.x > 0 ? 1 : 0].positions.push_back(p + glm::dvec3(1e6, 0, -3e5));
    }
    ProbeVolume volume = make_probe_volume(*merge(groups));
    for (const glm::dvec3& p : volume.exact_positions) {
        volume.irradiance.push_back(test::linear_light(p - glm::dvec3(1e6, 0, -3e5)));
        volume.validity.push_back(0.5f);
    }
    return volume;
}

TEST(ExportJson, HoldsProbesAndCells) {
    const ProbeVolume volume = hostile_volume();
    const auto json = nlohmann::json::parse(content_of("json", volume));
    EXPECT_EQ(json["groups"].size(), 2u);
    EXPECT_EQ(json["cell_shape"], "tetrahedra");
    ASSERT_EQ(json["positions"].size(), volume.positions.size());
    ASSERT_EQ(json["cells"].size(), volume.info.inner_cell_count);
    EXPECT_EQ(json["hull"].size(), volume.cells.size() - volume.info.inner_cell_count);
    for (size_t i = 0; i < volume.positions.size(); ++i) {
        const glm::dvec3 p = volume.info.world_origin + glm::dvec3(volume.positions[i]);
        for (int axis = 0; axis < 3; ++axis)
            EXPECT_EQ(json["positions"][i][axis].get<double>(), p[axis]);
        for (size_t k = 0; k < 27; ++k) {
            EXPECT_EQ(json["irradiance_sh"][i][k].get<float>(),
                      volume.irradiance[i].coefficients[k / 3][static_cast<int>(k % 3)]);
        }
        const auto name = json["groups"][json["group"][i].get<size_t>()].get<std::string>();
        EXPECT_EQ(name[0] == '=', p.x <= 1e6);
    }
    for (size_t c = 0; c < volume.info.inner_cell_count; ++c) {
        EXPECT_EQ(json["cells"][c].get<std::vector<uint32_t>>(),
                  std::vector(volume.cells[c].vertices.begin(), volume.cells[c].vertices.end()));
    }
}

TEST(ExportJson, WritesVolumesOfEveryDimension) {
    const std::pair<const char*, std::vector<glm::dvec3>> volumes[] = {
        {"none", {}},
        {"points", {{1, 2, 3}}},
        {"segments", {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}},
        {"triangles", {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}};
    for (const auto& [shape, positions] : volumes) {
        const auto json =
            nlohmann::json::parse(content_of("json", test::make_lit_volume(positions)));
        EXPECT_EQ(json["cell_shape"], shape);
        EXPECT_EQ(json["positions"].size(), positions.size());
    }
}

TEST(ExportCsv, HasALineForEachProbe) {
    const ProbeVolume volume = hostile_volume();
    std::istringstream text(content_of("csv", volume));
    std::string line;
    std::getline(text, line);
    EXPECT_EQ(std::ranges::count(line, ','), 36);
    size_t count = 0;
    size_t formulas = 0;
    while (std::getline(text, line)) {
        ++count;
        formulas += line.find(",'=cmd|' /C calc'!A0,") != std::string::npos ? 1 : 0;
        EXPECT_EQ(line.find(",=cmd"), std::string::npos);
        EXPECT_EQ(line.back(), '\r');
    }
    EXPECT_EQ(count, volume.positions.size());
    EXPECT_GT(formulas, 0u);
}

/// The values of an appended array, by the offset in its element.
template <class Number>
std::vector<Number> vtu_array(const std::string& vtu, const std::string& name) {
    const size_t element = vtu.find("Name=\"" + name + "\"");
    const size_t start = vtu.find("offset=\"", element) + 8;
    const size_t data = vtu.find("<AppendedData encoding=\"raw\">\n_") + 31;
    const size_t at = data + std::stoul(vtu.substr(start));
    uint64_t size = 0;
    std::memcpy(&size, vtu.data() + at, 8);
    std::vector<Number> values(size / sizeof(Number));
    std::memcpy(values.data(), vtu.data() + at + 8, size);
    return values;
}

TEST(ExportVtu, HoldsProbesAndCells) {
    const ProbeVolume volume = hostile_volume();
    const std::string vtu = content_of("vtu", volume);
    const auto points = vtu_array<double>(vtu, "Points");
    const auto sh = vtu_array<float>(vtu, "irradiance_sh");
    ASSERT_EQ(points.size(), 3 * volume.positions.size());
    ASSERT_EQ(sh.size(), 27 * volume.positions.size());
    for (size_t i = 0; i < volume.positions.size(); ++i) {
        EXPECT_EQ(points[3 * i], volume.info.world_origin.x + volume.positions[i].x);
        EXPECT_EQ(sh[27 * i + 26], volume.irradiance[i].coefficients[8].b);
    }
    const auto vertices = vtu_array<int64_t>(vtu, "connectivity");
    const auto ends = vtu_array<int64_t>(vtu, "offsets");
    const auto types = vtu_array<uint8_t>(vtu, "types");
    ASSERT_EQ(ends.size(), volume.info.inner_cell_count);
    EXPECT_EQ(ends.back(), static_cast<int64_t>(vertices.size()));
    EXPECT_EQ(types, std::vector<uint8_t>(ends.size(), 10));
    for (size_t i = 0; i < vertices.size(); ++i) {
        EXPECT_EQ(vertices[i], volume.cells[i / 4].vertices[i % 4]);
    }
}

}  // namespace
}  // namespace tetralight
