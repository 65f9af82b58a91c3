// SPDX-License-Identifier: Apache-2.0
#include <tetralight/base/hash/sha256.h>

#include <gtest/gtest.h>

namespace tetralight {
namespace {

// The examples of FIPS 180-2, appendix B.
TEST(Sha256, GivesTheHashesOfTheStandard) {
    const auto hash = [](std::string_view text) {
        return sha256_hex(std::as_bytes(std::span(text)));
    };
    EXPECT_EQ(hash(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
    EXPECT_EQ(hash("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    EXPECT_EQ(hash("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
              "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
    EXPECT_EQ(hash(std::string(1'000'000, 'a')),
              "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST(Sha256, IsTheSameHoweverTheBytesAreSplit) {
    const std::string text(200, 'x');
    Sha256 whole;
    whole.add(text);
    for (const size_t cut : {size_t{0}, size_t{1}, size_t{63}, size_t{64}, text.size()}) {
        Sha256 parts;
        parts.add(std::string_view(text).substr(0, cut));
        EXPECT_EQ(parts.digest() == whole.digest(), cut == text.size());
        parts.add(std::string_view(text).substr(cut));
        EXPECT_EQ(parts.hex(), whole.hex()) << cut;
    }
}

}  // namespace
}  // namespace tetralight
