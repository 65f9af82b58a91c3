// SPDX-License-Identifier: Apache-2.0
#include <tetralight/runtime/detail/c_errors.h>

#include <gtest/gtest.h>

#include <set>

namespace tetralight {
namespace {

TEST(CErrors, EveryCodeHasAStatusOfItsOwn) {
    std::set<tetralight_status> statuses{TETRALIGHT_OK};
    for (int code = 0; code <= static_cast<int>(ErrorCode::Cancelled); ++code) {
        const tetralight_status status = detail::status_of(static_cast<ErrorCode>(code));
        EXPECT_TRUE(statuses.insert(status).second) << code << " has status " << status;
    }
}

TEST(CErrors, StatusesKeepTheirNumbers) {
    EXPECT_EQ(TETRALIGHT_OK, 0);
    EXPECT_EQ(TETRALIGHT_BAD_POINTER, 1);
    EXPECT_EQ(TETRALIGHT_BAD_VALUE, 2);
    EXPECT_EQ(TETRALIGHT_SHORT_BUFFER, 3);
    EXPECT_EQ(TETRALIGHT_BAD_FILE, 4);
    EXPECT_EQ(TETRALIGHT_NOT_THERE, 5);
    EXPECT_EQ(TETRALIGHT_OUT_OF_MEMORY, 6);
    EXPECT_EQ(TETRALIGHT_CORRUPT, 7);
    EXPECT_EQ(TETRALIGHT_UNSUPPORTED, 8);
    EXPECT_EQ(TETRALIGHT_UNAVAILABLE, 9);
    EXPECT_EQ(TETRALIGHT_OUT_OF_RESOURCES, 10);
    EXPECT_EQ(TETRALIGHT_DISK_FULL, 11);
    EXPECT_EQ(TETRALIGHT_CANCELLED, 12);
}

TEST(CErrors, MessagesAreTheLibrarys) {
    tetralight_error error;
    const Error cause(ErrorCode::Corrupt, "level.probes: wrong checksum");
    EXPECT_EQ(detail::finish(cause, &error), TETRALIGHT_CORRUPT);
    EXPECT_STREQ(error.message, "level.probes: wrong checksum");
    EXPECT_EQ(detail::finish(cause, nullptr), TETRALIGHT_CORRUPT);
    EXPECT_EQ(detail::succeed(&error), TETRALIGHT_OK);
    EXPECT_STREQ(error.message, "");
}

}  // namespace
}  // namespace tetralight
