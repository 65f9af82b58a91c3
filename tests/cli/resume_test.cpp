// SPDX-License-Identifier: Apache-2.0
// Bakes that are interrupted, and what --resume makes of them.
#include <csignal>
#include <filesystem>
#include <thread>

#include "tests/cli/command_fixture.h"

namespace tetralight::test {
namespace {

const std::string kStore = "v.probes.store";

class Resume : public CommandFixture {
  protected:
    /// A bake that is not over before a signal comes.
    const Arguments kLong{"bake", kCourtyard, "-o", "v.probes",        "-s",           "65536",
                          "-j",   "1",        "-q", "--progress-file", "progress.json"};

    /// Interrupts a bake after its first probes.
    [[nodiscard]] CommandResult interrupted(const Arguments& arguments, int signal = SIGINT) const {
        RunningCommand bake(folder(), arguments, "");
        const auto has_probes = [&] {
            if (!std::filesystem::exists(path("progress.json"))) return false;
            return Json::parse(read("progress.json"))["probes_done"] > 0;
        };
        while (!has_probes()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
        bake.send(signal);
        const CommandResult result = bake.wait();
        std::filesystem::remove(path("progress.json"));
        return result;
    }

    /// Interrupts a bake when it has got somewhere, and resumes it. Returns its number of samples,
    /// with which it takes long enough on a machine of any speed.
    [[nodiscard]] std::string interrupt_and_resume(const Arguments& more) const {
        for (int samples = 8192;; samples *= 2) {
            Arguments arguments{"bake", kCourtyard, "-q", "-s", std::to_string(samples)};
            arguments.insert(arguments.end(), more.begin(), more.end());
            RunningCommand bake(folder(), arguments, "");
            while (!bake.handles(SIGINT)) std::this_thread::sleep_for(std::chrono::milliseconds(1));
            std::this_thread::sleep_for(std::chrono::milliseconds(200));
            bake.send(SIGINT);
            if (bake.wait().exit_code != 130) continue;
            arguments.emplace_back("--resume");
            succeed(arguments);
            return std::to_string(samples);
        }
    }
};

TEST_F(Resume, CtrlCKeepsThePartAndTheOldVolume) {
    write("v.probes", "old");
    const CommandResult result = interrupted(kLong);
    EXPECT_EQ(result.exit_code, 130);
    EXPECT_EQ(
        result.err,
        "tetralight: interrupted; v.probes.store keeps what is done, --resume goes on with it\n");
    EXPECT_EQ(read("v.probes"), "old");
    EXPECT_EQ(file_names(), (std::vector<std::string>{"v.probes", kStore}));
}

TEST_F(Resume, SigtermDoesTheSameAndAsksToTryAgain) {
    EXPECT_EQ(interrupted(kLong, SIGTERM).exit_code, 75);
    EXPECT_EQ(file_names(), std::vector<std::string>{kStore});
}

TEST_F(Resume, BakesToStdoutKeepNothing) {
    const CommandResult result = interrupted({"bake", kCourtyard, "-o", "-", "-s", "262144", "-j",
                                              "1", "-q", "--progress-file", "progress.json"});
    EXPECT_EQ(result.exit_code, 130);
    EXPECT_EQ(result.err, "tetralight: interrupted; nothing was kept\n");
    EXPECT_EQ(file_names(), std::vector<std::string>{});
    EXPECT_TRUE(contains(misuse({"bake", kCourtyard, "-o", "-", "--resume"}), "--resume"));
}

TEST_F(Resume, GoesOnToTheSameBytesAndDropsThePart) {
    const std::string samples = interrupt_and_resume({"-o", "v.probes"});
    EXPECT_EQ(file_names(), std::vector<std::string>{"v.probes"});
    succeed({"bake", kCourtyard, "-o", "whole.probes", "-q", "-s", samples});
    EXPECT_TRUE(read("v.probes") == read("whole.probes"));
}

TEST_F(Resume, OfARangeGivesTheSamePart) {
    const std::string samples = interrupt_and_resume({"-o", "v.part", "--probes", "50..150"});
    EXPECT_EQ(file_names(), std::vector<std::string>{"v.part"});
    succeed({"bake", kCourtyard, "-o", "again.part", "-q", "-s", samples, "--probes", "50..150"});
    EXPECT_TRUE(read("v.part") == read("again.part"));
}

TEST_F(Resume, OfNothingBeginsAnew) {
    succeed({"bake", kCourtyard, "-o", "v.probes", "-s", "16", "--resume"});
    EXPECT_EQ(file_names(), std::vector<std::string>{"v.probes"});
}

TEST_F(Resume, TakesNothingOfAnotherBake) {
    static_cast<void>(interrupted(kLong));
    const Arguments other{"bake", kCourtyard, "-o", "v.probes", "-s", "16", "--seed", "1"};
    Arguments resumed = other;
    resumed.emplace_back("--resume");
    const CommandResult result = succeed(resumed);
    EXPECT_TRUE(contains(result.err, kStore + ": holds no probe of this bake")) << result.err;
    const std::string bytes = read("v.probes");
    succeed(other);
    EXPECT_TRUE(read("v.probes") == bytes);
    EXPECT_EQ(file_names(), (std::vector<std::string>{"v.probes", kStore})) << "work of the first";
}

TEST_F(Resume, BakesDamagedEntriesAgain) {
    static_cast<void>(interrupted(kLong));
    for (const auto& file : std::filesystem::directory_iterator(path(kStore))) {
        if (file.path().extension() == ".pack") std::filesystem::resize_file(file.path(), 30);
    }
    const CommandResult result =
        succeed({"bake", kCourtyard, "-o", "v.probes", "-s", "16", "--resume"});
    EXPECT_EQ(file_names(), std::vector<std::string>{"v.probes"});
}

TEST_F(Resume, MakesNoStoreOfAnotherFile) {
    write(kStore, "precious");
    const std::string message = fail({"bake", kCourtyard, "-o", "v.probes", "-s", "16"});
    EXPECT_TRUE(contains(message, kStore + ": is not a bake store")) << message;
    EXPECT_EQ(read(kStore), "precious");
    EXPECT_EQ(file_names(), std::vector<std::string>{kStore});
}

TEST_F(Resume, ProgressReplacesNoOtherFileOfTheBake) {
    succeed({"bake", kCourtyard, "-o", "old.probes", "-s", "16", "-q"});
    write("groups.json", R"({"groups": [{"name": "a", "positions": [[0, 2, 0]]}]})");
    for (const std::string name : {"old.probes", "groups.json", "v.probes", "v.probes.store"}) {
        const std::string message =
            fail({"bake", kCourtyard, "-o", "v.probes", "-s", "16", "--reuse", "old.probes", "-g",
                  "groups.json", "--progress-file", name});
        EXPECT_TRUE(contains(message, name + ": is another file of this command")) << message;
    }
    const std::string message =
        fail({"bake", kCourtyard, "-o", "v.probes", "-s", "16", "--progress-file", "/dev/null"});
    EXPECT_TRUE(contains(message, "/dev/null: cannot write (is not a regular file)")) << message;
    EXPECT_EQ(file_names(), (std::vector<std::string>{"groups.json", "old.probes"}));
}

TEST_F(Resume, InfoSaysTheRangeOfAPart) {
    succeed({"bake", kCourtyard, "-o", "few.part", "-s", "16", "--probes", "3..5"});
    const Json part = run_json({"info", "few.part"})["part"];
    EXPECT_EQ(part, (Json{{"range", {3, 5}}, {"step", 1}, {"is_finished", true}}));
    EXPECT_TRUE(contains(succeed({"info", "few.part"}).out,
                         "part of a bake: probes 3..5 of 255, finished"));
}

TEST_F(Resume, SaysThatAStoreIsLeftAloneWithoutIt) {
    static_cast<void>(interrupted(kLong));
    const CommandResult result = succeed({"bake", kCourtyard, "-o", "v.probes", "-s", "16"});
    EXPECT_TRUE(contains(result.err, "warning: " + kStore + ": ")) << result.err;
    EXPECT_EQ(file_names(), (std::vector<std::string>{"v.probes", kStore}));
}

TEST_F(Resume, StoresAreSharedAndHaveALimit) {
    const auto bake = [](const std::string& output, const Arguments& more) {
        Arguments arguments{"bake", kCourtyard, "-o", output, "-s", "16", "--store", "store"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return arguments;
    };
    const Json first = run_json(bake("a.probes", {}));
    const Json again = run_json(bake("b.probes", {}));
    EXPECT_TRUE(read("a.probes") == read("b.probes"));
    EXPECT_GT(first["rays"].get<double>(), 0.0);
    EXPECT_EQ(file_names(), (std::vector<std::string>{"a.probes", "b.probes", "store"}));
    succeed(bake("c.part", {"--probes", "3..5", "--resume"}));
    succeed(bake("b.probes", {"--store-limit", "1e-9"}));
    for (const auto& file : std::filesystem::directory_iterator(path("store"))) {
        EXPECT_NE(file.path().extension(), ".pack");
    }
    EXPECT_TRUE(contains(misuse(bake("b.probes", {"--chunks", "c"})), "--chunks"));
}

}  // namespace
}  // namespace tetralight::test
