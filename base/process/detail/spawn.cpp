// SPDX-License-Identifier: Apache-2.0
#include <tetralight/base/process/detail/spawn.h>

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <string>

#include <tetralight/base/process/detail/restrict_files.h>
#include <tetralight/base/system_error.h>

namespace tetralight::detail {
namespace {

/// What a child that could not become the program tells its parent.
struct StartFailure {
    int error_number = 0;
    bool is_folder = false;
};

/// All that a child needs between fork and exec. It is made before the fork, because the child of a
/// process with threads may only make system calls until then.
struct ChildPlan {
    const char* executable = nullptr;
    std::vector<char*> arguments;
    const char* folder = nullptr;
    ChildStreams streams;
    int failure_pipe = -1;
    pid_t parent = -1;
    ProcessGroup group = ProcessGroup::Shared;
    int niceness = 0;
    uint64_t memory_limit = 0;
    uint64_t address_space_limit = 0;
    uint64_t processor_seconds_limit = 0;
    std::string niceness_text;
    std::string score_text;
    std::span<const FileAccess> files;
    int landlock_version = 0;
};

/// Writes to a file of the kernel, if this system has it.
void write_if_possible(const char* path, const std::string& text) {
    const int file = ::open(path, O_WRONLY | O_CLOEXEC);
    if (file < 0) return;
    [[maybe_unused]] const ssize_t ignored = ::write(file, text.data(), text.size());
    ::close(file);
}

void set_group_and_priority(const ChildPlan& plan) {
    if (plan.group == ProcessGroup::Own) ::setpgid(0, 0);
    if (plan.group == ProcessGroup::Session) {
        ::setsid();
        write_if_possible("/proc/self/autogroup", plan.niceness_text);
    }
    if (plan.niceness != 0) ::setpriority(PRIO_PROCESS, 0, plan.niceness);
}

/// Lowers a limit. Leaves a lower one, which this process may have itself.
void lower_limit(int resource, rlim_t soft, rlim_t hard) {
    rlimit limit = {};
    ::getrlimit(static_cast<__rlimit_resource>(resource), &limit);
    limit.rlim_max = std::min(limit.rlim_max, hard);
    limit.rlim_cur = std::min({limit.rlim_cur, limit.rlim_max, soft});
    ::setrlimit(static_cast<__rlimit_resource>(resource), &limit);
}

void set_limits(const ChildPlan& plan) {
    ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
    lower_limit(RLIMIT_CORE, 0, 0);
    if (plan.memory_limit > 0) lower_limit(RLIMIT_DATA, plan.memory_limit, plan.memory_limit);
    if (plan.address_space_limit > 0) {
        lower_limit(RLIMIT_AS, plan.address_space_limit, plan.address_space_limit);
    }
    if (plan.processor_seconds_limit > 0) {
        // SIGXCPU at the first limit, SIGKILL at the second one if the program ignores that.
        lower_limit(RLIMIT_CPU, plan.processor_seconds_limit, plan.processor_seconds_limit + 1);
    }
    if (!plan.score_text.empty()) write_if_possible("/proc/self/oom_score_adj", plan.score_text);
}

void restore_signals() {
    sigset_t none;
    ::sigemptyset(&none);
    ::sigprocmask(SIG_SETMASK, &none, nullptr);
    for (const int signal : {SIGPIPE, SIGTERM, SIGINT, SIGCHLD, SIGXCPU}) {
        ::signal(signal, SIG_DFL);
    }
}

bool redirect(const ChildStreams& streams) {
    return ::dup2(streams.input, STDIN_FILENO) >= 0 && ::dup2(streams.output, STDOUT_FILENO) >= 0 &&
           ::dup2(streams.errors, STDERR_FILENO) >= 0;
}

[[noreturn]] void fail(const ChildPlan& plan, bool is_folder) {
    const StartFailure failure{errno, is_folder};
    [[maybe_unused]] const ssize_t ignored = ::write(plan.failure_pipe, &failure, sizeof failure);
    ::_exit(127);
}

/// Replaces the new process by the program.
[[noreturn]] void execute(const ChildPlan& plan) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (::getppid() != plan.parent) ::_exit(127);  // the parent ended before the line above
    set_group_and_priority(plan);
    set_limits(plan);
    restore_signals();
    if (!redirect(plan.streams)) fail(plan, false);
    if (*plan.folder != '\0' && ::chdir(plan.folder) != 0) fail(plan, true);
    const bool is_restricted = !plan.files.empty() && plan.landlock_version > 0;
    if (is_restricted && !restrict_files(plan.files, plan.landlock_version)) fail(plan, false);
    ::execvp(plan.executable, plan.arguments.data());
    fail(plan, false);
}

ChildPlan make_plan(const ProcessCommand& command, const ChildStreams& streams, int failure_pipe) {
    ChildPlan plan;
    plan.executable = (command.executable.empty() ? command.program : command.executable).c_str();
    plan.arguments.push_back(const_cast<char*>(command.program.c_str()));
    for (const std::string& argument : command.arguments) {
        plan.arguments.push_back(const_cast<char*>(argument.c_str()));
    }
    plan.arguments.push_back(nullptr);
    plan.folder = command.folder.c_str();
    plan.streams = streams;
    plan.failure_pipe = failure_pipe;
    plan.parent = ::getpid();
    plan.group = command.group;
    plan.niceness = command.niceness;
    plan.memory_limit = command.memory_limit;
    plan.address_space_limit = command.address_space_limit;
    plan.processor_seconds_limit = command.processor_seconds_limit;
    plan.niceness_text = std::to_string(command.niceness);
    if (command.out_of_memory_score != 0) {
        plan.score_text = std::to_string(command.out_of_memory_score);
    }
    plan.files = command.files;
    if (!plan.files.empty()) plan.landlock_version = landlock_version();
    return plan;
}

Error start_error(const ProcessCommand& command, const StartFailure& failure) {
    errno = failure.error_number;
    return failure.is_folder ? system_error(command.folder, "enter")
                             : system_error("start " + command.program);
}

}  // namespace

Descriptor above_standard(Descriptor descriptor) {
    if (!descriptor || descriptor.value() > STDERR_FILENO) return descriptor;
    return Descriptor(::fcntl(descriptor.value(), F_DUPFD_CLOEXEC, STDERR_FILENO + 1));
}

Result<pid_t> spawn(const ProcessCommand& command, const ChildStreams& streams) {
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0) return system_error("make a pipe");
    const Descriptor read_end(ends[0]);
    Descriptor write_end = above_standard(Descriptor(ends[1]));
    const ChildPlan plan = make_plan(command, streams, write_end.value());
    const pid_t child = ::fork();
    if (child == 0) execute(plan);
    if (child < 0) return system_error("start " + command.program);

    // The pipe ends without a word when the program takes over.
    write_end.close();
    StartFailure failure;
    ssize_t count = 0;
    do {
        count = ::read(read_end.value(), &failure, sizeof failure);
    } while (count < 0 && errno == EINTR);
    if (count != sizeof failure) return child;
    while (::waitpid(child, nullptr, 0) < 0 && errno == EINTR) {
    }
    return start_error(command, failure);
}

}  // namespace tetralight::detail
