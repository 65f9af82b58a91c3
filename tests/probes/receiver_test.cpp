// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/receiver.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <random>

#include <tetralight/probes/edge_visibility.h>
#include <tetralight/probes/interpolate.h>
#include "tests/support/random_probes.h"
#include "tests/support/random_walls.h"

namespace tetralight {
namespace {

constexpr float kLength = 4.0f;

/// Probes at x = 0 and x = `kLength`, and a wall at x = 1.
ProbeVolume make_line_with_wall() {
    ProbeVolume volume = test::make_lit_volume({{0, 0, 0}, {kLength, 0, 0}});
    const ProbeEdges edges(volume.view());
    std::vector<uint8_t> codes(edges.size());
    const uint32_t first = volume.exact_positions[0].x == 0.0 ? 0 : 1;
    for (uint32_t i = 0; i < edges.size(); ++i) {
        const bool is_from_first = edges.find(first, 1 - first) == i;
        codes[i] = encode_edge_ratio(is_from_first ? 4.0 : 4.0 / 3.0);
    }
    store_visibility(edges, codes, volume);
    return volume;
}

/// What remains of the weight of the probe at 0 at a place on the line.
float share_of_first(const ProbeVolume& volume, float x, float radius) {
    const CellLocation plain = locate(volume.view(), {x, 0, 0});
    const CellLocation visible = visible_location(volume.view(), plain, {.radius = radius});
    const uint32_t first = volume.exact_positions[0].x == 0.0 ? 0 : 1;
    const auto& vertices = volume.cells[plain.cell].vertices;
    const int corner = vertices[0] == first ? 0 : 1;
    // The other probe sees all places beyond the wall, so that its weight keeps its share.
    const float unit = visible.weights[1 - corner] / plain.weights[1 - corner];
    return visible.weights[corner] / plain.weights[corner] / unit;
}

/// The fade ends with half of it, and the share of hidden probes behind it.
TEST(Radius, FadesTheLightOfHiddenProbesOverItsLengthBehindTheWall) {
    const ProbeVolume volume = make_line_with_wall();
    const double ratio = double{decode_edge_ratio(encode_edge_ratio(4.0))};
    const auto wall = static_cast<float>(double{kLength} / ratio);
    for (const float radius : {0.2f, 0.5f, 1.0f}) {
        EXPECT_NEAR(share_of_first(volume, wall + 1e-4f, radius), 1.0f, 1e-3f);
        // L = x / wall. At x the ramp is radius · L / x = radius / wall long, in L.
        const float middle = wall + 0.5f * radius, end = wall + radius;
        const float l_middle = middle / wall, l_end = end / wall;
        EXPECT_NEAR(share_of_first(volume, middle, radius),
                    0.5f + 0.5f * kHiddenShare / (l_middle * l_middle), 2e-3f);
        EXPECT_NEAR(share_of_first(volume, end, radius), kHiddenShare / (l_end * l_end), 1e-4f);
    }
}

TEST(Radius, ShorterThanTheRampChangesNothing) {
    const ProbeVolume volume = make_line_with_wall();
    for (int i = 1; i < 100; ++i) {
        const float x = 0.04f * static_cast<float>(i);
        EXPECT_NEAR(share_of_first(volume, x, 0.001f), share_of_first(volume, x, 0.0f), 1e-6f);
    }
}

/// The largest change of a corner's light over steps of lines through the volume.
float largest_step(const ProbeVolumeView& volume, const Receiver& receiver, int count) {
    std::mt19937_64 engine(1);
    std::uniform_real_distribution<float> coordinate(-1.2f, 1.2f);
    const auto any = [&] {
        const float x = coordinate(engine), y = coordinate(engine), z = coordinate(engine);
        return glm::vec3(x, y, z);
    };
    float largest = 0.0f;
    for (int line = 0; line < 4; ++line) {
        const glm::vec3 from = any(), to = any();
        std::vector<float> last;
        for (int i = 0; i <= count; ++i) {
            const float t = static_cast<float>(i) / static_cast<float>(count);
            std::vector<float> weights(volume.positions.size(), 0.0f);
            const CellLocation location =
                visible_location(volume, locate(volume, glm::mix(from, to, t)), receiver);
            for (int k = 0; k < 4; ++k) {
                const uint32_t probe = volume.cells[location.cell].vertices[k];
                if (probe != kNoIndex) weights[probe] += location.weights[k];
            }
            for (size_t p = 0; p < last.size(); ++p) {
                largest = std::max(largest, std::abs(weights[p] - last[p]));
            }
            last = std::move(weights);
        }
    }
    return largest;
}

/// Cells without slivers, in which even plain weights change within a hair's breadth.
std::vector<glm::dvec3> make_bent_lattice() {
    std::vector<glm::dvec3> positions = test::random_positions(27, 2, 0.1);
    for (int i = 0; i < 27; ++i) {
        positions[static_cast<size_t>(i)] += glm::dvec3(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
    }
    return positions;
}

TEST(Radius, KeepsWeightsContinuous) {
    ProbeVolume volume = test::make_lit_volume(make_bent_lattice());
    const ProbeEdges edges(volume.view());
    std::mt19937_64 engine(3);
    std::uniform_real_distribution<double> ratio(-2.0, 2.0);
    std::vector<uint8_t> codes(edges.size());
    for (uint8_t& code : codes) code = encode_edge_ratio(ratio(engine));
    store_visibility(edges, codes, volume);
    const Receiver receiver{.radius = 0.3f};
    const float coarse = largest_step(volume.view(), receiver, 100'000);
    const float fine = largest_step(volume.view(), receiver, 1'000'000);
    EXPECT_GT(coarse / fine, 9.0f);
    EXPECT_LT(coarse / fine, 11.0f);
}

ProbeVolume make_layered_volume() {
    ProbeVolume volume = test::make_lit_volume(test::random_positions(50, 4));
    std::mt19937_64 engine(5);
    for (size_t i = 0; i < volume.positions.size(); ++i) {
        volume.rendering_layers.push_back(engine() % 2 == 0 ? 0b01 : 0b10);
    }
    return volume;
}

TEST(RenderingLayers, LeaveAWeightOfOneInTenThousandToProbesOfOthers) {
    const ProbeVolume volume = make_layered_volume();
    int mixed_count = 0;
    for (const glm::dvec3& position : test::random_positions(500, 6)) {
        const CellLocation plain = locate(volume.view(), glm::vec3(position));
        const CellLocation seen =
            visible_location(volume.view(), plain, {.rendering_layers = 0b01});
        float kept = 0.0f, all = 0.0f;
        for (int k = 0; k < 4; ++k) {
            const uint32_t probe = volume.cells[plain.cell].vertices[k];
            if (!(plain.weights[k] > 0.0f)) continue;
            all += plain.weights[k];
            kept += plain.weights[k] * (volume.rendering_layers[probe] == 0b01 ? 1.0f : 1e-4f);
        }
        for (int k = 0; k < 4; ++k) {
            const uint32_t probe = volume.cells[plain.cell].vertices[k];
            const bool is_on = probe != kNoIndex && volume.rendering_layers[probe] == 0b01;
            EXPECT_NEAR(seen.weights[k], plain.weights[k] * (is_on ? 1.0f : 1e-4f) * all / kept,
                        1e-5f);
        }
        mixed_count += seen != plain;
    }
    EXPECT_GT(mixed_count, 200);
}

TEST(RenderingLayers, ChangeNothingWhereAllProbesOrNoneAreOnThem) {
    const ProbeVolume volume = make_layered_volume();
    ProbeVolume without = volume;
    without.rendering_layers.clear();
    for (const glm::dvec3& position : test::random_positions(200, 7)) {
        const CellLocation plain = locate(volume.view(), glm::vec3(position));
        for (const uint32_t layers : {0b11u, kAllRenderingLayers}) {
            EXPECT_EQ(visible_location(volume.view(), plain, {.rendering_layers = layers}), plain);
        }
        for (const uint32_t layers : {0b100u, 0u}) {
            const auto seen = visible_location(volume.view(), plain, {.rendering_layers = layers});
            for (int k = 0; k < 4; ++k) EXPECT_NEAR(seen.weights[k], plain.weights[k], 1e-6f);
        }
        EXPECT_EQ(visible_location(without.view(), plain, {.rendering_layers = 0b01}), plain);
    }
}

/// Places on a face have the same weights in both cells beside it.
TEST(RenderingLayers, AndRadiiAgreeAcrossFaces) {
    ProbeVolume volume = make_layered_volume();
    test::add_random_walls(volume, 8);
    const Receiver receiver{Walls::HideProbes, 0b01, 0.4f};
    std::mt19937_64 engine(9);
    std::exponential_distribution<float> part;
    for (uint32_t here = 0; here < volume.info.inner_cell_count; ++here) {
        const auto& corners = volume.cells[here].vertices;
        for (int face = 0; face < 4; ++face) {
            const uint32_t there = volume.cells[here].neighbors[static_cast<size_t>(face)];
            CellLocation a{here, 0.0f}, b{there, 0.0f};
            for (int i = 0; i < 4; ++i) a.weights[i] = i == face ? 0.0f : part(engine);
            a.weights /= (a.weights[0] + a.weights[1]) + (a.weights[2] + a.weights[3]);
            std::array<int, 4> place{};  // of each corner in the other cell
            for (int i = 0; i < 4; ++i) {
                const auto& others = volume.cells[there].vertices;
                const auto found = std::ranges::find(others, corners[static_cast<size_t>(i)]);
                place[static_cast<size_t>(i)] = static_cast<int>(found - others.begin());
                if (i != face) b.weights[place[static_cast<size_t>(i)]] = a.weights[i];
            }
            a = visible_location(volume.view(), a, receiver);
            b = visible_location(volume.view(), b, receiver);
            for (int i = 0; i < 4; ++i) {
                if (i == face) continue;
                EXPECT_NEAR(a.weights[i], b.weights[place[static_cast<size_t>(i)]], 1e-4f);
            }
        }
    }
}

TEST(RenderingLayers, OfALazilyOpenedFileThatAreTooFewAreIgnored) {
    ProbeVolume volume = make_layered_volume();
    volume.rendering_layers.pop_back();
    const CellLocation plain = locate(volume.view(), {0, 0, 0});
    EXPECT_EQ(visible_location(volume.view(), plain, {.rendering_layers = 0b01}), plain);
}

TEST(MeanProbeDistance, IsThatToTheProbesByTheirWeights) {
    const double side = 2.0;
    const ProbeVolume volume =
        test::make_lit_volume({{0, 0, 0}, {side, 0, 0}, {0, side, 0}, {0, 0, side}});
    const auto distance_at = [&](const glm::vec3& p) {
        return mean_probe_distance(volume.view(), locate(volume.view(), p));
    };
    EXPECT_EQ(distance_at({0, 0, 0}), 0.0f);
    EXPECT_NEAR(distance_at({1, 0, 0}), 1.0f, 1e-6f);     // the middle of an edge
    EXPECT_NEAR(distance_at({0.5, 0, 0}), 0.75f, 1e-6f);  // ¾ · ½ + ¼ · 1½
    const float to_origin = std::sqrt(0.75f), to_other = std::sqrt(2.25f + 0.5f);
    EXPECT_NEAR(distance_at({0.5, 0.5, 0.5}), 0.25f * to_origin + 0.75f * to_other, 1e-6f);
    // Outside: as on the hull, whatever the distance from it.
    EXPECT_NEAR(distance_at({1, -5, 0}), distance_at({1, -50, 0}), 0.3f);
}

TEST(MeanProbeDistance, OfNoCellIsZero) {
    EXPECT_EQ(mean_probe_distance({}, {}), 0.0f);
    const ProbeVolume volume = make_layered_volume();
    EXPECT_EQ(mean_probe_distance(volume.view(), {}), 0.0f);
}

TEST(PushOffSurface, MovesAlongTheNormalByAShareOfTheDistance) {
    const ProbeVolume volume = make_line_with_wall();
    const glm::vec3 position(2, 0, 0), normal(0, 1, 0);
    const CellLocation location = locate(volume.view(), position);
    const glm::vec3 pushed = push_off_surface(volume.view(), position, normal, location, 0.25f);
    EXPECT_EQ(pushed.x, 2.0f);
    EXPECT_NEAR(pushed.y, 0.25f * 2.0f, 1e-6f);
    EXPECT_EQ(push_off_surface(volume.view(), position, normal, location, 0.0f), position);
}

/// Right behind a wall the ramp leaves light of the other side; off the wall nothing is left of it.
TEST(PushOffSurface, TakesTheLightOfItsOwnSideOfAWall) {
    const ProbeVolume volume = make_line_with_wall();
    const double ratio = double{decode_edge_ratio(encode_edge_ratio(4.0))};
    const auto wall = static_cast<float>(double{kLength} / ratio);
    const glm::vec3 position(wall + 1e-3f, 0, 0);
    EXPECT_GT(share_of_first(volume, position.x, 0.0f), 0.9f);
    const glm::vec3 pushed =
        push_off_surface(volume.view(), position, {1, 0, 0}, locate(volume.view(), position));
    EXPECT_LT(share_of_first(volume, pushed.x, 0.0f), kHiddenShare);
}

}  // namespace
}  // namespace tetralight
