// SPDX-License-Identifier: Apache-2.0
#include <tetralight/base/process/process.h>

#include <fcntl.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <optional>
#include <utility>

#include <tetralight/base/process/descriptor_io.h>
#include <tetralight/base/process/detail/spawn.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/base/system_error.h>

namespace tetralight {
namespace {

using Clock = std::chrono::steady_clock;
using Bytes = std::span<const std::byte>;

/// A file in memory, at its beginning. Unlike a pipe it needs no thread that writes to it while the
/// child reads.
Result<Descriptor> make_memory_file(std::span<const Bytes> parts) {
    Descriptor file(::memfd_create("stdin", MFD_CLOEXEC));
    if (!file) return system_error("make a file in memory");
    for (const Bytes part : parts) {
        if (!write_all(file, part)) return system_error("write a file in memory");
    }
    ::lseek(file.value(), 0, SEEK_SET);
    return file;
}

Result<Descriptor> open_input(std::span<const Bytes> parts) {
    if (!parts.empty()) return make_memory_file(parts);
    Descriptor nothing(::open("/dev/null", O_RDONLY | O_CLOEXEC));
    if (!nothing) return system_error("/dev/null", "open");
    return nothing;
}

/// A stream that a child writes to and that is read here without waiting.
struct OutputPipe {
    Descriptor read_end;
    Descriptor write_end;

    Status open() {
        int ends[2];
        if (::pipe2(ends, O_CLOEXEC) != 0) return system_error("make a pipe");
        read_end = Descriptor(ends[0]);
        write_end = detail::above_standard(Descriptor(ends[1]));
        if (!write_end) return system_error("make a pipe");
        ::fcntl(read_end.value(), F_SETFL, O_NONBLOCK);
        return Ok{};
    }

    /// What has arrived, in `memory`; empty if nothing has. Closes the pipe at its end.
    Bytes read(std::span<std::byte> memory) {
        if (!read_end) return {};
        const ssize_t count = ::read(read_end.value(), memory.data(), memory.size());
        if (count == 0) read_end.close();
        return memory.first(static_cast<size_t>(std::max<ssize_t>(count, 0)));
    }
};

/// A running child. Killed and waited for when this object ends before it.
class Child {
  public:
    Child(pid_t id, ProcessGroup group) : id_(id), group_(group) {}

    Child(const Child&) = delete;
    Child& operator=(const Child&) = delete;

    ~Child() { kill(); }

    /// True once the process has ended; `status` is how.
    [[nodiscard]] bool has_ended() {
        if (id_ < 0) return true;
        const pid_t ended = ::waitpid(id_, &status_, WNOHANG);
        if (ended == 0 || (ended < 0 && errno == EINTR)) return false;
        // If SIGCHLD is ignored, the system does not keep how a child ended.
        if (ended < 0) status_ = 0;
        id_ = -1;
        return true;
    }

    [[nodiscard]] int status() const { return status_; }

    void kill() {
        if (has_ended()) return;
        if (group_ != ProcessGroup::Shared) ::kill(-id_, SIGKILL);
        ::kill(id_, SIGKILL);
        while (::waitpid(id_, &status_, 0) < 0 && errno == EINTR) {
        }
        id_ = -1;
    }

  private:
    pid_t id_;
    ProcessGroup group_;
    int status_ = 0;
};

/// Gathers what a child writes until it has ended.
class Listener {
  public:
    Listener(const ProcessCommand& command, OutputPipe out, OutputPipe err)
        : command_(command), out_(std::move(out)), err_(std::move(err)) {}

    Result<ProcessResult> listen(Child& child) {
        const auto begin = Clock::now();
        while (true) {
            // Asked before reading: all that the process wrote is in the pipes then.
            const bool has_ended = child.has_ended();
            const auto has_read = read();
            if (!has_read) return has_read.error();
            if (has_ended && !*has_read) return finish(child.status());
            if (const auto end = forced_end(begin)) {
                child.kill();
                result_.end = *end;
                return std::move(result_);
            }
            if (!*has_read) wait();
        }
    }

  private:
    /// True if anything was read.
    Result<bool> read() {
        const Bytes text = err_.read(memory_);
        result_.errors.append(reinterpret_cast<const char*>(text.data()), text.size());
        if (result_.errors.size() > command_.error_limit) {
            result_.errors.erase(0, result_.errors.size() - command_.error_limit);
        }
        const bool has_text = !text.empty();
        const Bytes output = out_.read(memory_);
        if (output.empty()) return has_text;
        auto& kept = result_.output;
        const Bytes added =
            output.first(std::min(output.size(), command_.output_limit - kept.size()));
        kept.insert(kept.end(), added.begin(), added.end());
        if (!command_.check_output || added.empty()) return true;
        if (auto status = command_.check_output(kept); !status) return status.error();
        return true;
    }

    [[nodiscard]] std::optional<ProcessResult::End> forced_end(Clock::time_point begin) const {
        const auto now = Clock::now();
        if (command_.time_limit.count() > 0 && now >= begin + command_.time_limit) {
            return ProcessResult::End::TimedOut;
        }
        if (command_.is_cancelled && command_.is_cancelled()) return ProcessResult::End::Cancelled;
        return std::nullopt;
    }

    void wait() const {
        std::array<pollfd, 2> streams{pollfd{out_.read_end.value(), POLLIN, 0},
                                      pollfd{err_.read_end.value(), POLLIN, 0}};
        // Streams end a moment before their process does. A process may also end before its
        // streams, if it leaves them to another one.
        const int milliseconds = out_.read_end || err_.read_end ? 20 : 1;
        ::poll(streams.data(), streams.size(), milliseconds);
    }

    ProcessResult finish(int status) {
        const bool is_signal = WIFSIGNALED(status);
        result_.end = is_signal ? ProcessResult::End::Signalled : ProcessResult::End::Exited;
        result_.code = is_signal ? WTERMSIG(status) : WEXITSTATUS(status);
        return std::move(result_);
    }

    const ProcessCommand& command_;
    OutputPipe out_;
    OutputPipe err_;
    ProcessResult result_;
    std::array<std::byte, 1 << 16> memory_;
};

Result<ProcessResult> run(const ProcessCommand& command) {
    auto input = open_input(command.input);
    if (!input) return input.error();
    const Descriptor stdin_file = detail::above_standard(std::move(*input));
    OutputPipe out, err;
    for (OutputPipe* pipe : {&out, &err}) {
        if (auto status = pipe->open(); !status) return status.error();
    }
    const auto id =
        detail::spawn(command, {stdin_file.value(), out.write_end.value(), err.write_end.value()});
    if (!id) return id.error();
    Child child(*id, command.group);
    out.write_end.close();
    err.write_end.close();
    return Listener(command, std::move(out), std::move(err)).listen(child);
}

}  // namespace

std::string ProcessCommand::name() const {
    return program.substr(program.find_last_of('/') + 1);
}

std::string ProcessResult::failure() const {
    switch (end) {
        case End::Exited:
            return str_cat("ended with exit code ", code);
        case End::Signalled:
            return str_cat("ended by signal ", code, " (", ::strsignal(code), ")");
        case End::TimedOut:
            return "ran longer than its time limit";
        case End::Cancelled:
            break;
    }
    return "was cancelled";
}

std::string ProcessResult::last_error_line() const {
    const std::string text = errors.substr(0, errors.find_last_not_of("\n ") + 1);
    return text.substr(text.find_last_of('\n') + 1);
}

Result<ProcessResult> run_process(const ProcessCommand& command) {
    auto result = run(command);
    if (!result) return result.error().in(command.name());
    return result;
}

}  // namespace tetralight
