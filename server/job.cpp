// SPDX-License-Identifier: Apache-2.0
#include <tetralight/server/job.h>

#include <unistd.h>

#include <algorithm>
#include <array>
#include <climits>
#include <cstdlib>

#include <tetralight/base/process/landlock.h>
#include <tetralight/base/process/process.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/server/folders.h>
#include <tetralight/server/slurm.h>

namespace tetralight::server {
namespace {

constexpr size_t kMostOutput = size_t{16} << 20;
/// Niceness of jobs that a client waits for.
constexpr int kNiceness = 5;
/// Niceness of bakes. With a session of their own they give way to queries at once; SCHED_IDLE
/// within the server's session would let a query wait for a slice.
constexpr int kMostNiceness = 19;
/// When memory runs out, a job ends before the server.
constexpr int kOutOfMemoryScore = 800;
/// Exit code for wrong usage.
constexpr int kUsage = 2;

uint64_t machine_memory() {
    const auto pages = static_cast<uint64_t>(::sysconf(_SC_PHYS_PAGES));
    return pages * static_cast<uint64_t>(::sysconf(_SC_PAGESIZE));
}

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
/// Sanitizers reserve terabytes of memory, and read and write files of their own.
constexpr bool kIsSanitized = true;
#else
constexpr bool kIsSanitized = false;
#endif

uint64_t memory_limit(const Settings& settings) {
    if (settings.tool_memory_bytes > 0) return settings.tool_memory_bytes;
    return kIsSanitized ? 0 : machine_memory() / 4 * 3;
}

uint64_t address_space_limit(const Settings& settings) {
    if (settings.tool_address_space_bytes > 0) return settings.tool_address_space_bytes;
    constexpr uint64_t kLeast = uint64_t{64} << 30;
    return kIsSanitized ? 0 : std::max(machine_memory() * 4, kLeast);
}

/// A bake may take days, so only jobs with a time limit have one.
uint64_t processor_seconds_limit(const Settings& settings, const Job& job) {
    if (job.limit_seconds <= 0.0) return 0;
    if (settings.tool_processor_seconds > 0) return settings.tool_processor_seconds;
    const auto processors = static_cast<uint64_t>(std::max(1L, ::sysconf(_SC_NPROCESSORS_ONLN)));
    const uint64_t threads = std::max<uint64_t>(settings.tool_thread_count, processors);
    return static_cast<uint64_t>(job.limit_seconds + 1.0) * threads;
}

/// Where the program of a backend of `/v1/tetrahedralize` may lie (docs/command.md). `name`: with a
/// slash before it. `named_by`: an environment variable.
void add_backend(const std::string& program, const char* name, const char* named_by,
                 std::vector<FileAccess>& files) {
    using Right = FileAccess::Right;
    if (const char* named = std::getenv(named_by)) files.push_back({named, Right::Execute});
    files.push_back({program.substr(0, program.rfind('/')) + name, Right::Execute});
    const char* variable = std::getenv("PATH");
    std::string_view rest = variable == nullptr ? "" : variable;
    while (!rest.empty()) {
        const std::string_view folder = rest.substr(0, rest.find(':'));
        rest.remove_prefix(std::min(rest.size(), folder.size() + 1));
        if (folder.starts_with('/')) files.push_back({str_cat(folder, name), Right::Execute});
    }
}

/// A job reads its folder and writes where its results go: the inputs are links to stored files.
std::vector<FileAccess> files_of_jobs(const std::string& program, const std::string& executable) {
    if (kIsSanitized) return {};
    std::vector<FileAccess> files = program_files();
    files.push_back({executable.empty() ? program : executable, FileAccess::Right::Execute});
    add_backend(program, "/tetralight-cgal", "TETRALIGHT_CGAL", files);
    add_backend(program, "/tetralight-tetgen", "TETRALIGHT_TETGEN", files);
    files.push_back({".", FileAccess::Right::Read});
    files.push_back({kResults, FileAccess::Right::Write});
    return files;
}

std::chrono::milliseconds milliseconds(double seconds) {
    return std::chrono::milliseconds(static_cast<int64_t>(seconds * 1e3));
}

ErrorCode error_code_named(std::string_view name) {
    constexpr ErrorCode kCodes[] = {ErrorCode::InvalidArgument, ErrorCode::Corrupt,
                                    ErrorCode::Unsupported,     ErrorCode::NotFound,
                                    ErrorCode::DiskFull,        ErrorCode::Unavailable,
                                    ErrorCode::OutOfResources,  ErrorCode::Cancelled};
    const auto found = std::ranges::find(kCodes, name, error_code_name);
    return found == std::end(kCodes) ? ErrorCode::Unsupported : *found;
}

Error error_from_json(const Json& json) {
    return {error_code_named(json.value("code", "")), json.value("field", ""),
            json.value("value", ""), json.value("message", "")};
}

Error crash(const std::string& how) {
    return {ErrorCode::Unsupported, "the program " + how};
}

JobResult read_result(const ProcessResult& process) {
    using End = JobResult::End;
    JobResult result;
    if (process.end == ProcessResult::End::Cancelled) {
        result.end = End::Cancelled;
        return result;
    }
    if (process.end == ProcessResult::End::TimedOut) {
        result.end = End::TooSlow;
        return result;
    }
    result.report = object_in(process.output_text());
    const auto error = result.report.find("error");
    if (process.end == ProcessResult::End::Exited && error != result.report.end()) {
        result.end = End::Failed;
        result.error = error_from_json(*error);
        result.is_wrong_usage = process.code == kUsage;
    } else if (process.succeeded()) {
        result.end = End::Done;
    } else {
        result.error = crash(process.failure());
    }
    for (const char* member : {"error", "output", "file"}) result.report.erase(member);
    return result;
}

/// What a machine of a cluster does not finish, it may finish later, or another one.
JobResult read_slurm_result(const Job& job, const ProcessResult& process) {
    using End = JobResult::End;
    JobResult result = read_result(process);
    if (result.end == End::Cancelled) {
        // A job that is left is ended before the next one of its name.
        (void)end_slurm_jobs(job.slurm_name);
    } else if (result.end == End::Crashed || result.report.empty()) {
        // Of a machine that failed, srun may say that all is well.
        result.end = End::Failed;
        const std::string why =
            process.succeeded() ? "has no answer of its program" : process.failure();
        result.error = {ErrorCode::Unavailable,
                        str_cat(kSrun, " ", why, ": ", process.last_error_line())};
    } else if (result.error.code == ErrorCode::Cancelled) {
        result.error.code = ErrorCode::Unavailable;
    }
    return result;
}

JobResult run_in_slurm(const Settings& settings, const Job& job,
                       std::span<const std::span<const std::byte>> input) {
    JobResult result;
    result.end = JobResult::End::Failed;
    if (auto status = end_slurm_jobs(job.slurm_name); !status) {
        result.error = status.error();
        return result;
    }
    const auto process =
        run_process({.program = kSrun,
                     .arguments = srun_arguments(job.slurm_name, settings.tool_thread_count,
                                                 program_of(settings), {"--job", "-"}),
                     .folder = job.folder,
                     .input = input,
                     .group = ProcessGroup::Session,
                     .output_limit = kMostOutput,
                     .is_cancelled = job.is_cancelled});
    if (process) return read_slurm_result(job, *process);
    result.error = process.error();
    return result;
}

}  // namespace

std::string program_of(const Settings& settings) {
    if (!settings.program.empty()) return settings.program;
    std::array<char, PATH_MAX> path;
    const ssize_t length = ::readlink("/proc/self/exe", path.data(), path.size());
    return {path.data(), static_cast<size_t>(std::max<ssize_t>(length, 0))};
}

JobResult run_job(const Settings& settings, const Job& job) {
    Json order{{"command", job.command}};
    order.update(job.settings);
    order["threads"] = settings.tool_thread_count;
    const std::string text = dump(order);
    const std::array input{std::as_bytes(std::span(text))};
    const std::string program = program_of(settings);
    // The same program even if another one was installed since.
    const std::string executable = settings.program.empty() ? "/proc/self/exe" : "";
    const std::vector<FileAccess> files = files_of_jobs(program, executable);
    JobResult result;
    if (auto status = make_folder(job.folder + "/" + kResults); !status) {
        result.error = status.error();
        return result;
    }
    if (!job.slurm_name.empty()) return run_in_slurm(settings, job, input);
    const auto process =
        run_process({.program = program,
                     .arguments = {"--job", "-"},
                     .executable = executable,
                     .folder = job.folder,
                     .input = input,
                     .group = job.is_background ? ProcessGroup::Session : ProcessGroup::Own,
                     .niceness = job.is_background ? kMostNiceness : kNiceness,
                     .memory_limit = memory_limit(settings),
                     .address_space_limit = address_space_limit(settings),
                     .processor_seconds_limit = processor_seconds_limit(settings, job),
                     .files = files,
                     .out_of_memory_score = kOutOfMemoryScore,
                     .time_limit = milliseconds(job.limit_seconds),
                     .output_limit = kMostOutput,
                     .is_cancelled = job.is_cancelled});
    if (process) return read_result(*process);
    result.error = process.error();
    return result;
}

}  // namespace tetralight::server
