// SPDX-License-Identifier: Apache-2.0
#include <tetralight/server/command.h>

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <climits>
#include <csignal>
#include <cstring>
#include <optional>

#include <tetralight/base/descriptor.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/server/problem.h>

namespace tetralight::server {
namespace {

using Clock = std::chrono::steady_clock;

constexpr size_t kMostOutput = size_t{16} << 20;
/// How much less than queries a command counts that somebody waits for.
constexpr int kNiceness = 5;
/// Of bakes: no query that wakes up shall wait for one. Linux weighs sessions, not processes, where
/// it makes a group of each (sched(7), autogroup); a session of little weight gives way at once,
/// SCHED_IDLE within a session after a slice.
constexpr int kMostNiceness = 19;

struct Pipe {
    Descriptor read;
    Descriptor write;
};

std::optional<Pipe> make_pipe() {
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0) return std::nullopt;
    return Pipe{Descriptor(ends[0]), Descriptor(ends[1])};
}

uint64_t memory_limit(const Settings& settings) {
    if (settings.tool_memory_bytes > 0) return settings.tool_memory_bytes;
    const auto pages = static_cast<uint64_t>(::sysconf(_SC_PHYS_PAGES));
    return pages * static_cast<uint64_t>(::sysconf(_SC_PAGESIZE)) / 4 * 3;
}

/// Tells the kernel, where it has such a file.
void say_to(const char* path, const char* words) {
    const int file = ::open(path, O_WRONLY | O_CLOEXEC);
    if (file < 0) return;
    [[maybe_unused]] const ssize_t ignored = ::write(file, words, std::strlen(words));
    ::close(file);
}

/// The new process, before it becomes the command. Calls only what is allowed after a fork of a
/// process with threads.
[[noreturn]] void become(const char* program, char* const* arguments, const char* folder,
                         uint64_t memory, bool is_background, int output, int errors,
                         pid_t parent) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (::getppid() != parent) ::_exit(127);  // it was too late for that
    // A group of its own: Ctrl-C is for the server, which then ends its commands.
    if (is_background) {
        ::setsid();
        say_to("/proc/self/autogroup", "19");
    } else {
        ::setpgid(0, 0);
    }
    ::setpriority(PRIO_PROCESS, 0, is_background ? kMostNiceness : kNiceness);
    const rlimit limit{memory, memory};
    ::setrlimit(RLIMIT_DATA, &limit);
    const rlimit no_core{0, 0};
    ::setrlimit(RLIMIT_CORE, &no_core);
    say_to("/proc/self/oom_score_adj", "800");
    sigset_t none;
    ::sigemptyset(&none);
    ::sigprocmask(SIG_SETMASK, &none, nullptr);
    for (const int signal : {SIGPIPE, SIGTERM, SIGINT}) ::signal(signal, SIG_DFL);
    const int nothing = ::open("/dev/null", O_RDONLY);
    if (::dup2(nothing, STDIN_FILENO) < 0 || ::dup2(output, STDOUT_FILENO) < 0 ||
        ::dup2(errors, STDERR_FILENO) < 0 || ::chdir(folder) != 0) {
        ::_exit(127);
    }
    ::execv(program, arguments);
    ::_exit(127);
}

/// A running command.
struct Child {
    pid_t pid = -1;
    Descriptor output;
    Descriptor errors;
    std::string output_text = {};
    std::string error_text = {};

    /// Reads what is there, waiting a little. False: both ends are closed.
    bool read_some() {
        pollfd ends[] = {{output.value(), POLLIN, 0}, {errors.value(), POLLIN, 0}};
        ::poll(ends, 2, 50);
        take(ends[0], output, output_text);
        take(ends[1], errors, error_text);
        return output || errors;
    }

    /// With the programs that it began.
    void kill() const {
        ::kill(-pid, SIGKILL);
        ::kill(pid, SIGKILL);  // it may have no group yet
    }

    static void take(const pollfd& end, Descriptor& from, std::string& text) {
        if (end.revents == 0 || !from) return;
        std::array<char, 65536> memory;
        const ssize_t count = ::read(from.value(), memory.data(), memory.size());
        if (count < 0 && (errno == EINTR || errno == EAGAIN)) return;
        if (count <= 0) {
            from.close();
        } else if (text.size() < kMostOutput) {
            text.append(memory.data(), static_cast<size_t>(count));
        }
    }
};

std::optional<Child> start(const Settings& settings, const Command& command) {
    auto output = make_pipe();
    auto errors = make_pipe();
    if (!output || !errors) return std::nullopt;
    const std::string program = program_of(settings);
    std::vector<std::string> texts{program};
    texts.insert(texts.end(), command.arguments.begin(), command.arguments.end());
    std::vector<char*> arguments;
    for (std::string& text : texts) arguments.push_back(text.data());
    arguments.push_back(nullptr);
    const uint64_t memory = memory_limit(settings);
    const pid_t parent = ::getpid();
    const pid_t pid = ::fork();
    if (pid == 0) {
        // The same program even where another was installed since.
        const char* file = settings.program.empty() ? "/proc/self/exe" : program.c_str();
        become(file, arguments.data(), command.folder.c_str(), memory, command.is_background,
               output->write.value(), errors->write.value(), parent);
    }
    if (pid < 0) return std::nullopt;
    return Child{pid, std::move(output->read), std::move(errors->read)};
}

/// Sorts lines of stderr.
void read_errors(const std::string& errors, CommandResult& result) {
    constexpr std::string_view kWarning = "warning: ";
    constexpr std::string_view kProgram = "tetralight";
    for (size_t begin = 0; begin < errors.size();) {
        const size_t end = std::min(errors.find('\n', begin), errors.size());
        const std::string_view line = std::string_view(errors).substr(begin, end - begin);
        begin = end + 1;
        if (line.starts_with(kWarning)) {
            result.warnings.emplace_back(line.substr(kWarning.size()));
        } else if (line.starts_with(kProgram)) {  // "tetralight: ..." or "tetralight bake: ..."
            const size_t colon = line.find(": ");
            if (colon != std::string_view::npos) result.message = line.substr(colon + 2);
        }
    }
}

void judge(int status, CommandResult& result) {
    using End = CommandResult::End;
    if (WIFSIGNALED(status)) {
        result.message = str_cat("the program was ended by signal ", WTERMSIG(status), " (",
                                 ::strsignal(WTERMSIG(status)), ")");
        return;
    }
    switch (WEXITSTATUS(status)) {
        case 0:
            result.end = End::Fine;
            break;
        case 1:
            result.end = End::BadData;
            break;
        case 2:
            result.end = End::BadUsage;
            break;
        default:
            if (result.message.empty()) {
                result.message = str_cat("the program ended with code ", WEXITSTATUS(status));
            }
    }
}

}  // namespace

std::string program_of(const Settings& settings) {
    if (!settings.program.empty()) return settings.program;
    std::array<char, PATH_MAX> path;
    const ssize_t length = ::readlink("/proc/self/exe", path.data(), path.size());
    return {path.data(), static_cast<size_t>(std::max<ssize_t>(length, 0))};
}

CommandResult run_command(const Settings& settings, const Command& command) {
    using End = CommandResult::End;
    CommandResult result;
    auto child = start(settings, command);
    if (!child) {
        result.message = str_cat("cannot run the program (", std::strerror(errno), ")");
        return result;
    }
    const auto begin = Clock::now();
    std::optional<End> forced;
    while (child->read_some()) {
        const std::chrono::duration<double> elapsed = Clock::now() - begin;
        if (forced) continue;
        if (command.goes_on && !command.goes_on()) forced = End::Stopped;
        if (command.limit_seconds > 0.0 && elapsed.count() > command.limit_seconds) {
            forced = End::TooSlow;
        }
        // Whatever it leaves behind, it is written so that it may end at any time.
        if (forced) child->kill();
    }
    int status = 0;
    while (::waitpid(child->pid, &status, 0) < 0 && errno == EINTR) {
    }
    read_errors(child->error_text, result);
    judge(status, result);
    if (forced) result.end = *forced;
    result.report = object_in(child->output_text);
    return result;
}

Json report_of(CommandResult result) {
    result.report.erase("output");
    result.report.erase("file");
    if (!result.warnings.empty()) result.report["warnings"] = result.warnings;
    return std::move(result.report);
}

Json run_or_throw(const Settings& settings, const Command& command) {
    CommandResult result = run_command(settings, command);
    if (result.end == CommandResult::End::Fine) return report_of(std::move(result));
    throw Problem{500, "tool_failed", result.message};
}

}  // namespace tetralight::server
