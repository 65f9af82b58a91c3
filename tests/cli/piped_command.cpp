// SPDX-License-Identifier: Apache-2.0
#include "tests/cli/piped_command.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <stdexcept>
#include <utility>

namespace tetralight::test {
namespace {

struct Pipe {
    Descriptor reader;
    Descriptor writer;

    Pipe() {
        int ends[2];
        if (::pipe2(ends, O_CLOEXEC) != 0) throw std::runtime_error("cannot make a pipe");
        reader = Descriptor(ends[0]);
        writer = Descriptor(ends[1]);
    }
};

/// Signals as a shell would have them, whatever this process does with a broken pipe.
void restore_signals(posix_spawnattr_t& attributes) {
    sigset_t signals;
    sigemptyset(&signals);
    sigaddset(&signals, SIGPIPE);
    posix_spawnattr_setsigdefault(&attributes, &signals);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);
}

}  // namespace

PipedCommand::PipedCommand(const std::filesystem::path& working_folder,
                           std::vector<std::string> arguments) {
    Pipe in;
    Pipe out;
    std::string program = TETRALIGHT_COMMAND;
    std::vector<char*> argv{program.data()};
    for (std::string& word : arguments) argv.push_back(word.data());
    argv.push_back(nullptr);

    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    restore_signals(attributes);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addchdir_np(&actions, working_folder.c_str());
    posix_spawn_file_actions_adddup2(&actions, in.reader.value(), STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&actions, out.writer.value(), STDOUT_FILENO);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "err", O_WRONLY | O_CREAT, 0600);
    const int error =
        posix_spawn(&process_, program.c_str(), &actions, &attributes, argv.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    posix_spawnattr_destroy(&attributes);
    if (error != 0) throw std::runtime_error("cannot start " + program);
    input_ = std::move(in.writer);
    output_ = std::move(out.reader);
}

PipedCommand::~PipedCommand() {
    if (process_ < 0) return;
    ::kill(process_, SIGKILL);
    ::waitpid(process_, nullptr, 0);
}

void PipedCommand::write(const std::string& bytes) const {
    const ssize_t written = ::write(input_.value(), bytes.data(), bytes.size());
    if (written != static_cast<ssize_t>(bytes.size())) throw std::runtime_error("cannot write");
}

std::string PipedCommand::read() const {
    constexpr int kMinute = 60'000;
    pollfd query{output_.value(), POLLIN, 0};
    if (::poll(&query, 1, kMinute) != 1) return {};
    std::array<char, 65536> memory;
    const ssize_t count = ::read(output_.value(), memory.data(), memory.size());
    return count > 0 ? std::string(memory.data(), static_cast<size_t>(count)) : std::string();
}

int PipedCommand::wait() {
    int status = 0;
    ::waitpid(std::exchange(process_, -1), &status, 0);
    return status;
}

}  // namespace tetralight::test
