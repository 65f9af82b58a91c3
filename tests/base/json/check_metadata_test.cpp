// SPDX-License-Identifier: Apache-2.0
#include <tetralight/base/json/check_metadata.h>

#include <gtest/gtest.h>

#include <string>

namespace tetralight {
namespace {

TEST(CheckMetadata, TakesOneJsonObjectOrNothing) {
    for (const char* sound : {"", "{}", " {\"samples\":16,\"a\":[1,{}]}\n"}) {
        EXPECT_TRUE(check_metadata(sound)) << sound;
    }
    for (const std::string& bad :
         {std::string("[]"), std::string("{\"samples\":16"), std::string(200000, '[')}) {
        EXPECT_EQ(check_metadata(bad).error().code, ErrorCode::Corrupt);
    }
}

}  // namespace
}  // namespace tetralight
