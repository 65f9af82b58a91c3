// SPDX-License-Identifier: Apache-2.0
#include <tetralight/base/error_text.h>
#include <tetralight/base/file.h>

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <memory>
#include <string>

namespace tetralight {
namespace {

namespace fs = std::filesystem;

std::span<const std::byte> bytes(std::string_view characters) {
    return std::as_bytes(std::span(characters));
}

std::string characters(std::span<const std::byte> data) {
    return {reinterpret_cast<const char*>(data.data()), data.size()};
}

class FileTest : public testing::Test {
  protected:
    FileTest()
        : folder_(fs::temp_directory_path() / ("tetralight_file_" + std::to_string(getpid()))) {
        fs::create_directories(folder_);
    }

    ~FileTest() override { fs::remove_all(folder_); }

    [[nodiscard]] std::string path(const char* name) const { return (folder_ / name).string(); }

    [[nodiscard]] size_t file_count() const {
        return static_cast<size_t>(
            std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
    }

    fs::path folder_;
};

TEST_F(FileTest, ReadsBackWhatWasWritten) {
    ASSERT_TRUE(write_file(path("a"), bytes("hello")));
    const auto read = read_file(path("a"));
    ASSERT_TRUE(read);
    EXPECT_EQ(characters(*read), "hello");
}

TEST_F(FileTest, MapsBytesThatOutliveAMove) {
    ASSERT_TRUE(write_file(path("a"), bytes("mapped")));
    auto mapped = MappedFile::open(path("a"));
    ASSERT_TRUE(mapped);
    const MappedFile moved = std::move(*mapped);
    EXPECT_EQ(characters(moved.bytes()), "mapped");
}

TEST_F(FileTest, MapsAnEmptyFileAsNoBytes) {
    ASSERT_TRUE(write_file(path("empty"), bytes("")));
    const auto mapped = MappedFile::open(path("empty"));
    ASSERT_TRUE(mapped);
    EXPECT_TRUE(mapped->bytes().empty());
}

TEST_F(FileTest, CopiesBytesThatOutliveTheirSourceAndAMove) {
    auto source = std::make_unique<std::string>("copied");
    auto copied = MappedFile::copy_of(bytes(*source));
    ASSERT_TRUE(copied);
    source.reset();
    MappedFile moved = std::move(*copied);
    EXPECT_EQ(characters(moved.bytes()), "copied");
    EXPECT_EQ(reinterpret_cast<uintptr_t>(moved.bytes().data()) % 64, 0u);
    moved.release_pages();
    EXPECT_EQ(characters(moved.bytes()), "copied") << "a copy cannot be read again";
    ASSERT_TRUE(write_file(path("a"), bytes("mapped")));
    moved = std::move(*MappedFile::open(path("a")));
    EXPECT_EQ(characters(moved.bytes()), "mapped");
}

TEST_F(FileTest, CopiesNoBytes) {
    const auto copied = MappedFile::copy_of({});
    ASSERT_TRUE(copied);
    EXPECT_TRUE(copied->bytes().empty());
}

TEST_F(FileTest, LeavesNoTemporaryFileBehind) {
    ASSERT_TRUE(write_file(path("a"), bytes("1")));
    ASSERT_TRUE(write_file(path("a"), bytes("2")));
    EXPECT_EQ(file_count(), 1u);
    EXPECT_EQ(characters(*read_file(path("a"))), "2");
}

TEST_F(FileTest, KeepsTheOldFileWhenWritingFails) {
    ASSERT_TRUE(write_file(path("a"), bytes("old")));
    const std::string missing = path("a") + "/b";  // "a" is no folder
    const auto status = write_file(missing, bytes("new"));
    ASSERT_FALSE(status);
    EXPECT_NE(error_text(status.error()).find(missing), std::string::npos);
    EXPECT_EQ(characters(*read_file(path("a"))), "old");
    EXPECT_EQ(file_count(), 1u);
}

TEST_F(FileTest, ReplacesTheTargetOfALinkAndKeepsTheLink) {
    ASSERT_TRUE(write_file(path("target"), bytes("old")));
    fs::create_symlink(path("target"), path("link"));
    ASSERT_TRUE(write_file(path("link"), bytes("new")));
    EXPECT_TRUE(fs::is_symlink(path("link")));
    EXPECT_EQ(characters(*read_file(path("target"))), "new");
}

TEST_F(FileTest, KeepsThePermissionsOfTheOldFile) {
    ASSERT_TRUE(write_file(path("a"), bytes("old")));
    ASSERT_EQ(chmod(path("a").c_str(), 0640), 0);
    ASSERT_TRUE(write_file(path("a"), bytes("new")));
    EXPECT_EQ(fs::status(path("a")).permissions(), static_cast<fs::perms>(0640));
}

TEST_F(FileTest, WritesToADeviceInPlace) {
    EXPECT_TRUE(write_file("/dev/null", bytes("gone")));
    EXPECT_TRUE(fs::is_character_file("/dev/null"));
    EXPECT_FALSE(write_file("/dev/full", bytes("no room")));
}

TEST_F(FileTest, NamesWhatCannotBeRead) {
    EXPECT_NE(error_text(read_file(path("none")).error()).find(path("none")), std::string::npos);
    EXPECT_FALSE(read_file(folder_.string()));
    EXPECT_FALSE(MappedFile::open(folder_.string()));
}

}  // namespace
}  // namespace tetralight
