// SPDX-License-Identifier: Apache-2.0
#include <tetralight/base/process/descriptor_io.h>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/mman.h>

#include <array>
#include <cerrno>
#include <thread>
#include <vector>

namespace tetralight {
namespace {

std::vector<std::byte> numbered_bytes(size_t count) {
    std::vector<std::byte> bytes(count);
    for (size_t i = 0; i < count; ++i) bytes[i] = static_cast<std::byte>(i * 7 % 251);
    return bytes;
}

/// A pipe takes 64 KiB at a time, so that both sides see short transfers.
TEST(DescriptorIo, MovesAllBytesThroughAPipeInPieces) {
    int ends[2];
    ASSERT_EQ(::pipe2(ends, O_CLOEXEC), 0);
    const Descriptor read_end(ends[0]);
    Descriptor write_end(ends[1]);
    const auto sent = numbered_bytes(300'000);
    std::jthread writer([&] {
        EXPECT_TRUE(write_all(write_end, sent));
        write_end.close();
    });
    std::vector<std::byte> received(sent.size() + 10);
    EXPECT_EQ(read_up_to(read_end, received), sent.size());
    received.resize(sent.size());
    EXPECT_EQ(received, sent);
}

TEST(DescriptorIo, StopsReadingWhenTheMemoryIsFull) {
    const Descriptor file(::memfd_create("numbers", MFD_CLOEXEC));
    ASSERT_TRUE(write_all(file, numbered_bytes(100)));
    ::lseek(file.value(), 10, SEEK_SET);
    std::array<std::byte, 20> piece{};
    EXPECT_EQ(read_up_to(file, piece), 20u);
    EXPECT_EQ(piece[0], numbered_bytes(11)[10]);
    EXPECT_EQ(::lseek(file.value(), 0, SEEK_CUR), 30);
}

TEST(DescriptorIo, ReportsErrorsOfTheSystem) {
    const Descriptor write_only(::open("/dev/null", O_WRONLY | O_CLOEXEC));
    const Descriptor read_only(::open("/dev/null", O_RDONLY | O_CLOEXEC));
    std::array<std::byte, 1> piece{};
    EXPECT_FALSE(read_up_to(write_only, piece));
    EXPECT_EQ(errno, EBADF);
    EXPECT_FALSE(write_all(read_only, piece));
    EXPECT_EQ(errno, EBADF);
}

TEST(DescriptorIo, NamesAnOpenFileWithoutAName) {
    const Descriptor file(::memfd_create("unnamed", MFD_CLOEXEC));
    ASSERT_TRUE(write_all(file, numbered_bytes(3)));
    const Descriptor again(::open(path_of_descriptor(file).c_str(), O_RDONLY | O_CLOEXEC));
    std::array<std::byte, 3> bytes{};
    EXPECT_EQ(read_up_to(again, bytes), 3u);
    EXPECT_EQ(bytes[2], std::byte{14});
}

}  // namespace
}  // namespace tetralight
