// SPDX-License-Identifier: Apache-2.0
#include <tetralight/base/process/landlock.h>

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <sys/socket.h>

#include <csignal>

#include <tetralight/base/error_text.h>
#include <tetralight/base/process/descriptor.h>
#include <tetralight/base/process/process.h>
#include "tests/support/temp_folder.h"

namespace tetralight {
namespace {

using Right = FileAccess::Right;

/// Shell commands with the rights of a job.
class Landlock : public testing::Test {
  protected:
    void SetUp() override {
        if (landlock_version() == 0) GTEST_SKIP() << "the kernel has no Landlock";
        std::filesystem::create_directory(folder_.path("results"));
        folder_.write("input", "data");
        outside_.write("secret", "secret");
    }

    /// True if commands of the shell succeed. Programs of the system may be used.
    [[nodiscard]] bool succeeds(const std::string& commands) {
        std::vector<FileAccess> files = program_files();
        for (const char* programs : {"/bin", "/usr/bin"})
            files.push_back({programs, Right::Execute});
        files.push_back({".", Right::Read});
        files.push_back({"results", Right::Write});
        files.push_back({"/nowhere/file", Right::Write});
        const auto result = run_process({.program = "sh",
                                         .arguments = {"-c", commands},
                                         .folder = folder_.path(""),
                                         .files = files});
        EXPECT_TRUE(result) << error_text(result.error());
        errors_ = result ? result->errors : "";
        return result && result->succeeded();
    }

    TempFolder folder_;
    TempFolder outside_;
    std::string errors_;
};

TEST_F(Landlock, AllowsWhatWasNamed) {
    EXPECT_TRUE(
        succeeds("cat input && ls . && mkdir results/a && echo b >results/a/b && "
                 "cat results/a/b && mv results/a/b results/c && rm -r results/a && "
                 "exec cat /proc/self/status >/dev/null"))
        << errors_;
}

TEST_F(Landlock, RefusesToReadOtherFiles) {
    for (const std::string& path : {outside_.path("secret"), std::string("/etc/passwd")}) {
        EXPECT_FALSE(succeeds("cat " + path));
        EXPECT_NE(errors_.find("Permission denied"), std::string::npos) << errors_;
    }
    EXPECT_FALSE(succeeds("ls " + outside_.path("")));
    EXPECT_FALSE(succeeds("cat /proc/" + std::to_string(::getpid()) + "/environ"));
}

TEST_F(Landlock, RefusesToWriteInputsAndOtherFiles) {
    EXPECT_FALSE(succeeds("echo b >>input"));
    EXPECT_FALSE(succeeds("rm -f input"));
    EXPECT_FALSE(succeeds("mv input results/input"));
    EXPECT_FALSE(succeeds("echo b >new"));
    EXPECT_FALSE(succeeds("ln -s /etc results/link"));
    EXPECT_FALSE(succeeds("echo b >" + outside_.path("new")));
    EXPECT_EQ(read_file(folder_.path("input"))->size(), 4u);
}

TEST_F(Landlock, RefusesToExecuteResults) {
    EXPECT_FALSE(succeeds("cp /bin/true results/true && results/true"));
    EXPECT_NE(errors_.find("Permission denied"), std::string::npos) << errors_;
}

TEST_F(Landlock, RefusesSignalsToOtherProcesses) {
    if (landlock_version() < 6) GTEST_SKIP() << "this version of Landlock has no limit for signals";
    EXPECT_FALSE(succeeds("kill -0 " + std::to_string(::getpid())));
    EXPECT_TRUE(succeeds("kill -0 $$"));
}

TEST_F(Landlock, RefusesConnections) {
    if (landlock_version() < 4) GTEST_SKIP() << "this version of Landlock has no limit for TCP";
    const Descriptor listener(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
    sockaddr_in address = {};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    auto* const generic = reinterpret_cast<sockaddr*>(&address);
    ASSERT_EQ(::bind(listener.value(), generic, size), 0);
    ASSERT_EQ(::listen(listener.value(), 1), 0);
    ASSERT_EQ(::getsockname(listener.value(), generic, &size), 0);
    const std::string port = std::to_string(ntohs(address.sin_port));
    EXPECT_FALSE(succeeds("exec bash -c 'echo >/dev/tcp/127.0.0.1/" + port + "'"));
    EXPECT_NE(errors_.find("Permission denied"), std::string::npos) << errors_;
}

TEST_F(Landlock, ProcessesWithoutRulesKeepTheirRights) {
    const auto result = run_process({.program = "cat", .arguments = {outside_.path("secret")}});
    ASSERT_TRUE(result && result->succeeded());
    EXPECT_EQ(result->output_text(), "secret");
}

}  // namespace
}  // namespace tetralight
