// SPDX-License-Identifier: Apache-2.0
#include <tetralight/base/error_text.h>
#include <tetralight/probes/build/detail/child_process.h>

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>

#include <array>
#include <cerrno>

#include "tests/support/fake_program.h"

namespace tetralight::detail {
namespace {

using namespace std::chrono_literals;

using Clock = std::chrono::steady_clock;

class ChildProcess : public testing::Test {
  protected:
    ~ChildProcess() override {
        const pid_t left = ::waitpid(-1, nullptr, WNOHANG);
        EXPECT_TRUE(left < 0 && errno == ECHILD) << "a process is left behind: " << left;
    }

    static Result<std::vector<std::byte>> run_program(const std::string& program,
                                                      const std::string& input = "",
                                                      std::chrono::milliseconds limit = 60s) {
        const ChildCommand command{program, limit, [](auto) { return Ok{}; }};
        const std::array<std::span<const std::byte>, 1> parts{std::as_bytes(std::span(input))};
        return run_child(command, parts);
    }

    /// Runs shell commands as the program `child`.
    [[nodiscard]] Result<std::vector<std::byte>> run(const std::string& commands,
                                                     const std::string& input = "",
                                                     std::chrono::milliseconds limit = 60s) const {
        return run_program(programs_.script("child", commands), input, limit);
    }

    [[nodiscard]] std::string output(const std::string& commands,
                                     const std::string& input = "") const {
        const auto bytes = run(commands, input);
        EXPECT_TRUE(bytes) << error_text(bytes.error());
        return bytes ? std::string(reinterpret_cast<const char*>(bytes->data()), bytes->size())
                     : "";
    }

    [[nodiscard]] std::string error(const std::string& commands,
                                    std::chrono::milliseconds limit = 60s) const {
        const auto bytes = run(commands, "", limit);
        EXPECT_FALSE(bytes) << commands;
        return bytes ? "" : error_text(bytes.error());
    }

    test::FakePrograms programs_;
};

TEST_F(ChildProcess, GivesWhatTheProgramWrites) {
    EXPECT_EQ(output("echo hello"), "hello\n");
    EXPECT_EQ(output(":"), "");
    EXPECT_EQ(output("cat", "some input"), "some input");
}

TEST_F(ChildProcess, PassesMoreThanAPipeHoldsBothWays) {
    const std::string input(9'000'001, 'x');
    EXPECT_TRUE(output("cat", input) == input);
    EXPECT_TRUE(output("cat; echo end; cat", input) == input + "end\n");
}

TEST_F(ChildProcess, DoesNotCareForInputThatNobodyReads) {
    const std::string input(9'000'000, 'x');
    EXPECT_EQ(output("exec <&-; echo done", input), "done\n");
    EXPECT_EQ(output("head -c 1", input), "x");
}

TEST_F(ChildProcess, KeepsStderrApart) {
    EXPECT_EQ(output("echo noise >&2; echo out"), "out\n");
    EXPECT_EQ(output("head -c 1000000 /dev/zero >&2; echo out"), "out\n");
}

TEST_F(ChildProcess, NamesTheSignalThatEndedIt) {
    EXPECT_EQ(error("kill -ABRT $$"), "child: ended by signal 6 (Aborted)");
    EXPECT_EQ(error("kill -SEGV $$"), "child: ended by signal 11 (Segmentation fault)");
    EXPECT_EQ(error("echo early; echo 'child: why' >&2; kill -KILL $$"),
              "child: ended by signal 9 (Killed): why");
}

TEST_F(ChildProcess, NamesTheExitCodeAndTheLastLineOfStderr) {
    EXPECT_EQ(error("exit 3"), "child: ended with exit code 3");
    EXPECT_EQ(error("echo note >&2; echo reason >&2; exit 1"),
              "child: ended with exit code 1: reason");
    const std::string message = error("head -c 1000000 /dev/zero | tr '\\0' x >&2; exit 1");
    EXPECT_LT(message.size(), 5000u);
}

TEST_F(ChildProcess, NamesAProgramThatCannotStart) {
    const auto message = [](const std::string& program) {
        return error_text(run_program(program).error());
    };
    EXPECT_EQ(message("/nowhere/program"),
              "program: cannot start /nowhere/program (No such file or directory)");
    EXPECT_EQ(message("no-such-program"),
              "no-such-program: cannot start no-such-program (No such file or directory)");
    const std::string text = programs_.write("text", "no program");
    EXPECT_EQ(message(text), "text: cannot start " + text + " (Permission denied)");
    EXPECT_EQ(message("/"), ": cannot start / (Permission denied)");
}

TEST_F(ChildProcess, EndsWhatRunsTooLong) {
    const auto begin = Clock::now();
    EXPECT_EQ(error("exec sleep 50", 200ms), "child: did not end within 0.2 s");
    EXPECT_EQ(error("exec >&- 2>&-; exec sleep 50", 200ms), "child: did not end within 0.2 s");
    EXPECT_EQ(error("exec yes", 200ms), "child: did not end within 0.2 s");
    EXPECT_LT(Clock::now() - begin, 20s);
}

TEST_F(ChildProcess, DoesNotWaitForWhatTheProgramLeavesRunning) {
    const auto begin = Clock::now();
    EXPECT_EQ(output("sleep 20 & echo $! > \"$0.id\"; echo done"), "done\n");
    EXPECT_LT(Clock::now() - begin, 10s);
    EXPECT_EQ(output("kill $(cat \"$0.id\")"), "");
}

TEST_F(ChildProcess, EndsAProgramWhoseOutputIsRefused) {
    const ChildCommand command{
        programs_.script("child", "exec yes"), 60s, [](std::span<const std::byte> output) {
            return output.size() < 100'000 ? Status(Ok{}) : Error{"too much"};
        }};
    const auto begin = Clock::now();
    EXPECT_EQ(error_text(run_child(command, {}).error()), "child: too much");
    EXPECT_LT(Clock::now() - begin, 20s);
}

TEST_F(ChildProcess, WorksWhereTheEndOfChildrenIsIgnored) {
    const auto before = ::signal(SIGCHLD, SIG_IGN);
    EXPECT_EQ(output("echo hello"), "hello\n");
    ::signal(SIGCHLD, before);
}

}  // namespace
}  // namespace tetralight::detail
