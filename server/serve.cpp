// SPDX-License-Identifier: Apache-2.0
#include <tetralight/server/serve.h>

#include <fcntl.h>
#include <malloc.h>
#include <pthread.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <optional>
#include <thread>

#include <tetralight/base/process/landlock.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/base/system_error.h>
#include <tetralight/server/dispatcher.h>
#include <tetralight/server/gate.h>
#include <tetralight/server/http_server.h>
#include <tetralight/server/retention.h>
#include <tetralight/server/service.h>
#include <tetralight/server/slurm.h>

namespace tetralight::server {
namespace {

/// Keeps the memory of answers of some megabytes instead of mapping it again for each one.
void keep_memory() {
    ::mallopt(M_MMAP_THRESHOLD, 32 << 20);
    ::mallopt(M_TRIM_THRESHOLD, 256 << 20);
}

/// A closed standard descriptor would become that of a file or of a client, into which messages
/// then go.
void open_standard_descriptors() {
    for (const int file : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
        if (::fcntl(file, F_GETFD) < 0) (void)!::open("/dev/null", O_RDWR);
    }
}

/// Raises the limit of descriptors as far as allowed: each connection needs one.
void raise_descriptor_limit() {
    rlimit limit = {};
    if (::getrlimit(RLIMIT_NOFILE, &limit) != 0) return;
    limit.rlim_cur = limit.rlim_max;
    ::setrlimit(RLIMIT_NOFILE, &limit);
}

/// Makes sure that only one server writes to a folder.
Result<Descriptor> lock_folder(const std::string& folder) {
    const std::string path = folder + "/lock";
    Descriptor lock(::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644));
    if (!lock) return system_error(path, "open");
    if (::flock(lock.value(), LOCK_EX | LOCK_NB) == 0) return lock;
    return Error{ErrorCode::Unavailable, "data", folder,
                 folder + ": another server writes to this folder; --read-only can serve it too"};
}

/// Calls a function on SIGTERM and SIGINT, on a thread of its own instead of in a signal handler.
class SignalWatch {
  public:
    explicit SignalWatch(std::function<void()> on_end) : on_end_(std::move(on_end)) {
        thread_ = std::thread([this] {
            int signal = 0;
            ::sigwait(&signals(), &signal);
            if (signal != SIGUSR1) on_end_();
        });
    }

    ~SignalWatch() {
        ::pthread_kill(thread_.native_handle(), SIGUSR1);
        thread_.join();
    }

    SignalWatch(const SignalWatch&) = delete;
    SignalWatch& operator=(const SignalWatch&) = delete;

    static const sigset_t& signals() {
        static const sigset_t set = [] {
            sigset_t all;
            ::sigemptyset(&all);
            for (const int signal : {SIGTERM, SIGINT, SIGUSR1}) ::sigaddset(&all, signal);
            return all;
        }();
        return set;
    }

  private:
    std::function<void()> on_end_;
    std::thread thread_;
};

bool has_tokens(const Settings& settings) {
    return !settings.token.empty() || !settings.token_file.empty() ||
           !settings.read_token_file.empty();
}

/// Tells the log that descriptors run out, once a minute at most.
class WarningOfDescriptors {
  public:
    explicit WarningOfDescriptors(Log& log) : log_(&log) {}

    void operator()(size_t closed) {
        constexpr auto kBetweenWarnings = std::chrono::minutes(1);
        const auto now = std::chrono::steady_clock::now();
        if (last_ && now - *last_ < kBetweenWarnings) return;
        last_ = now;
        log_->write(Log::Level::Warning,
                    "descriptors run out; the connections that were idle longest are closed",
                    {{"closed", closed}});
    }

  private:
    Log* log_;
    std::optional<std::chrono::steady_clock::time_point> last_;
};

Json start_facts(const Settings& settings, const Store& store, uint16_t port) {
    return {{"version", TETRALIGHT_VERSION},
            {"data", settings.data},
            {"address", settings.address},
            {"port", port},
            {"token", has_tokens(settings) ? "needed" : "none"},
            {"read_only", settings.is_read_only},
            {"viewer", settings.viewer},
            {"landlock", landlock_version()},
            {"findings", store.findings()}};
}

}  // namespace

Status serve(const Settings& settings, const std::function<void(uint16_t port)>& is_listening) {
    if (!is_loopback(settings.address) && !has_tokens(settings)) {
        return Error{ErrorCode::InvalidArgument, "listen", settings.address,
                     settings.address + ": can be reached from other machines and needs a token"};
    }
    open_standard_descriptors();
    ::signal(SIGPIPE, SIG_IGN);
    ::pthread_sigmask(SIG_BLOCK, &SignalWatch::signals(), nullptr);  // threads inherit it
    keep_memory();
    raise_descriptor_limit();
    if (settings.bakes_on == Settings::BakesOn::Slurm && !settings.is_read_only) {
        if (auto status = find_slurm(); !status) return status;
    }
    Log log(settings.log_level);
    auto tokens = Tokens::open(settings, log);
    if (!tokens) return tokens.error();
    Metrics metrics;
    Descriptor lock;
    if (!settings.is_read_only) {
        if (auto status = make_folder(settings.data); !status) return status;
        auto locked = lock_folder(settings.data);
        if (!locked) return locked.error();
        lock = std::move(*locked);
    }
    auto store = Store::open(settings, log, metrics);
    if (!store) return store.error();
    OpenVolumes volumes(**store);
    Bakes bakes(settings, **store, log);
    const Readiness readiness(settings);
    const Retention retention(**store, bakes, volumes, log);
    VerifiedFiles files(**store);
    Service service{settings, log, metrics, **store, volumes, bakes, readiness, **tokens, files};
    const Dispatcher dispatcher(service);
    auto http = HttpServer::bind(
        settings,
        {.plan = [&](Request& request) { return dispatcher.plan(request); },
         .answered =
             [&](const Exchange& exchange) {
                 metrics.add(exchange);
                 log.request(exchange);
             },
         .refusal = [&](const Problem& problem,
                        const Request& request) { return dispatcher.refuse(problem, request); },
         .lacks_descriptors = WarningOfDescriptors(log)});
    if (!http) return http.error();
    service.connection_count = [&] { return (*http)->connection_count(); };
    service.waiting_count = [&](Plan::RunOn place) { return (*http)->waiting_count(place); };
    log.write(Log::Level::Info, "serving", start_facts(settings, **store, (*http)->port()));
    {
        const SignalWatch watch([&] {
            service.is_ending = true;
            log.write(Log::Level::Info, "ending");
            (*http)->stop();
        });
        is_listening((*http)->port());
        (*http)->run();
    }
    service.is_over = true;
    http->reset();  // ends its workers; the signal watch that stops it is gone
    log.write(Log::Level::Info, "ended");
    return Ok{};
}

}  // namespace tetralight::server
