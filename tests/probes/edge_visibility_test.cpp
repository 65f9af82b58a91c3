// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/edge_visibility.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include <tetralight/probes/interpolate.h>
#include "tests/support/random_probes.h"

namespace tetralight {
namespace {

TEST(EdgeCode, NeverCrossesOne) {
    std::mt19937_64 engine(1);
    std::uniform_real_distribution<double> exponent(-20.0, 2.0);
    for (int i = 0; i < 100'000; ++i) {
        const double excess = std::pow(10.0, exponent(engine));
        EXPECT_GT(decode_edge_ratio(encode_edge_ratio(1.0 + std::max(excess, 1e-15))), 1.0f);
        EXPECT_LT(decode_edge_ratio(encode_edge_ratio(1.0 - excess)), 1.0f);
    }
    EXPECT_LT(decode_edge_ratio(encode_edge_ratio(1.0)), 1.0f);
    EXPECT_EQ(decode_edge_ratio(kUnknownEdge), 1.0f);
}

TEST(EdgeCode, ReachesFromMinusFourToForty) {
    EXPECT_GE(decode_edge_ratio(255), 40.0f);
    EXPECT_LE(decode_edge_ratio(0), -4.0f);
    EXPECT_EQ(encode_edge_ratio(1e30), 255);
    EXPECT_EQ(encode_edge_ratio(-1e30), 0);
}

TEST(EdgeCode, GivesEachCodeBack) {
    for (int code = 0; code < 256; ++code) {
        if (code == kUnknownEdge) continue;
        const auto byte = static_cast<uint8_t>(code);
        EXPECT_EQ(encode_edge_ratio(double{decode_edge_ratio(byte)}), byte);
    }
}

TEST(EdgePlace, OfTheTwelveEdgesIsOneOfTwelve) {
    std::array<int, 12> uses{};
    for (size_t i = 0; i < 4; ++i) {
        for (size_t j = 0; j < 4; ++j) {
            if (i != j) ++uses[edge_place(i, j)];
        }
    }
    for (const int count : uses) EXPECT_EQ(count, 1);
}

glm::vec4 random_weights(std::mt19937_64& engine) {
    std::exponential_distribution<float> part;
    glm::vec4 weights(0.0f);
    for (int i = 0; i < 4; ++i) weights[i] = part(engine);
    return weights / ((weights[0] + weights[1]) + (weights[2] + weights[3]));
}

CellVisibility random_codes(std::mt19937_64& engine, double lowest, double highest) {
    std::uniform_real_distribution<double> ratio(lowest, highest);
    CellVisibility cell;
    for (uint8_t& code : cell.codes) code = encode_edge_ratio(ratio(engine));
    return cell;
}

/// A wall as the signed distances of the corners from it, which are linear inside the cell. A ray
/// from corner i towards corner j meets it at the fraction d_i / (d_i − d_j) of the edge.
class PlanarWall {
  public:
    explicit PlanarWall(const glm::dvec4& distances) : distances_(distances) {
        for (int i = 0; i < 4; ++i) {
            for (int j = 0; j < 4; ++j) {
                if (i != j) cell_.codes[edge_place(i, j)] = encode_edge_ratio(ratio(i, j));
            }
        }
    }

    /// Corner i is hidden from a position when their distances have different signs. Near the wall
    /// codes may be wrong by what they are rounded, and weights are on the ramp.
    void check(const glm::vec4& weights) {
        const glm::vec4 visible = visible_weights(cell_, weights);
        float share = 0.0f;  // of the corners that see the position
        for (int i = 0; i < 4; ++i) {
            if (beyond(i, weights) < -error(i, weights)) share = visible[i] / weights[i];
        }
        float hidden = 0.0f, left = 0.0f;
        const int before = checked_count;
        for (int i = 0; i < 4 && share > 0.0f; ++i) {
            if (beyond(i, weights) < -error(i, weights)) {
                EXPECT_NEAR(visible[i] / weights[i], share, 1e-5f * share);
                ++checked_count;
            } else if (beyond(i, weights) > double{kVisibilityRamp} + error(i, weights)) {
                hidden += weights[i];
                left += visible[i];
                ++checked_count;
            }
        }
        // Hidden corners share what is left to them together, but corners on the ramp have more.
        const bool is_any_on_ramp = checked_count - before < 4;
        if (is_any_on_ramp) return;
        EXPECT_LE(left, 1.01f * kHiddenShare * share * hidden);
    }

    int checked_count = 0;

  private:
    [[nodiscard]] double ratio(int i, int j) const {
        const double from = distances_[i];
        return from == 0.0 ? 0.0 : (from - distances_[j]) / from;
    }

    /// L_i − 1.
    [[nodiscard]] double beyond(int i, const glm::vec4& weights) const {
        if (distances_[i] == 0.0) return -1.0;
        return -glm::dot(glm::dvec4(weights), distances_) / distances_[i];
    }

    /// How much rounding of codes changes L_i.
    [[nodiscard]] double error(int i, const glm::vec4& weights) const {
        double error = 1e-5;
        for (int j = 0; j < 4; ++j) {
            if (i == j) continue;
            const double decoded = double{decode_edge_ratio(cell_.codes[edge_place(i, j)])};
            error += double{weights[j]} * std::abs(decoded - ratio(i, j));
        }
        return error;
    }

    glm::dvec4 distances_;
    CellVisibility cell_;
};

/// Walls whose distance from each corner has the given sign.
void check_walls(const glm::dvec4& signs) {
    std::mt19937_64 engine(2);
    std::uniform_real_distribution<double> length(0.3, 1.0);
    int checked_count = 0, count = 0;
    for (int wall_index = 0; wall_index < 200; ++wall_index) {
        glm::dvec4 distances(0.0);
        for (int i = 0; i < 4; ++i) distances[i] = signs[i] * length(engine);
        PlanarWall wall(distances);
        for (int i = 0; i < 100; ++i) wall.check(random_weights(engine));
        checked_count += wall.checked_count;
        count += 400;
    }
    EXPECT_GT(checked_count, count * 3 / 4);
}

TEST(VisibleWeights, EndAtAPlaneThatCutsOffOneCorner) {
    for (int i = 0; i < 4; ++i) {
        glm::dvec4 signs(1.0);
        signs[i] = -1.0;
        check_walls(signs);
    }
}

TEST(VisibleWeights, EndAtAPlaneBetweenTwoPairsOfCorners) {
    check_walls({1, 1, -1, -1});
    check_walls({1, -1, 1, -1});
    check_walls({1, -1, -1, 1});
}

TEST(VisibleWeights, EndAtAPlaneThroughACorner) {
    check_walls({0, 1, 1, -1});
    check_walls({1, 0, -1, -1});
    check_walls({-1, 1, -1, 0});
}

TEST(VisibleWeights, EndAtAPlaneThroughAnEdge) {
    check_walls({0, 0, 1, -1});
    check_walls({1, 0, -1, 0});
    check_walls({-1, 1, 0, 0});
}

TEST(VisibleWeights, AreUnchangedBesideAPlaneThatTouches) {
    for (const glm::dvec4& distances :
         {glm::dvec4(0, 0, 0, 1), glm::dvec4(0, 0, 1, 1), glm::dvec4(0, 1, 1, 1)}) {
        CellVisibility cell;
        for (size_t i = 0; i < 4; ++i) {
            for (size_t j = 0; j < 4; ++j) {
                const double from = distances[static_cast<int>(i)];
                const double ratio = from == 0 ? 0 : 1 - distances[static_cast<int>(j)] / from;
                if (i != j) cell.codes[edge_place(i, j)] = encode_edge_ratio(ratio);
            }
        }
        std::mt19937_64 engine(3);
        for (int i = 0; i < 1000; ++i) {
            const glm::vec4 weights = random_weights(engine);
            EXPECT_EQ(visible_weights(cell, weights), weights);
        }
    }
}

TEST(VisibleWeights, OfFreeAndUnknownEdgesAreTheSameToTheBit) {
    std::mt19937_64 engine(4);
    for (int i = 0; i < 1000; ++i) {
        CellVisibility cell;
        for (uint8_t& code : cell.codes) code = static_cast<uint8_t>(engine() % (kUnknownEdge + 1));
        const glm::vec4 weights = random_weights(engine) * (i % 2 == 0 ? 1.0f : 0.37f);
        EXPECT_EQ(visible_weights(cell, weights), weights);
    }
}

TEST(VisibleWeights, KeepTheirSum) {
    std::mt19937_64 engine(5);
    for (int i = 0; i < 10'000; ++i) {
        const CellVisibility cell = random_codes(engine, -4.0, i % 2 == 0 ? 3.0 : 40.0);
        const float sum = i % 3 == 0 ? 0.25f : 1.0f;  // the rest is ambient light
        const glm::vec4 visible = visible_weights(cell, random_weights(engine) * sum);
        for (int k = 0; k < 4; ++k) EXPECT_GE(visible[k], 0.0f);
        EXPECT_NEAR(visible[0] + visible[1] + visible[2] + visible[3], sum, 1e-6f);
    }
}

TEST(SplitBit, OfTheTwelvePairsOfEdgesIsOneOfTwelve) {
    uint32_t all = 0;
    int count = 0;
    for (size_t from = 0; from < 4; ++from) {
        for (size_t a = 0; a < 4; ++a) {
            for (size_t b = a + 1; b < 4; ++b) {
                if (a == from || b == from) continue;
                EXPECT_EQ(split_bit(from, a, b), split_bit(from, b, a));
                EXPECT_EQ(all & split_bit(from, a, b), 0u);
                all |= split_bit(from, a, b);
                ++count;
            }
        }
    }
    EXPECT_EQ(count, 12);
    EXPECT_EQ(all, 0xfffu);
}

void set_bits(CellVisibility& cell, uint32_t bits) {
    cell.splits = {static_cast<uint8_t>(bits), static_cast<uint8_t>(bits >> 8)};
}

TEST(VisibleWeights, FollowTwoWallsThatMeet) {
    // A corner with one edge to each of two walls and a free one: the largest of both decides.
    CellVisibility cell;
    cell.codes.fill(kFreeEdge);
    const uint8_t code = encode_edge_ratio(2.0);
    const double r = double{decode_edge_ratio(code)};
    cell.codes[edge_place(0, 1)] = cell.codes[edge_place(0, 2)] = code;
    cell.codes[edge_place(0, 3)] = encode_edge_ratio(-4.0);
    const double free = double{decode_edge_ratio(encode_edge_ratio(-4.0))};
    for (size_t j = 1; j < 4; ++j) {
        for (size_t k = 0; k < 4; ++k) {
            if (k != j) cell.codes[edge_place(j, k)] = 255;
        }
    }
    int seen_count = 0;
    std::mt19937_64 engine(12);
    for (int i = 0; i < 10'000; ++i) {
        const glm::vec4 weights = random_weights(engine);
        const double a = double{weights[1]} * r, b = double{weights[2]} * r;
        const double rest = double{weights[3]} * free;
        const auto share_of_first = [&](uint32_t bits) {
            set_bits(cell, bits);
            const glm::vec4 visible = visible_weights(cell, weights);
            return visible[0] / (visible[0] + visible[1] + visible[2] + visible[3]);
        };
        // All other corners are hidden: if corner 0 is not, it has nearly all of the weight.
        const bool is_seen = std::max(a, b) + rest < 0.999;
        if (weights[0] < 0.1f) continue;
        if (!is_seen) continue;
        EXPECT_GT(share_of_first(split_bit(0, 1, 2)), 0.9f);
        if (a + b + rest < 1.1) continue;
        ++seen_count;
    }
    EXPECT_GT(seen_count, 100);
}

/// As beside the edge of a room, where one plane a corner cannot follow both walls.
TEST(VisibleWeights, GoToTheCornerWithTheLeastLWhereAllAreHidden) {
    const std::array<double, 4> wanted{1.2, 2.0, 3.0, 3.0};
    CellVisibility cell;
    std::array<double, 4> parts{};
    double sum = 0.0;
    for (size_t i = 0; i < 4; ++i) {
        for (size_t j = 0; j < 4; ++j) {
            if (i != j) cell.codes[edge_place(i, j)] = encode_edge_ratio(wanted[i] / 0.75);
        }
        const size_t other = (i + 1) % 4;
        const double l = 0.75 * double{decode_edge_ratio(cell.codes[edge_place(i, other)])};
        parts[i] = std::pow(l, -8.0);
        sum += parts[i];
    }
    const glm::vec4 visible = visible_weights(cell, glm::vec4(0.25f));
    for (size_t i = 0; i < 4; ++i) {
        EXPECT_NEAR(double{visible[static_cast<int>(i)]}, parts[i] / sum, 1e-6);
    }
    EXPECT_GT(visible[0], 0.97f);
}

TEST(VisibleWeights, DoNotDependOnTheShareOfAmbientLight) {
    std::mt19937_64 engine(6);
    for (int i = 0; i < 1000; ++i) {
        const CellVisibility cell = random_codes(engine, -4.0, 10.0);
        const glm::vec4 weights = random_weights(engine);
        const glm::vec4 whole = visible_weights(cell, weights);
        const glm::vec4 half = visible_weights(cell, weights * 0.5f);
        for (int k = 0; k < 4; ++k) EXPECT_NEAR(half[k] * 2.0f, whole[k], 1e-6f);
    }
    CellVisibility blocked;
    blocked.codes.fill(255);
    EXPECT_EQ(visible_weights(blocked, glm::vec4(0.0f)), glm::vec4(0.0f));
}

/// Random splits of two cells that share corners 0, 1, 2 of the first: the same on that face, of
/// edges that are blocked.
void copy_splits_of_face(const std::array<size_t, 3>& there_of, std::mt19937_64& engine,
                         CellVisibility& here, CellVisibility& there) {
    uint32_t here_bits = engine() & 0xfff, there_bits = engine() & 0xfff;
    for (size_t from = 0; from < 3; ++from) {
        const size_t a = (from + 1) % 3, b = (from + 2) % 3;
        const uint32_t other = split_bit(there_of[from], there_of[a], there_of[b]);
        const bool is_split = (here_bits & split_bit(from, a, b)) != 0;
        there_bits = is_split ? there_bits | other : there_bits & ~other;
    }
    set_bits(here, here_bits);
    set_bits(there, there_bits);
}

/// The two cells beside a face know the ratios of its edges, and of others different ones.
TEST(VisibleWeights, AreContinuousAcrossFaces) {
    std::mt19937_64 engine(7);
    for (int i = 0; i < 1000; ++i) {
        CellVisibility here = random_codes(engine, -4.0, 10.0);
        CellVisibility there = random_codes(engine, -4.0, 10.0);
        constexpr std::array<size_t, 3> kThere{2, 0, 3};  // places of corners 0, 1, 2
        for (size_t a = 0; a < 3; ++a) {
            for (size_t b = 0; b < 3; ++b) {
                if (a == b) continue;
                there.codes[edge_place(kThere[a], kThere[b])] = here.codes[edge_place(a, b)];
            }
        }
        copy_splits_of_face(kThere, engine, here, there);
        glm::vec4 weights = random_weights(engine);
        weights[3] = 0.0f;
        glm::vec4 same(0.0f);
        for (int k = 0; k < 3; ++k) same[static_cast<int>(kThere[k])] = weights[k];
        const glm::vec4 a = visible_weights(here, weights), b = visible_weights(there, same);
        for (int k = 0; k < 3; ++k) EXPECT_NEAR(a[k], b[static_cast<int>(kThere[k])], 1e-5f);
    }
}

/// The largest change of a weight over steps of a line through the cell.
float largest_step(const CellVisibility& cell, const glm::vec4& from, const glm::vec4& to,
                   int count) {
    float largest = 0.0f;
    glm::vec4 last = visible_weights(cell, from);
    for (int i = 1; i <= count; ++i) {
        const float t = static_cast<float>(i) / static_cast<float>(count);
        const glm::vec4 next = visible_weights(cell, from * (1.0f - t) + to * t);
        for (int k = 0; k < 4; ++k) largest = std::max(largest, std::abs(next[k] - last[k]));
        last = next;
    }
    return largest;
}

TEST(VisibleWeights, ChangeTenTimesLessOverStepsTenTimesFiner) {
    std::mt19937_64 engine(8);
    for (int i = 0; i < 20; ++i) {
        const CellVisibility cell = random_codes(engine, -2.0, 2.0);
        const glm::vec4 from = random_weights(engine), to = random_weights(engine);
        const float coarse = largest_step(cell, from, to, 2'000);
        const float fine = largest_step(cell, from, to, 20'000);
        EXPECT_GT(coarse / fine, 9.0f);
        EXPECT_LT(coarse / fine, 11.0f);
    }
}

/// Gives every cell but the first one visibility, cell c the code c of its first edge.
ProbeVolume make_marked_volume() {
    ProbeVolume volume = test::make_lit_volume(test::random_positions(30, 9));
    volume.visibility_blocks.resize((volume.cells.size() + 31) / 32);
    for (uint32_t cell = 0; cell < volume.cells.size(); ++cell) {
        VisibilityBlock& block = volume.visibility_blocks[cell / 32];
        if (cell % 32 == 0) block.first = static_cast<uint32_t>(volume.cell_visibility.size());
        if (cell % 3 == 0) continue;
        block.cells |= uint32_t{1} << (cell % 32);
        volume.cell_visibility.emplace_back().codes[0] = static_cast<uint8_t>(cell);
    }
    return volume;
}

TEST(FindVisibility, KnowsTheElementOfEachCell) {
    const ProbeVolume volume = make_marked_volume();
    for (uint32_t cell = 0; cell < volume.cells.size(); ++cell) {
        const uint32_t element = find_visibility(volume.view(), cell);
        ASSERT_EQ(element == kNoIndex, cell % 3 == 0);
        if (element == kNoIndex) continue;
        EXPECT_EQ(volume.cell_visibility[element].codes[0], static_cast<uint8_t>(cell));
    }
    EXPECT_EQ(find_visibility(volume.view(), kNoIndex), kNoIndex);
}

TEST(FindVisibility, OfAnyBytesStaysInRange) {
    ProbeVolume volume = make_marked_volume();
    volume.cell_visibility.resize(5);
    std::mt19937_64 engine(10);
    for (int i = 0; i < 1000; ++i) {
        for (VisibilityBlock& block : volume.visibility_blocks) {
            block = {static_cast<uint32_t>(engine() >> (32 + engine() % 32)),
                     static_cast<uint32_t>(engine())};
        }
        const auto cell = static_cast<uint32_t>(engine() % volume.cells.size());
        const uint32_t element = find_visibility(volume.view(), cell);
        EXPECT_TRUE(element == kNoIndex || element < 5);
    }
}

TEST(Interpolate, HidesProbesBehindWallsUnlessToldToIgnoreThem) {
    ProbeVolume volume = test::make_lit_volume(test::random_positions(30, 11));
    const glm::vec3 position(0.1f, 0.05f, -0.1f);
    const CellLocation location = locate(volume.view(), position);
    const InterpolatedProbe plain = interpolate(volume.view(), location);
    volume.visibility_blocks.resize((volume.cells.size() + 31) / 32);
    volume.visibility_blocks[location.cell / 32].cells = uint32_t{1} << (location.cell % 32);
    // All that starts or ends at corner 0 is blocked close to the other corner.
    CellVisibility cell;
    cell.codes.fill(kFreeEdge);
    for (size_t j = 1; j < 4; ++j) {
        cell.codes[edge_place(0, j)] = cell.codes[edge_place(j, 0)] = 255;
    }
    volume.cell_visibility = {cell};
    const InterpolatedProbe lit = interpolate(volume.view(), location);
    CellLocation visible = location;
    visible.weights = visible_weights(cell, location.weights);
    EXPECT_NE(lit, plain);
    EXPECT_EQ(lit, interpolate(volume.view(), visible, {Walls::Ignore}));
    EXPECT_EQ(plain, interpolate(volume.view(), location, {Walls::Ignore}));
}

}  // namespace
}  // namespace tetralight
