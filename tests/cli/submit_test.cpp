// SPDX-License-Identifier: Apache-2.0
// Jobs are sent to stand-ins of Slurm's commands, and run by GNU make.
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <sstream>
#include <thread>

#include "tests/cli/command_fixture.h"
#include "tests/support/fake_program.h"

namespace tetralight::test {
namespace {

/// Finds programs in a folder first while it lives.
class PathBefore {
  public:
    explicit PathBefore(const std::string& folder) : old_(std::getenv("PATH")) {
        ::setenv("PATH", (folder + ":" + old_).c_str(), 1);
    }

    ~PathBefore() { ::setenv("PATH", old_.c_str(), 1); }

    PathBefore(const PathBefore&) = delete;
    PathBefore& operator=(const PathBefore&) = delete;

  private:
    std::string old_;
};

std::vector<std::string> lines_of(const std::string& text) {
    std::istringstream stream(text);
    std::vector<std::string> lines;
    for (std::string line; std::getline(stream, line);) lines.push_back(line);
    return lines;
}

class Submit : public CommandFixture {
  protected:
    /// A job whose tasks are not there: phases of these numbers of tasks.
    void plan(const std::vector<size_t>& phases) const {
        Json plan{{"format", "tetralight-plan"},
                  {"version", 1},
                  {"scenes", Json::array()},
                  {"results", Json::array()}};
        plan["phases"] = plan["tasks"] = Json::array();
        for (const size_t count : phases) {
            const size_t begin = plan["tasks"].size();
            for (size_t i = 0; i < count; ++i) plan["tasks"].push_back(task(begin + i));
            plan["phases"].push_back({{"begin", begin}, {"end", begin + count}});
        }
        std::filesystem::create_directories(path("job/done"));
        std::filesystem::create_directories(path("job/parts"));
        write("job/plan.json", plan.dump());
    }

    static Json task(size_t number) {
        const std::string digits = std::to_string(number);
        return {{"name", "task " + digits},
                {"cost", 1.0},
                {"rays", 1.0},
                {"key", "key" + digits},
                {"command", {{"command", "bake"}, {"output", "parts/" + digits + ".part"}}}};
    }

    void finish(size_t number) const {
        const std::string digits = std::to_string(number);
        write("job/parts/" + digits + ".part", "x");
        write("job/done/key" + digits + ".json",
              Json{{"key", "key" + digits}, {"bytes", 1}}.dump());
    }

    /// A job with two probe tasks of the courtyard.
    void real_job(int samples) const {
        write("order.json", R"({"scenes": [{"scene": ")" + kCourtyard +
                                R"(", "probes": {"samples": )" + std::to_string(samples) + "}}]}");
        succeed({"plan", "order.json", "--tasks", "2", "-o", "job", "-q"});
    }

    /// An sbatch that writes its arguments, one a line, and answers 71, 72, ...
    void stand_in_for_sbatch() const {
        programs_.script("sbatch", "echo sbatch >> '" + path("sent") +
                                       "'\nfor word; do echo \"$word\" >> '" + path("sent") +
                                       "'; done\necho $((70 + $(grep -c ^sbatch '" + path("sent") +
                                       "')))");
    }

    [[nodiscard]] PathBefore stand_ins() const { return PathBefore(programs_.path("")); }

    FakePrograms programs_;
};

/// The arguments of each sbatch that was run, without those that name folders.
std::vector<std::string> sent_words(const std::string& text) {
    std::vector<std::string> commands;
    for (const std::string& line : lines_of(text)) {
        if (line == "sbatch") {
            commands.emplace_back();
        } else if (line.find("/job") == std::string::npos) {
            commands.back() += (commands.back().empty() ? "" : " ") + line;
        }
    }
    return commands;
}

TEST_F(Submit, EachPhaseWaitsForTheOneBefore) {
    plan({3, 2});
    stand_in_for_sbatch();
    const PathBefore path_before = stand_ins();
    const Json json = run_json({"submit", "job", "--to", "slurm", "--at-once", "8", "--threads",
                                "2", "--program", "tetralight", "--option=--partition=a b"});
    const std::string options = "--partition=a b slurm/";
    EXPECT_EQ(sent_words(read("sent")),
              (std::vector<std::string>{
                  "--parsable --cpus-per-task=2 --array=0-2%8 " + options +
                      "task.sbatch tetralight 10 0 3 1",
                  "--parsable --cpus-per-task=2 --array=0-1%8 --dependency=afterok:71 "
                  "--kill-on-invalid-dep=yes " +
                      options + "task.sbatch tetralight 10 3 5 1",
                  "--parsable --cpus-per-task=2 --dependency=afterany:72 "
                  "--kill-on-invalid-dep=yes " +
                      options + "collect.sbatch tetralight 10"}));
    EXPECT_EQ(json["tasks"], 5);
    EXPECT_EQ(json["jobs"], Json::parse(read("job/submitted.json"))["jobs"]);
    EXPECT_EQ(json["jobs"][2], (Json{{"name", "collect"}, {"job", 73}}));
}

TEST_F(Submit, TasksThatAreDoneAreNotSent) {
    plan({6, 1});
    for (const size_t task : {0, 3, 6}) finish(task);
    stand_in_for_sbatch();
    const PathBefore path_before = stand_ins();
    EXPECT_EQ(run_json({"submit", "job", "--to", "slurm"})["tasks"], 4);
    const auto commands = sent_words(read("sent"));
    ASSERT_EQ(commands.size(), 2u);
    EXPECT_TRUE(contains(commands[0], "--array=1-2,4-5 "));
    EXPECT_TRUE(contains(commands[1], "afterany:71"));
}

TEST_F(Submit, ArraysHaveAtMostAThousandElements) {
    plan({2500});
    const Json json = run_json({"submit", "job", "--to", "slurm", "--dry-run"});
    const Json array = json["commands"][0];
    // Three tasks each: 834 elements, of which the last has one.
    EXPECT_EQ(array[4], "--array=0-833");
    const Json last_words(array.end() - 3, array.end());
    EXPECT_EQ(last_words, (Json{"0", "2500", "3"}));
}

TEST_F(Submit, ADryRunWritesAndSendsNothing) {
    plan({2});
    stand_in_for_sbatch();
    const PathBefore path_before = stand_ins();
    const auto before = file_names();
    for (const char* scheduler : {"slurm", "make"}) {
        const std::string out = succeed({"submit", "job", "--to", scheduler, "--dry-run"}).out;
        EXPECT_TRUE(contains(out, "== " + path("job"))) << out;
        EXPECT_TRUE(contains(out, "\n$ ")) << out;
        EXPECT_FALSE(contains(out, "\\u")) << out;
    }
    EXPECT_EQ(file_names(), before);
    EXPECT_FALSE(std::filesystem::exists(path("job/submit.json")));
}

TEST_F(Submit, ARefusalIsShownAndTakesBackWhatWasSent) {
    plan({1, 1});
    programs_.script("sbatch",
                     "case \"$*\" in *afterok*) echo 'sbatch: error: no such thing' >&2; "
                     "exit 1;; esac\necho 7");
    programs_.script("scancel", "echo \"$@\" > '" + path("cancelled") + "'");
    const PathBefore path_before = stand_ins();
    const std::string line = fail({"submit", "job", "--to", "slurm"});
    EXPECT_TRUE(contains(line,
                         "phase 1: sbatch: error: no such thing (cancelled the jobs before "
                         "it: 7)"))
        << line;
    EXPECT_EQ(read("cancelled"), "7\n");
    EXPECT_FALSE(std::filesystem::exists(path("job/submitted.json")));
}

TEST_F(Submit, AJobThatSlurmWorksForIsNotSentAgain) {
    plan({1});
    stand_in_for_sbatch();
    programs_.script("squeue", "echo 71");
    const PathBefore path_before = stand_ins();
    succeed({"submit", "job", "--to", "slurm"});
    EXPECT_TRUE(contains(fail({"submit", "job", "--to", "slurm"}), "`scancel 71 72`"));
    // The numbers of its tasks stay.
    const std::string before = read("job/plan.json");
    EXPECT_TRUE(contains(fail({"plan", kCourtyard, "-o", "job"}), "`scancel 71 72`"));
    EXPECT_EQ(read("job/plan.json"), before);
    programs_.script("squeue", "echo 'slurm_load_jobs error: Invalid job id' >&2; exit 1");
    succeed({"submit", "job", "--to", "slurm"});
}

TEST_F(Submit, WithoutSlurmItSaysSo) {
    plan({1});
    const std::string old = std::getenv("PATH");
    ::setenv("PATH", programs_.path("").c_str(), 1);
    const std::string line = fail({"submit", "job", "--to", "slurm"});
    const std::string no_make = fail({"submit", "job", "--to", "make"});
    ::setenv("PATH", old.c_str(), 1);
    EXPECT_TRUE(contains(line, "PATH has no sbatch")) << line;
    EXPECT_TRUE(contains(no_make, "PATH has no make")) << no_make;
}

TEST_F(Submit, MakeRunsAJobAndContinuesIt) {
    real_job(16);
    succeed({"task", "job", "1", "-q"});
    succeed({"submit", "job", "--to", "make", "--at-once", "2", "-o", "it's $(touch x) `touch y`",
             "-q"});
    EXPECT_FALSE(contains(read("job/Makefile"), "task-1"));
    succeed({"bake", kCourtyard, "-s", "16", "-o", "one.probes", "-q"});
    EXPECT_TRUE(read("it's $(touch x) `touch y`/courtyard.probes") == read("one.probes"));
    for (const char* name : {"x", "y", "job/x", "job/y"})
        EXPECT_FALSE(std::filesystem::exists(path(name)));
    const Json again = run_json({"submit", "job", "--to", "make"});
    EXPECT_EQ(again["tasks"], 0);
}

TEST_F(Submit, MakeSaysThatATaskFailed) {
    plan({2, 1});
    const CommandResult result = run({"submit", "job", "--to", "make"});
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_TRUE(contains(result.err, "make ended with exit code 2; the same command continues"))
        << result.err;
}

TEST_F(Submit, MakeEndsAtSigtermAndMayBeRunAgain) {
    real_job(1 << 20);
    RunningCommand running(folder(), {"submit", "job", "--to", "make", "-q"}, "");
    while (!running.handles(SIGTERM)) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    running.send(SIGTERM);
    EXPECT_EQ(running.wait().exit_code, 75);
}

TEST_F(Submit, ItHasToSayWhereTo) {
    plan({1});
    EXPECT_TRUE(contains(misuse({"submit", "job"}), "--to"));
    EXPECT_TRUE(contains(misuse({"submit", "job", "--to", "pbs"}), "\"pbs\""));
    EXPECT_TRUE(contains(fail({"submit", "none", "--to", "make"}), "is not a job"));
    write("job/submit.json", "{}");
    EXPECT_TRUE(contains(fail({"collect", "job"}), "submit.json: was not written by `submit`"));
}

}  // namespace
}  // namespace tetralight::test
