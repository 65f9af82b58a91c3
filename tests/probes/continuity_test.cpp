// SPDX-License-Identifier: Apache-2.0
// What must hold for the light between probes of every kind of set: it has no jumps, and it is
// linear where the probes' is. TETRALIGHT_NIGHTLY=1 runs the sizes of a night.
#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>
#include <limits>

#include <tetralight/base/str_cat.h>
#include <tetralight/probes/interpolate.h>
#include "tests/support/adversarial_positions.h"
#include "tests/support/property.h"
#include "tests/support/property_volume.h"
#include "tests/support/sized_families.h"

namespace tetralight {
namespace {

class Continuity : public testing::TestWithParam<size_t> {
  protected:
    test::SizedFamily family = test::sized_families()[GetParam()];

    /// Calls `check(volume, seed, count)` for sets of many sizes, with positions to look at.
    template <class Check>
    void for_volumes(Check check) {
        const bool is_nightly = test::is_nightly();
        const size_t largest = std::min<size_t>(family.largest, is_nightly ? 100'000 : 3'000);
        test::check_property(20, [&] {
            const auto count = *rc::gen::inRange<uint32_t>(1, 1000).as("probes");
            const auto seed = *rc::gen::arbitrary<uint64_t>().as("seed");
            check(test::make_random_volume(family.make(count, seed), seed), seed, 1000);
        });
        test::check_property(1, [&] {
            check(test::make_random_volume(family.make(largest, 2), 2), 2,
                  is_nightly ? 1'000'000 : 10'000);
        });
    }
};

IrradianceSh light_at(const ProbeVolumeView& volume, glm::vec3 position, uint32_t hint) {
    return interpolate(volume, locate(volume, position, hint)).irradiance;
}

/// The largest difference of a coefficient as a share of the light.
double difference(const IrradianceSh& a, const IrradianceSh& b) {
    double largest = 0.0;
    for (int k = 0; k < kShCoefficientCount; ++k) {
        const float size = glm::length(a.coefficients[k]);
        const float off = glm::distance(a.coefficients[k], b.coefficients[k]);
        largest = std::max(largest, static_cast<double>(off / size));
    }
    return largest;
}

/// Whether a cell is no thicker than a few steps of its stored float positions: rounding may have
/// turned it inside out, so that its neighbors overlap, and the exact light itself changes by more
/// than a jump within such a step. Nothing that reads floats can do better there.
bool is_thin(const ProbeVolume& volume, uint32_t cell) {
    const bool is_inner = cell < volume.info.inner_cell_count;
    const int count = cell_vertex_count(volume.info.dimension) - (is_inner ? 0 : 1);
    std::array<glm::dvec3, 4> v{};
    double step = 0.0;
    for (int i = 0; i < count; ++i) {
        v[i] = glm::dvec3(volume.positions[volume.cells[cell].vertices[i]]);
        step = std::max(step, 0x1p-23 * glm::length(v[i]));
    }
    if (count < 3) return false;
    double thickness = std::numeric_limits<double>::infinity();
    const glm::dvec3 normal = glm::cross(v[1] - v[0], v[2] - v[0]);
    for (int i = 0; count == 3 && i < 3; ++i) {
        thickness = std::min(thickness, glm::length(normal) / glm::distance(v[i], v[(i + 1) % 3]));
    }
    const double content = std::abs(glm::dot(normal, v[3] - v[0]));
    for (int i = 0; count == 4 && i < 4; ++i) {
        const auto& [a, b, c] = kOutwardFaces[i];
        thickness =
            std::min(thickness, content / glm::length(glm::cross(v[b] - v[a], v[c] - v[a])));
    }
    return !(thickness > 8.0 * step);
}

bool is_beside_thin(const ProbeVolume& volume, uint32_t cell) {
    if (is_thin(volume, cell)) return true;
    return std::ranges::any_of(volume.cells[cell].neighbors, [&](uint32_t neighbor) {
        return neighbor != kNoIndex && is_thin(volume, neighbor);
    });
}

/// On a face of one of its cells, or on the wall between two hull cells, each of the cells answers
/// for a position that the others may claim as well: what differs there is the jump.
TEST_P(Continuity, LightHasNoJumpAcrossFacesHullAndGroupBorders) {
    double largest = 0.0;
    uint64_t thin_count = 0, pair_count = 0;
    for_volumes([&](const ProbeVolume& volume, uint64_t seed, size_t count) {
        const ProbeVolumeView view = volume.view();
        test::AdversarialPositions places(volume, seed);
        for (size_t i = 0; i < count; ++i) {
            const glm::vec3 p = places.next();
            const uint32_t found = locate(view, p).cell;
            const IrradianceSh light = light_at(view, p, found);
            for (const uint32_t neighbor : volume.cells[found].neighbors) {
                if (neighbor == kNoIndex) continue;
                const double jump = difference(light, light_at(view, p, neighbor));
                ++pair_count;
                if (!(jump <= 1e-4)) {
                    const uint32_t other = locate(view, p, neighbor).cell;
                    if (is_beside_thin(volume, found) || is_beside_thin(volume, other)) {
                        ++thin_count;
                        continue;
                    }
                    RC_FAIL(str_cat("(", p.x, ", ", p.y, ", ", p.z, "): from cell ", found,
                                    " and from cell ", neighbor, " of ", volume.cells.size(),
                                    " the light differs by ", jump));
                }
                largest = std::max(largest, jump);
            }
        }
    });
    RecordProperty("largest_jump", std::to_string(largest));
    std::cout << str_cat(family.name, ": largest jump ", largest, " at ", pair_count,
                         " borders, and more at ", thin_count,
                         " that are as thin as float steps\n");
}

/// A function with slopes of 1 in units of the volume's extent.
double linear(const ProbeVolume& volume, const glm::dvec3& local) {
    const glm::dvec3 slope(1.0, -0.7, 0.4);
    return 3.0 + glm::dot(slope, local) / static_cast<double>(volume.info.extent);
}

TEST_P(Continuity, LinearLightIsExactInsideTheHull) {
    double largest = 0.0;
    for_volumes([&](ProbeVolume volume, uint64_t seed, size_t count) {
        if (volume.info.dimension != Dimension::Space) return;
        for (size_t i = 0; i < volume.positions.size(); ++i) {
            volume.irradiance[i].coefficients[0] = glm::vec3(static_cast<float>(
                linear(volume, volume.exact_positions[i] - volume.info.world_origin)));
        }
        test::AdversarialPositions places(volume, seed);
        for (size_t i = 0; i < count; ++i) {
            const glm::vec3 p = places.next();
            const CellLocation location = locate(volume.view(), p);
            if (location.cell >= volume.info.inner_cell_count) continue;
            const double expected = linear(volume, glm::dvec3(p) - volume.info.world_origin);
            const float found = interpolate(volume.view(), location).irradiance.coefficients[0].x;
            const double error = std::abs(static_cast<double>(found) - expected);
            // Four steps of a float of 4 to 8: probes, light, weights and their sum are rounded.
            RC_ASSERT(error <= 16.0 * 0x1p-23);
            largest = std::max(largest, error);
        }
    });
    std::cout << str_cat(family.name, ": linear light is off by ", largest * 0x1p23,
                         " steps of a float at most\n");
}

INSTANTIATE_TEST_SUITE_P(All, Continuity, testing::Range<size_t>(0, test::sized_families().size()),
                         [](const auto& instance) {
                             return test::sized_families()[instance.param].name;
                         });

}  // namespace
}  // namespace tetralight
