// SPDX-License-Identifier: Apache-2.0
#include <tetralight/base/process/process.h>

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <array>
#include <cerrno>

#include <tetralight/base/error_text.h>
#include "tests/support/fake_program.h"

namespace tetralight {
namespace {

using namespace std::chrono_literals;

using Clock = std::chrono::steady_clock;
using End = ProcessResult::End;

class Process : public testing::Test {
  protected:
    ~Process() override {
        const pid_t left = ::waitpid(-1, nullptr, WNOHANG);
        EXPECT_TRUE(left < 0 && errno == ECHILD) << "a process is left behind: " << left;
    }

    /// Runs shell commands as the program `child`.
    [[nodiscard]] ProcessResult run(const std::string& script, const std::string& input = "",
                                    ProcessCommand command = {}) const {
        const std::array<std::span<const std::byte>, 1> parts{std::as_bytes(std::span(input))};
        if (!input.empty()) command.input = parts;
        command.program = programs_.script("child", script);
        auto result = run_process(command);
        EXPECT_TRUE(result) << error_text(result.error());
        return result ? *std::move(result) : ProcessResult{};
    }

    [[nodiscard]] std::string output(const std::string& script,
                                     const std::string& input = "") const {
        const ProcessResult result = run(script, input);
        EXPECT_TRUE(result.succeeded()) << result.failure();
        return std::string(result.output_text());
    }

    [[nodiscard]] static std::string start_error(const ProcessCommand& command) {
        const auto result = run_process(command);
        EXPECT_FALSE(result);
        return result ? "" : error_text(result.error());
    }

    test::FakePrograms programs_;
};

TEST_F(Process, ReturnsWhatTheProgramWrites) {
    EXPECT_EQ(output("echo hello"), "hello\n");
    EXPECT_EQ(output(":"), "");
    EXPECT_EQ(output("cat", "some input"), "some input");
    EXPECT_EQ(output("cat"), "");  // stdin is empty without input
}

TEST_F(Process, PassesArgumentsAsTheyAre) {
    ProcessCommand command;
    command.arguments = {"two words", "", "$HOME"};
    EXPECT_EQ(run("printf '[%s]' \"$@\"", "", command).output_text(), "[two words][][$HOME]");
}

TEST_F(Process, RunsInItsFolder) {
    ProcessCommand command;
    command.folder = "/proc";
    EXPECT_EQ(run("pwd", "", command).output_text(), "/proc\n");
    command.program = "true";
    command.folder = "/nowhere";
    EXPECT_EQ(start_error(command), "true: /nowhere: cannot enter (No such file or directory)");
}

TEST_F(Process, ExecutesAnotherFileThanItsName) {
    ProcessCommand command{.program = "some name", .arguments = {"-c", "echo $0"}};
    command.executable = "/bin/sh";
    const auto result = run_process(command);
    ASSERT_TRUE(result) << error_text(result.error());
    EXPECT_EQ(result->output_text(), "some name\n");
}

TEST_F(Process, PassesMoreThanAPipeHoldsBothWays) {
    const std::string input(9'000'001, 'x');
    EXPECT_TRUE(output("cat", input) == input);
    EXPECT_TRUE(output("cat; echo end; cat", input) == input + "end\n");
}

TEST_F(Process, IgnoresThatInputIsNotRead) {
    const std::string input(9'000'000, 'x');
    EXPECT_EQ(output("exec <&-; echo done", input), "done\n");
    EXPECT_EQ(output("head -c 1", input), "x");
}

TEST_F(Process, KeepsTheEndOfStderrApart) {
    EXPECT_EQ(output("echo noise >&2; echo out"), "out\n");
    ProcessCommand command;
    command.error_limit = 5;
    const auto result = run("head -c 1000000 /dev/zero >&2; echo last >&2", "", command);
    EXPECT_EQ(result.errors, "last\n");
    EXPECT_EQ(result.last_error_line(), "last");
}

TEST_F(Process, KeepsTheBeginningOfStdout) {
    ProcessCommand command;
    command.output_limit = 3;
    EXPECT_EQ(run("echo first; head -c 1000000 /dev/zero", "", command).output_text(), "fir");
}

TEST_F(Process, NamesTheSignalThatEndedIt) {
    const auto failure = [&](const std::string& script) { return run(script).failure(); };
    EXPECT_EQ(failure("kill -ABRT $$"), "ended by signal 6 (Aborted)");
    EXPECT_EQ(failure("kill -SEGV $$"), "ended by signal 11 (Segmentation fault)");
    EXPECT_EQ(run("kill -KILL $$").end, End::Signalled);
}

TEST_F(Process, ReturnsTheExitCode) {
    const ProcessResult result = run("echo note >&2; echo reason >&2; exit 3");
    EXPECT_EQ(result.code, 3);
    EXPECT_EQ(result.failure(), "ended with exit code 3");
    EXPECT_EQ(result.last_error_line(), "reason");
}

TEST_F(Process, NamesAProgramThatCannotStart) {
    EXPECT_EQ(start_error({.program = "/nowhere/program"}),
              "program: cannot start /nowhere/program (No such file or directory)");
    EXPECT_EQ(start_error({.program = "no-such-program"}),
              "no-such-program: cannot start no-such-program (No such file or directory)");
    const std::string text = programs_.write("text", "no program");
    EXPECT_EQ(start_error({.program = text}),
              "text: cannot start " + text + " (Permission denied)");
    EXPECT_EQ(run_process({.program = "/nowhere/program"}).error().code, ErrorCode::NotFound);
}

TEST_F(Process, EndsAtItsTimeLimit) {
    ProcessCommand command;
    command.time_limit = 200ms;
    const auto begin = Clock::now();
    for (const char* script : {"exec sleep 50", "exec >&- 2>&-; exec sleep 50", "exec yes"}) {
        EXPECT_EQ(run(script, "", command).end, End::TimedOut) << script;
    }
    EXPECT_LT(Clock::now() - begin, 20s);
}

TEST_F(Process, EndsWhenCancelled) {
    ProcessCommand command;
    int calls = 0;
    command.is_cancelled = [&] { return ++calls > 3; };
    const auto begin = Clock::now();
    EXPECT_EQ(run("exec sleep 50", "", command).end, End::Cancelled);
    EXPECT_LT(Clock::now() - begin, 20s);
}

TEST_F(Process, DoesNotWaitForWhatTheProgramLeavesRunning) {
    const auto begin = Clock::now();
    EXPECT_EQ(output("sleep 20 & echo $! > \"$0.id\"; echo done"), "done\n");
    EXPECT_LT(Clock::now() - begin, 10s);
    EXPECT_EQ(output("kill $(cat \"$0.id\")"), "");
}

TEST_F(Process, EndsAGroupWithTheProgramsThatItStarted) {
    for (const ProcessGroup group : {ProcessGroup::Own, ProcessGroup::Session}) {
        ProcessCommand command;
        command.group = group;
        command.time_limit = 500ms;
        EXPECT_EQ(run("sleep 50 & echo $! > \"$0.id\"; wait", "", command).end, End::TimedOut);
        // The killed grandchild vanishes once init has waited for it; until then it is a zombie.
        EXPECT_EQ(output("grep -c '^State:.*S' /proc/$(cat \"$0.id\")/status 2>&1 | grep -c 1; :"),
                  "0\n");
    }
}

TEST_F(Process, HasTheNicenessAndTheLimitsOfItsCommand) {
    ProcessCommand command;
    command.group = ProcessGroup::Session;
    command.niceness = 19;
    command.memory_limit = uint64_t{64} << 20;
    command.out_of_memory_score = 800;
    const ProcessResult result = run("nice; ulimit -d; cat /proc/self/oom_score_adj", "", command);
    EXPECT_EQ(result.output_text(), "19\n65536\n800\n");
}

TEST_F(Process, LimitsAddressSpaceAndProcessorTime) {
    ProcessCommand command;
    command.address_space_limit = uint64_t{8} << 30;
    command.processor_seconds_limit = 7;
    const ProcessResult result =
        run("ulimit -v; ulimit -St; ulimit -Ht; ulimit -c; ulimit -Hc", "", command);
    EXPECT_EQ(result.output_text(), "8388608\n7\n8\n0\n0\n");
}

TEST_F(Process, LeavesLowerLimitsOfThisProcess) {
    rlimit own = {};
    ASSERT_EQ(::getrlimit(RLIMIT_CPU, &own), 0);
    rlimit lower = own;
    lower.rlim_cur = 100'000;
    ASSERT_EQ(::setrlimit(RLIMIT_CPU, &lower), 0);
    ProcessCommand command;
    command.processor_seconds_limit = 200'000;
    const ProcessResult result = run("ulimit -St", "", command);
    ASSERT_EQ(::setrlimit(RLIMIT_CPU, &own), 0);
    EXPECT_EQ(result.output_text(), "100000\n");
}

TEST_F(Process, GivesProgramsNoNewPrivileges) {
    EXPECT_EQ(output("grep -c '^NoNewPrivs:.*1$' /proc/self/status"), "1\n");
}

TEST_F(Process, EndsAProgramWhoseOutputIsRefused) {
    const ProcessCommand command{
        .program = programs_.script("child", "exec yes"),
        .check_output = [](std::span<const std::byte> output) {
            return output.size() < 100'000 ? Status(Ok{}) : Error{ErrorCode::Corrupt, "too much"};
        }};
    const auto begin = Clock::now();
    EXPECT_EQ(start_error(command), "child: too much");
    EXPECT_LT(Clock::now() - begin, 20s);
}

TEST_F(Process, WorksWhereTheEndOfChildrenIsIgnored) {
    const auto before = ::signal(SIGCHLD, SIG_IGN);
    EXPECT_EQ(output("echo hello"), "hello\n");
    ::signal(SIGCHLD, before);
}

}  // namespace
}  // namespace tetralight
