// SPDX-License-Identifier: Apache-2.0
#include <tetralight/base/error_text.h>
#include <tetralight/base/file_writer.h>

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

namespace tetralight {
namespace {

namespace fs = std::filesystem;

class FileWriterTest : public testing::Test {
  protected:
    FileWriterTest()
        : folder_(fs::temp_directory_path() / ("tetralight_writer_" + std::to_string(getpid()))) {
        fs::create_directories(folder_);
        std::ofstream(target()) << "old";
    }

    ~FileWriterTest() override { fs::remove_all(folder_); }

    [[nodiscard]] std::string target() const { return (folder_ / "a").string(); }

    [[nodiscard]] std::string contents() const {
        std::ifstream stream(target());
        return {std::istreambuf_iterator<char>(stream), {}};
    }

    [[nodiscard]] auto file_count() const {
        return std::distance(fs::directory_iterator(folder_), fs::directory_iterator());
    }

    static bool write(FileWriter& writer, std::string_view characters) {
        return static_cast<bool>(writer.write(std::as_bytes(std::span(characters))));
    }

    fs::path folder_;
};

TEST_F(FileWriterTest, ReplacesTheFileAtTheEndOnly) {
    auto writer = FileWriter::open(target());
    ASSERT_TRUE(writer && write(*writer, "ne") && write(*writer, "w"));
    EXPECT_EQ(contents(), "old");
    ASSERT_TRUE(writer->commit());
    EXPECT_EQ(contents(), "new");
    EXPECT_EQ(file_count(), 1);
}

TEST_F(FileWriterTest, ReplacesTheFileOnlyByTheBytesThatAreExpected) {
    const auto commit_new = [this](std::vector<std::string_view> expected) -> Status {
        std::vector<std::span<const std::byte>> pieces;
        for (const std::string_view piece : expected)
            pieces.push_back(std::as_bytes(std::span(piece)));
        auto writer = FileWriter::open(target());
        if (!writer) return writer.error();
        if (!write(*writer, "ne") || !write(*writer, "w"))
            return Error{ErrorCode::Unavailable, "write"};
        return writer->commit(pieces);
    };
    for (const auto& other :
         {std::vector<std::string_view>{"new", "er"}, {"n", "a", "w"}, {"ne"}}) {
        const Status status = commit_new(other);
        ASSERT_FALSE(status);
        EXPECT_EQ(status.error().code, ErrorCode::Corrupt);
        EXPECT_EQ(error_text(status.error()).find(target()), 0u);
        EXPECT_EQ(contents(), "old");
        EXPECT_EQ(file_count(), 1);
    }
    ASSERT_TRUE(commit_new({"n", "", "ew"}));
    EXPECT_EQ(contents(), "new");
}

TEST_F(FileWriterTest, CreatesWhatALinkLeadsTo) {
    fs::create_directory(folder_ / "b");
    fs::create_symlink("b/second", folder_ / "first");
    fs::create_symlink("../new", folder_ / "b" / "second");
    auto writer = FileWriter::open((folder_ / "first").string());
    ASSERT_TRUE(writer && write(*writer, "new") && writer->commit());
    EXPECT_TRUE(fs::is_symlink(folder_ / "first"));
    EXPECT_TRUE(fs::is_regular_file(fs::symlink_status(folder_ / "new")));
    EXPECT_EQ(fs::file_size(folder_ / "new"), 3u);
}

TEST_F(FileWriterTest, RefusesLinksThatLeadInACircle) {
    const std::string loop = (folder_ / "loop").string();
    fs::create_symlink("loop", loop);
    const auto writer = FileWriter::open(loop);
    ASSERT_FALSE(writer);
    EXPECT_EQ(error_text(writer.error()),
              loop + ": cannot write (its symbolic links form a cycle)");
    EXPECT_TRUE(fs::is_symlink(loop));
}

TEST_F(FileWriterTest, KeepsTheOldFileWithoutCommit) {
    {
        auto writer = FileWriter::open(target());
        ASSERT_TRUE(writer && write(*writer, "new"));
    }
    EXPECT_EQ(contents(), "old");
    EXPECT_EQ(file_count(), 1);
}

TEST_F(FileWriterTest, LeavesNothingOfAKilledProcess) {
    const pid_t child = fork();
    if (child == 0) {
        auto writer = FileWriter::open(target());
        if (writer) write(*writer, "new");
        ::kill(::getpid(), SIGKILL);
    }
    ::waitpid(child, nullptr, 0);
    EXPECT_EQ(contents(), "old");
    EXPECT_EQ(file_count(), 1);
}

TEST_F(FileWriterTest, PassesOverANameThatIsTaken) {
    const std::string taken = target() + "." + std::to_string(getpid()) + ".0";
    std::ofstream(taken) << "another's";
    auto writer = FileWriter::open(target());
    ASSERT_TRUE(writer && write(*writer, "new") && writer->commit());
    EXPECT_EQ(contents(), "new");
    EXPECT_TRUE(fs::exists(taken));
    EXPECT_EQ(file_count(), 2);
}

TEST_F(FileWriterTest, NamesWhatCannotBeWritten) {
    const auto writer = FileWriter::open(target() + "/b");  // "a" is no folder
    ASSERT_FALSE(writer);
    EXPECT_NE(error_text(writer.error()).find(target() + "/b: cannot write"), std::string::npos);
    const auto nowhere = FileWriter::open("");
    ASSERT_FALSE(nowhere);
    EXPECT_EQ(error_text(nowhere.error()), R"("": cannot write (the path is empty))");
    auto full = FileWriter::open("/dev/full");
    ASSERT_TRUE(full);
    EXPECT_FALSE(write(*full, "no room"));
}

}  // namespace
}  // namespace tetralight
