// SPDX-License-Identifier: Apache-2.0
// The files in tests/conformance/vectors, from which readers in other languages are tested.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>
#include <map>
#include <set>
#include <span>
#include <sstream>
#include <string>
#include <vector>

#include <tetralight/base/error_text.h>
#include <tetralight/probes/probe_file.h>
#include <tetralight/probes/seed_grid.h>
#include <tetralight/probes/uniform_receiver.h>
#include "tests/conformance/make_vectors.h"
#include "tests/conformance/vector_json.h"

namespace tetralight::conformance {
namespace {

namespace fs = std::filesystem;

const fs::path kFolder = TETRALIGHT_CONFORMANCE_VECTORS;

/// Rounding of another compiler or processor: a tenth of what other readers may differ by.
constexpr float kLightTolerance = 1e-6f;
constexpr float kWeightTolerance = 2e-6f;

std::string text_of(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return (std::ostringstream() << file.rdbuf()).str();
}

/// Calls `use(text, volume)` for each committed volume with its answers.
template <class Use>
void for_each_text(Use use) {
    size_t count = 0;
    for (const auto& entry : fs::directory_iterator(kFolder)) {
        if (entry.path().extension() != ".json") continue;
        ++count;
        const VectorText text = read_vectors(text_of(entry.path()));
        SCOPED_TRACE(text.volume);
        const auto file = open_probe_file(kFolder / text.volume);
        ASSERT_TRUE(file) << error_text(file.error());
        use(text, file->view());
    }
    EXPECT_GE(count, 10u);
}

std::map<uint32_t, float> weights_by_probe(const ProbeVolumeView& volume,
                                           const CellLocation& location) {
    std::map<uint32_t, float> weights;
    const auto probes = probes_of(volume, location);
    for (size_t i = 0; i < probes.size(); ++i) {
        weights[probes[i]] = location.weights[static_cast<int>(i)];
    }
    return weights;
}

void expect_weights(const ProbeVolumeView& volume, const CellLocation& location,
                    const CellLocation& expected) {
    auto difference = weights_by_probe(volume, location);
    for (const auto& [probe, weight] : weights_by_probe(volume, expected)) {
        difference[probe] -= weight;
    }
    for (const auto& [probe, apart] : difference) {
        EXPECT_NEAR(apart, 0.0f, kWeightTolerance) << "probe " << probe;
    }
    EXPECT_NEAR(location.ambient, expected.ambient, kWeightTolerance);
}

void expect_light(const InterpolatedProbe& light, const InterpolatedProbe& expected,
                  float largest) {
    for (size_t i = 0; i < light.irradiance.coefficients.size(); ++i) {
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(light.irradiance.coefficients[i][c], expected.irradiance.coefficients[i][c],
                        kLightTolerance * largest);
        }
    }
    for (int k = 0; k < 4; ++k) {
        EXPECT_NEAR(light.occlusion[k], expected.occlusion[k], kWeightTolerance);
    }
}

void expect_answer(const ProbeVolumeView& volume, const VectorAnswer& answer,
                   const VectorAnswer& expected, float largest) {
    EXPECT_EQ(answer.location.cell == kNoIndex, expected.location.cell == kNoIndex);
    expect_weights(volume, answer.location, expected.location);
    expect_weights(volume, answer.visible, expected.visible);
    expect_light(answer.light, expected.light, largest);
    ASSERT_EQ(answer.irradiance.size(), expected.irradiance.size());
    for (size_t i = 0; i < answer.irradiance.size(); ++i) {
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(answer.irradiance[i][c], expected.irradiance[i][c],
                        kLightTolerance * largest);
        }
    }
}

TEST(ConformanceVectors, AreWhatSingleQueriesAnswer) {
    for_each_text([](const VectorText& text, const ProbeVolumeView& file) {
        for (const VectorCase& made : text.cases) {
            const ProbeVolume volume = volume_with_options(file, made.options);
            for (const VectorAnswer& expected : made.answers) {
                SCOPED_TRACE(testing::PrintToString(expected.at.kind));
                const auto answer = answer_vector(volume.view(), made.options, expected.at);
                expect_answer(volume.view(), answer, expected, text.largest_light);
            }
        }
    });
}

/// The light of all positions of a case in one call.
std::vector<InterpolatedProbe> answer_batch(const ProbeVolumeView& volume, const VectorCase& made) {
    std::vector<glm::vec3> positions, normals;
    for (const VectorAnswer& answer : made.answers) {
        positions.push_back(answer.at.position);
        if (made.options.normal_offset) normals.push_back(answer.at.normal);
    }
    std::vector<IrradianceSh> irradiance(positions.size());
    std::vector<glm::vec4> occlusion(positions.size());
    InterpolationBatch batch;
    batch.positions = positions;
    batch.irradiance = irradiance;
    batch.occlusion = occlusion;
    batch.outside = made.options.outside;
    UniformReceiver receiver;
    receiver.set(made.options.receiver, batch);
    batch.normals = normals;
    batch.normal_offset = made.options.normal_offset.value_or(kNormalOffset);
    const auto report = interpolate(volume, batch);
    EXPECT_TRUE(report) << error_text(report.error());
    std::vector<InterpolatedProbe> light;
    for (size_t i = 0; i < positions.size(); ++i) light.push_back({irradiance[i], occlusion[i]});
    return light;
}

TEST(ConformanceVectors, AreWhatBatchesAnswer) {
    for_each_text([](const VectorText& text, const ProbeVolumeView& file) {
        for (const VectorCase& made : text.cases) {
            const ProbeVolume volume = volume_with_options(file, made.options);
            const auto light = answer_batch(volume.view(), made);
            for (size_t i = 0; i < light.size(); ++i) {
                expect_light(light[i], made.answers[i].light, text.largest_light);
            }
        }
    });
}

TEST(ConformanceVectors, AreTheBytesThatTheGeneratorMakes) {
    std::set<std::string> names;
    for (const VectorFile& file : make_vector_files()) {
        names.insert(file.name);
        const std::string text = text_of(kFolder / file.name);
        const auto bytes = std::as_bytes(std::span(text));
        EXPECT_TRUE(std::ranges::equal(bytes, file.bytes))
            << file.name << ": build the target conformance_vectors, if it has to change";
    }
    for (const auto& entry : fs::directory_iterator(kFolder)) {
        EXPECT_TRUE(names.contains(entry.path().filename())) << entry.path() << " is left over";
    }
}

TEST(ConformanceVectors, AreSmall) {
    uintmax_t size = 0;
    for (const auto& entry : fs::directory_iterator(kFolder)) size += entry.file_size();
    EXPECT_LE(size, 300'000u);
}

TEST(ConformanceVectors, HaveEachDimensionInsideAndOutside) {
    std::set<Dimension> inside, outside;
    for_each_text([&](const VectorText& text, const ProbeVolumeView& file) {
        for (const VectorCase& made : text.cases) {
            for (const VectorAnswer& answer : made.answers) {
                const uint32_t cell = answer.location.cell;
                if (cell == kNoIndex) continue;
                (cell < file.info.inner_cell_count ? inside : outside).insert(file.info.dimension);
            }
        }
    });
    EXPECT_EQ(inside,
              (std::set{Dimension::Point, Dimension::Line, Dimension::Plane, Dimension::Space}));
    EXPECT_EQ(outside, (std::set{Dimension::Line, Dimension::Plane, Dimension::Space}));
}

TEST(ConformanceVectors, HaveEachKindOfPosition) {
    std::map<std::string, int> counts;
    int faded = 0, hidden = 0, outside_hidden = 0;
    for_each_text([&](const VectorText& text, const ProbeVolumeView& file) {
        for (const VectorCase& made : text.cases) {
            for (const VectorAnswer& answer : made.answers) {
                ++counts[answer.at.kind];
                faded += answer.location.ambient > 0.0f && answer.location.ambient < 1.0f;
                const bool is_hidden = answer.visible.weights != answer.location.weights;
                hidden += is_hidden;
                outside_hidden += is_hidden && answer.location.cell >= file.info.inner_cell_count;
            }
        }
    });
    for (const char* kind :
         {"probe", "edge", "face", "inside", "hidden", "near", "far", "beyond", "not finite"}) {
        EXPECT_GE(counts[kind], 5) << kind;
    }
    EXPECT_GE(faded, 5);
    EXPECT_GE(hidden, 20);
    EXPECT_GE(outside_hidden, 3);
}

/// Six times the volume of a tetrahedron of float positions.
double volume_of_cell(const ProbeVolumeView& volume, uint32_t cell) {
    std::array<glm::dvec3, 4> p;
    for (size_t i = 0; i < 4; ++i) {
        p[i] = glm::dvec3(volume.positions[volume.cells[cell].vertices[i]]);
    }
    return glm::dot(p[1] - p[0], glm::cross(p[2] - p[0], p[3] - p[0]));
}

TEST(ConformanceVectors, HaveTetrahedraWithoutVolume) {
    const auto file = open_probe_file(kFolder / "slivers.probes");
    ASSERT_TRUE(file);
    int slivers = 0;
    for (uint32_t cell = 0; cell < file->view().info.inner_cell_count; ++cell) {
        slivers += volume_of_cell(file->view(), cell) <= 0.0;
    }
    EXPECT_GE(slivers, 3);
}

TEST(ConformanceVectors, HaveFinerSeedGrids) {
    const auto file = open_probe_file(kFolder / "clusters.probes");
    ASSERT_TRUE(file);
    const auto words = file->view().seed_grid;
    const uint64_t voxels = seed_voxel_count(seed_grid_header(words, 0));
    const auto outermost = words.subspan(kSeedGridHeaderWords, voxels);
    EXPECT_TRUE(std::ranges::any_of(outermost, [](uint32_t word) { return word >= kFinerGrid; }));
}

TEST(ConformanceVectors, HaveEdgesThatDifferentWallsBlock) {
    for (const char* name : {"walls.probes", "random_walls.probes"}) {
        const auto file = open_probe_file(kFolder / name);
        ASSERT_TRUE(file);
        EXPECT_TRUE(std::ranges::any_of(
            file->view().cell_visibility,
            [](const CellVisibility& cell) { return cell.splits[0] != 0 || cell.splits[1] != 0; }))
            << name;
    }
}

}  // namespace
}  // namespace tetralight::conformance
