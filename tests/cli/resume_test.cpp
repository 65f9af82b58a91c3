// SPDX-License-Identifier: Apache-2.0
// Bakes that are interrupted, and what --resume makes of them.
#include <csignal>
#include <filesystem>
#include <thread>

#include "tests/cli/command_fixture.h"

namespace tetralight::test {
namespace {

const std::string kPart = "v.probes.part";

class Resume : public CommandFixture {
  protected:
    /// A bake that is not over before a signal comes.
    const Arguments kLong{"bake", kCourtyard, "-o", "v.probes", "-s", "262144", "-j", "1", "-q"};

    [[nodiscard]] CommandResult interrupted(const Arguments& arguments, int signal = SIGINT) const {
        RunningCommand bake(folder(), arguments, "");
        while (!bake.handles(signal)) std::this_thread::sleep_for(std::chrono::milliseconds(1));
        bake.send(signal);
        return bake.wait();
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
        "tetralight: interrupted; v.probes.part keeps what is done, --resume goes on with it\n");
    EXPECT_EQ(read("v.probes"), "old");
    EXPECT_EQ(file_names(), (std::vector<std::string>{"v.probes", kPart}));
}

TEST_F(Resume, SigtermDoesTheSameAndAsksToTryAgain) {
    EXPECT_EQ(interrupted(kLong, SIGTERM).exit_code, 75);
    EXPECT_EQ(file_names(), std::vector<std::string>{kPart});
}

TEST_F(Resume, BakesToStdoutKeepNothing) {
    const CommandResult result =
        interrupted({"bake", kCourtyard, "-o", "-", "-s", "262144", "-j", "1", "-q"});
    EXPECT_EQ(result.exit_code, 130);
    EXPECT_EQ(result.err, "tetralight: interrupted\n");
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

TEST_F(Resume, RefusesAPartOfAnotherBake) {
    static_cast<void>(interrupted(kLong));
    const std::string part = read(kPart);
    for (const Arguments& other :
         {Arguments{"--seed", "1"}, Arguments{"--sky", "1"}, Arguments{"--clamp", "1"}}) {
        Arguments arguments = kLong;
        arguments.insert(arguments.end(), other.begin(), other.end());
        arguments.emplace_back("--resume");
        EXPECT_TRUE(contains(fail(arguments), kPart + ": is of another bake"));
        EXPECT_TRUE(read(kPart) == part);
    }
}

TEST_F(Resume, RefusesABadPartAndKeepsTheOldVolume) {
    succeed({"bake", kCourtyard, "-o", "sound.part", "-s", "16", "--probes", "0.."});
    for (const BadFile& bad : bad_volumes(read("sound.part"))) {
        write(kPart, bad.bytes);
        const std::string message = fail_and_keep(
            "v.probes", {"bake", kCourtyard, "-o", "v.probes", "-s", "16", "--resume"});
        EXPECT_TRUE(contains(message, kPart + ": ")) << message;
    }
}

TEST_F(Resume, KeepsNoPartInThePlaceOfAnotherFile) {
    write(kPart, "precious");
    const std::string message = fail({"bake", kCourtyard, "-o", "v.probes", "-s", "16"});
    EXPECT_TRUE(contains(message, kPart + ": is no interrupted bake")) << message;
    EXPECT_EQ(read(kPart), "precious");
    EXPECT_EQ(file_names(), std::vector<std::string>{kPart});
}

TEST_F(Resume, KeepsNoPartInThePlaceOfAnInput) {
    std::filesystem::copy_file(kCourtyard, path("scene.part"));
    const std::string scene = read("scene.part");
    EXPECT_TRUE(contains(fail({"bake", "scene.part", "-o", "scene", "-s", "16"}),
                         "scene.part: is an input of this command"));
    write("g.probes.part", kFiveProbes);
    for (const Arguments& more : {Arguments{}, Arguments{"--resume"}}) {
        Arguments arguments{"bake", kCourtyard, "-g", "g.probes.part", "-o", "g.probes"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        EXPECT_TRUE(contains(fail(arguments), "g.probes.part: is an input of this command"));
    }
    EXPECT_EQ(read("g.probes.part"), kFiveProbes);
    EXPECT_TRUE(read("scene.part") == scene);
}

TEST_F(Resume, InfoSaysHowFarAPartIs) {
    static_cast<void>(interrupted(kLong));
    const Json part = run_json({"info", kPart})["part"];
    EXPECT_EQ(part["range"], (Json{0, 255}));
    EXPECT_EQ(part["is_finished"], false);
    EXPECT_LT(part["begun"].get<int>(), 255);
    EXPECT_TRUE(
        contains(succeed({"info", kPart}).out, "part of a bake: probes 0..255 of 255, not "));

    succeed({"bake", kCourtyard, "-o", "few.part", "-s", "16", "--probes", "3..5"});
    EXPECT_TRUE(contains(succeed({"info", "few.part"}).out,
                         "part of a bake: probes 3..5 of 255, finished"));
}

TEST_F(Resume, SaysThatAPartIsLeftAloneWithoutIt) {
    static_cast<void>(interrupted(kLong));
    const CommandResult result = succeed({"bake", kCourtyard, "-o", "v.probes", "-s", "16"});
    EXPECT_TRUE(contains(result.err, "warning: " + kPart + ": ")) << result.err;
    EXPECT_EQ(file_names(), (std::vector<std::string>{"v.probes", kPart}));
}

}  // namespace
}  // namespace tetralight::test
