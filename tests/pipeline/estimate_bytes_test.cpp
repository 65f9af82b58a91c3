// SPDX-License-Identifier: Apache-2.0
#include <tetralight/pipeline/estimate_bytes.h>

#include "tests/pipeline/lightmap_part_fixture.h"
#include "tests/pipeline/part_fixture.h"

namespace tetralight {
namespace {

class EstimateProbeBytes : public test::PartFixture {};

TEST_F(EstimateProbeBytes, AreThoseOfTheBakedFile) {
    EXPECT_EQ(estimate_bytes(prepare()), whole().size());
    lighting.layers = {"sky"};
    EXPECT_EQ(estimate_bytes(prepare()), whole().size());
}

class EstimateLightmapBytes : public test::LightmapPartFixture {};

TEST_F(EstimateLightmapBytes, AreThoseOfTheBakedFile) {
    EXPECT_EQ(estimate_bytes(prepare()), whole().size());
    settings.lighting.layers = {"sky"};
    EXPECT_EQ(estimate_bytes(prepare()), whole().size());
}

}  // namespace
}  // namespace tetralight
