// SPDX-License-Identifier: Apache-2.0
// Cells and light of batches against long double, in every family of probe sets.
// TETRALIGHT_NIGHTLY=1 asks a million positions of each family.
#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iostream>

#include <tetralight/probes/interpolate.h>
#include "tests/support/adversarial_positions.h"
#include "tests/support/location_reference.h"
#include "tests/support/property.h"
#include "tests/support/property_volume.h"
#include "tests/support/sized_families.h"

namespace tetralight {
namespace {

/// A weight in the cell that was found may be below zero by this, and the light differ by this
/// share of the corners' largest.
constexpr long double kWeightTolerance = 2e-6L;
constexpr long double kLightTolerance = 1e-5L;

/// Cells so flat that rounding of long double is more than this are only counted.
constexpr long double kJudgedRounding = 1e-7L;

struct Answers {
    std::vector<CellLocation> locations;
    std::vector<IrradianceSh> irradiance;

    Answers(const ProbeVolumeView& volume, std::span<const glm::vec3> positions)
        : locations(positions.size()), irradiance(positions.size()) {
        InterpolationBatch batch{.positions = positions};
        batch.irradiance = irradiance;
        batch.locations = locations;
        EXPECT_TRUE(interpolate(volume, batch));
    }
};

class Precision : public testing::TestWithParam<size_t> {
  protected:
    test::SizedFamily family = test::sized_families()[GetParam()];
    size_t count = 0;
    size_t outside_count = 0;  ///< in hull cells
    size_t unjudged_count = 0;
    /// In hull cells so thin that less than half a step of the position's floats decides.
    size_t thin_count = 0;
    size_t wrong_count = 0;
    long double least_weight = 0.0L;
    long double largest_error = 0.0L;  ///< of the light

    void check_set(size_t probe_count, uint64_t seed, size_t position_count) {
        const ProbeVolume volume = test::make_random_volume(
            family.make(std::min(probe_count, family.largest), seed), seed);
        const auto positions = test::AdversarialPositions(volume, seed).make(position_count);
        const Answers answers(volume.view(), positions);
        const test::LocationReference reference(volume.view());
        for (size_t i = 0; i < positions.size(); ++i) {
            const CellLocation& location = answers.locations[i];
            ASSERT_LT(location.cell, volume.cells.size());
            check(volume, reference, positions[i], location, answers.irradiance[i]);
        }
    }

    void check(const ProbeVolume& volume, const test::LocationReference& reference,
               const glm::vec3& position, const CellLocation& location, const IrradianceSh& light) {
        const auto weights = reference.weights(position, location.cell);
        ++count;
        outside_count += location.cell >= volume.info.inner_cell_count;
        if (weights && weights->rounding > kJudgedRounding) {
            ++unjudged_count;
            return;
        }
        const long double least = weights ? std::min(weights->least(), -weights->behind) : -1.0L;
        const long double error = weights ? light_error(volume, location, *weights, light) : 1.0L;
        const bool is_wrong = least < -kWeightTolerance || error > kLightTolerance;
        if (is_wrong && reference.is_of_float(position, location)) {
            ++thin_count;
            return;
        }
        least_weight = std::min(least_weight, least);
        largest_error = std::max(largest_error, error);
        if (!is_wrong || ++wrong_count > 3) return;
        const glm::vec4& w = location.weights;
        ADD_FAILURE() << std::setprecision(9) << position.x << ", " << position.y << ", "
                      << position.z << " in cell " << location.cell << " of "
                      << volume.info.inner_cell_count << " inner ones, by weights " << w.x << " "
                      << w.y << " " << w.z << " " << w.w << ": least weight " << least
                      << ", error of the light " << error;
    }

    /// As a share of the largest coefficient of the corners.
    static long double light_error(const ProbeVolume& volume, const CellLocation& location,
                                   const test::ReferenceWeights& weights,
                                   const IrradianceSh& light) {
        long double error = 0.0L, largest = 0.0L;
        for (size_t k = 0; k < size_t{kShCoefficientCount}; ++k) {
            for (int channel = 0; channel < 3; ++channel) {
                long double sum = 0.0L;
                for (size_t i = 0; i < 4; ++i) {
                    const uint32_t probe = volume.cells[location.cell].vertices[i];
                    if (probe == kNoIndex) continue;
                    const long double corner{volume.irradiance[probe].coefficients[k][channel]};
                    sum += weights.weights[i] * corner;
                    largest = std::max(largest, std::abs(corner));
                }
                error = std::max(error, std::abs(sum - light.coefficients[k][channel]));
            }
        }
        return error / largest;
    }
};

TEST_P(Precision, CellsHoldTheirPositionsAndLightIsThatOfLongDouble) {
    if (test::is_nightly()) {
        const size_t sizes[] = {21, 103, 502, 2004, 10'000};
        for (uint64_t seed = 1; seed <= 20; ++seed) check_set(sizes[seed % 5], seed, 50'000);
    } else {
        check_set(102, 1, 5'000);
        check_set(1004, 2, 5'000);
    }
    EXPECT_EQ(wrong_count, 0u) << "of " << count;
    EXPECT_LE(unjudged_count + thin_count, count / 100);
    if (!test::is_nightly()) return;
    std::cout << family.name << ": " << count << " positions, " << outside_count << " outside, "
              << unjudged_count + thin_count << " in cells too thin to judge, least weight "
              << least_weight << ", error of the light " << largest_error << "\n";
}

INSTANTIATE_TEST_SUITE_P(All, Precision, testing::Range<size_t>(0, test::sized_families().size()),
                         [](const auto& instance) {
                             return test::sized_families()[instance.param].name;
                         });

}  // namespace
}  // namespace tetralight
