// SPDX-License-Identifier: Apache-2.0
#include <tetralight/probes/build/detail/child_process.h>

#include <tetralight/base/str_cat.h>
#include <tetralight/probes/build/detail/child_streams.h>

#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <utility>

namespace tetralight::detail {
namespace {

using Clock = std::chrono::steady_clock;

constexpr size_t kErrorTextLimit = 4096;

/// A running process. It does not outlive this object.
class Process {
  public:
    explicit Process(pid_t id) : id_(id) {}

    Process(const Process&) = delete;
    Process& operator=(const Process&) = delete;

    ~Process() {
        if (has_ended()) return;
        ::kill(id_, SIGKILL);
        while (::waitpid(id_, nullptr, 0) < 0 && errno == EINTR) continue;
    }

    [[nodiscard]] bool has_ended() {
        if (id_ < 0) return true;
        const pid_t ended = ::waitpid(id_, &status_, WNOHANG);
        if (ended == 0 || (ended < 0 && errno == EINTR)) return false;
        // Where SIGCHLD is ignored, nobody learns how a child ended: its output has to tell.
        if (ended < 0) status_ = 0;
        id_ = -1;
        return true;
    }

    /// How it ended, when that was not well.
    [[nodiscard]] std::string problem() const {
        if (WIFSIGNALED(status_)) {
            const int signal = WTERMSIG(status_);
            return str_cat("ended by signal ", signal, " (", ::strsignal(signal), ")");
        }
        const int code = WEXITSTATUS(status_);
        return code == 0 ? "" : str_cat("ended with exit code ", code);
    }

  private:
    pid_t id_;
    int status_ = 0;
};

Result<pid_t> spawn(const std::string& program, int in, int out, int err) {
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, in, STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&actions, out, STDOUT_FILENO);
    posix_spawn_file_actions_adddup2(&actions, err, STDERR_FILENO);
    std::string name = program;
    std::array<char*, 2> arguments{name.data(), nullptr};
    pid_t process = -1;
    errno = ::posix_spawnp(&process, program.c_str(), &actions, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    if (errno != 0) return system_error("start " + program);
    return process;
}

std::string last_line(std::span<const std::byte> bytes) {
    std::string line(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    line.erase(line.find_last_not_of("\n ") + 1);
    return line.substr(line.find_last_of('\n') + 1);
}

/// Gathers what a child says until it has ended.
class Listener {
  public:
    Listener(const ChildCommand& command, OutputPipe out, OutputPipe err)
        : command_(command), out_(std::move(out)), err_(std::move(err)) {}

    Status listen(Process& process) {
        const auto deadline = Clock::now() + command_.time_limit;
        while (true) {
            // Asked before reading: what it wrote while it lived is then all in the pipes.
            const bool has_ended = process.has_ended();
            const auto heard = hear();
            if (!heard) return heard.error();
            if (has_ended && !*heard) return Ok{};
            if (Clock::now() >= deadline) {
                const std::chrono::duration<double> limit = command_.time_limit;
                return Error{str_cat("did not end within ", limit.count(), " s")};
            }
            if (!*heard) wait();
        }
    }

    [[nodiscard]] std::vector<std::byte> take_output() { return std::move(output_); }

    [[nodiscard]] std::string error_line() const { return last_line(error_text_); }

  private:
    /// Whether there was anything.
    Result<bool> hear() {
        const bool has_text = err_.read(error_text_);
        if (error_text_.size() > kErrorTextLimit) {
            error_text_.erase(error_text_.begin(), error_text_.end() - kErrorTextLimit);
        }
        if (!out_.read(output_)) return has_text;
        if (auto status = command_.check_output(output_); !status) return status.error();
        return true;
    }

    void wait() const {
        std::array<pollfd, 2> streams{pollfd{out_.read_end(), POLLIN, 0},
                                      pollfd{err_.read_end(), POLLIN, 0}};
        // Streams end a moment before their process does. A process may also end before its
        // streams, when it leaves them to another one.
        const int milliseconds = out_.has_ended() && err_.has_ended() ? 1 : 20;
        ::poll(streams.data(), streams.size(), milliseconds);
    }

    const ChildCommand& command_;
    OutputPipe out_;
    OutputPipe err_;
    std::vector<std::byte> output_;
    std::vector<std::byte> error_text_;
};

Result<std::vector<std::byte>> run(const ChildCommand& command, const Descriptor& input) {
    OutputPipe out, err;
    for (OutputPipe* pipe : {&out, &err}) {
        if (auto status = pipe->open(); !status) return status.error();
    }
    const auto id = spawn(command.program, input.value(), out.write_end(), err.write_end());
    if (!id) return id.error();
    Process process(*id);
    out.close_write_end();
    err.close_write_end();

    Listener listener(command, std::move(out), std::move(err));
    if (auto status = listener.listen(process); !status) return status.error();
    if (std::string problem = process.problem(); !problem.empty()) {
        std::string why = listener.error_line();
        const std::string prefix = command.name() + ": ";
        if (why.starts_with(prefix)) why.erase(0, prefix.size());
        return Error{why.empty() ? problem : problem + ": " + why};
    }
    return listener.take_output();
}

}  // namespace

std::string ChildCommand::name() const {
    return program.substr(program.find_last_of('/') + 1);
}

Result<std::vector<std::byte>> run_child(const ChildCommand& command,
                                         std::span<const std::span<const std::byte>> input) {
    const auto file = make_memory_file(input);
    if (!file) return file.error().in(command.name());
    auto output = run(command, *file);
    if (!output) return output.error().in(command.name());
    return output;
}

}  // namespace tetralight::detail
