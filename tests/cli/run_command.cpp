// SPDX-License-Identifier: Apache-2.0
#include "tests/cli/run_command.h"

#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdint>
#include <fstream>
#include <stdexcept>
#include <utility>

namespace tetralight::test {
namespace {

std::string contents(std::FILE* file) {
    std::string text;
    char buffer[4096];
    std::rewind(file);
    while (const size_t count = std::fread(buffer, 1, sizeof buffer, file)) {
        text.append(buffer, count);
    }
    return text;
}

/// The streams and the folder that a child begins with.
class SpawnActions {
  public:
    SpawnActions() { posix_spawn_file_actions_init(&actions_); }

    ~SpawnActions() { posix_spawn_file_actions_destroy(&actions_); }

    SpawnActions(const SpawnActions&) = delete;
    SpawnActions& operator=(const SpawnActions&) = delete;

    void redirect(std::FILE* file, int descriptor) {
        posix_spawn_file_actions_adddup2(&actions_, fileno(file), descriptor);
    }

    void enter(const std::filesystem::path& folder) {
        posix_spawn_file_actions_addchdir_np(&actions_, folder.c_str());
    }

    [[nodiscard]] const posix_spawn_file_actions_t* pointer() const { return &actions_; }

  private:
    posix_spawn_file_actions_t actions_{};
};

}  // namespace

RunningCommand::RunningCommand(const std::filesystem::path& working_folder,
                               const std::vector<std::string>& arguments, const std::string& input)
    : in_(std::tmpfile(), &std::fclose),
      out_(std::tmpfile(), &std::fclose),
      err_(std::tmpfile(), &std::fclose) {
    std::fwrite(input.data(), 1, input.size(), in_.get());
    std::rewind(in_.get());

    std::string program = TETRALIGHT_COMMAND;
    std::vector<std::string> words = arguments;
    std::vector<char*> argv{program.data()};
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);

    SpawnActions actions;
    actions.redirect(in_.get(), STDIN_FILENO);
    actions.redirect(out_.get(), STDOUT_FILENO);
    actions.redirect(err_.get(), STDERR_FILENO);
    actions.enter(working_folder);
    if (posix_spawn(&process_, program.c_str(), actions.pointer(), nullptr, argv.data(), environ)) {
        throw std::runtime_error("cannot start " + program);
    }
}

RunningCommand::~RunningCommand() {
    if (process_ < 0) return;
    ::kill(process_, SIGKILL);
    ::waitpid(process_, nullptr, 0);
}

CommandResult RunningCommand::wait() {
    int status = 0;
    rusage usage = {};
    ::wait4(std::exchange(process_, -1), &status, 0, &usage);
    const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    return {code, contents(out_.get()), contents(err_.get()), usage.ru_maxrss};
}

void RunningCommand::send(int signal) const {
    ::kill(process_, signal);
}

bool RunningCommand::handles(int signal) const {
    std::ifstream status("/proc/" + std::to_string(process_) + "/status");
    std::string word;
    while (status >> word) {
        if (word != "SigCgt:") continue;
        uint64_t caught = 0;
        status >> std::hex >> caught;
        return (caught >> (signal - 1) & 1) != 0;
    }
    return false;
}

CommandResult run_command(const std::filesystem::path& working_folder,
                          const std::vector<std::string>& arguments, const std::string& input) {
    return RunningCommand(working_folder, arguments, input).wait();
}

}  // namespace tetralight::test
