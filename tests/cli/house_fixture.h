// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tests/cli/command_fixture.h"

namespace tetralight::test {

/// Few probes in and around the house of the courtyard, whose walls light goes through, in the file
/// `v.probes`.
class HouseFixture : public CommandFixture {
  protected:
    explicit HouseFixture(const std::string& samples) {
        succeed({"grid", kCourtyard, "-o", "few.json", "--spacing", "2.6", "--min", "-7,0.2,-6",
                 "--max", "8,3.3,6"});
        succeed({"bake", kCourtyard, "-g", "few.json", "--only-given-groups", "-o", "v.probes",
                 "-s", samples});
    }
};

}  // namespace tetralight::test
