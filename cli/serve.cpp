// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/serve.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <filesystem>
#include <iostream>

#include <tetralight/base/file.h>
#include <tetralight/base/str_cat.h>
#include <tetralight/cli/choice.h>
#include <tetralight/cli/common.h>
#include <tetralight/cli/paths.h>
#include <tetralight/server/job.h>
#include <tetralight/server/find_viewer.h>
#include <tetralight/server/serve.h>

namespace tetralight::cli {
namespace {

constexpr const char* kTokenVariable = "TETRALIGHT_TOKEN";

constexpr double kMostThreads = 1024;
constexpr double kMostCount = 1e6;
constexpr double kMostBytes = 1e15;
constexpr double kLeastSeconds = 0.01;
constexpr double kMostSeconds = 86400;

/// "127.0.0.1:8080", "[::1]:8080"; port 0 takes one that is free. False: it is neither.
bool parse_listen(const std::string& listen, server::Settings& settings) {
    const size_t colon = listen.rfind(':');
    if (colon == std::string::npos || colon == 0) return false;
    const char* end = listen.data() + listen.size();
    const auto [next, error] = std::from_chars(listen.data() + colon + 1, end, settings.port);
    std::string address = listen.substr(0, colon);
    if (address.starts_with('[') && address.ends_with(']')) {
        address = address.substr(1, address.size() - 2);
    }
    settings.address = address == "localhost" ? "127.0.0.1" : address;
    return error == std::errc{} && next == end;
}

bool is_visible(std::string_view text) {
    return std::ranges::all_of(text, [](char c) { return c > ' ' && c <= '~'; });
}

/// "*" or "https://example.com:8080", as browsers write it.
bool is_origin(std::string_view text) {
    if (text == "*") return true;
    const size_t scheme = text.find("://");
    if (scheme == std::string_view::npos || !is_visible(text)) return false;
    const std::string_view host = text.substr(scheme + 3);
    const auto is_upper = [](char c) { return c >= 'A' && c <= 'Z'; };
    return (text.starts_with("http://") || text.starts_with("https://")) && !host.empty() &&
           host.find_first_of("/?#@,") == std::string_view::npos &&
           std::ranges::none_of(text, is_upper);
}

/// "light.example.com": what `Host` says before its port.
bool is_host(std::string_view text) {
    return !text.empty() && is_visible(text) &&
           text.find_first_of(":/?#@,*") == std::string_view::npos;
}

CLI::Validator only(bool (*is_right)(std::string_view), const char* what) {
    const auto check = [is_right, what](const std::string& text) {
        return is_right(text) ? std::string() : "\"" + text + "\" is not " + what;
    };
    return {check, ""};
}

struct Serve {
    server::Settings settings;
    std::string listen = "127.0.0.1:8080";
    std::string token_file;

    void add_to(CLI::App& command) {
        add_path(command, "--data", settings.data, "Folder of all state; made if it is not there")
            ->required();
        command
            .add_option("--listen", listen,
                        "Address and port; any other than this machine's own needs a token")
            ->check(CLI::Validator(
                [](const std::string& text) {
                    server::Settings ignored;
                    return parse_listen(text, ignored) ? ""
                                                       : "\"" + text + "\" is not ADDRESS:PORT";
                },
                "ADDRESS:PORT"))
            ->capture_default_str();
        add_path(command, "--token-file", token_file,
                 "File with the bearer token that clients send; or $TETRALIGHT_TOKEN");
        command.add_flag("--read-only", settings.is_read_only,
                         "Answer queries from a folder that another server writes to");
        command
            .add_option("--cors-origin", settings.cors_origins,
                        "Origin whose pages may call, * = all; may be given several times")
            ->check(only(is_origin, "an origin such as https://example.com"))
            ->allow_extra_args(false);
        command
            .add_option("--allowed-host", settings.allowed_hosts,
                        "Name by which a proxy may call a server without a token; may be given "
                        "several times")
            ->check(only(is_host, "a name without a port, such as light.example.com"))
            ->allow_extra_args(false);
        add_path(command, "--viewer", settings.viewer,
                 "Folder of the web page to serve at / (default: the viewer that was built or "
                 "installed with this program)")
            ->check(CLI::ExistingDirectory)
            ->check(only(server::has_page, "a folder with an index.html"));
        add_choice(command, "--log", settings.log_level,
                   {{"debug", server::Log::Level::Debug},
                    {"info", server::Log::Level::Info},
                    {"warning", server::Log::Level::Warning},
                    {"error", server::Log::Level::Error},
                    {"nothing", server::Log::Level::Nothing}},
                   "What to write to stderr, as lines of JSON");
        add_limits(command);
    }

    void add_limits(CLI::App& command) {
        const auto add = [&](const char* name, auto& value, double least, double most,
                             const char* help) {
            command.add_option(name, value, help)
                ->check(numbers_in(least, most).description(""))
                ->capture_default_str();
        };
        add("--threads", settings.thread_count, 0, kMostThreads,
            "Threads that answer requests (0 = all)");
        add("--tool-threads", settings.tool_thread_count, 0, kMostThreads,
            "Threads of a bake, and of other programs that work for requests (0 = all)");
        add("--workers", settings.worker_count, 1, kMostThreads,
            "Such programs at once, beside the bake");
        add("--max-waiting", settings.max_waiting, 1, kMostCount,
            "Requests that may wait for them");
        add("--max-bakes", settings.max_queued_bakes, 1, kMostCount, "Bakes that may wait");
        add("--max-connections", settings.max_connections, 1, kMostCount, "Open connections");
        add("--max-body", settings.max_body_bytes, 1, kMostBytes, "Bytes of a request");
        add("--max-upload", settings.max_upload_bytes, 1, kMostBytes, "Bytes of an uploaded file");
        add("--max-positions", settings.max_positions, 1, kMostBytes, "Positions of a query");
        add("--max-triangles", settings.max_triangles, 1, kMostBytes, "Triangles of a scene");
        add("--quota", settings.quota_bytes, 0, kMostBytes,
            "Bytes of all stored files (0 = what the disk has)");
        add("--tool-memory", settings.tool_memory_bytes, 0, kMostBytes,
            "Bytes of memory of each program (0 = three quarters of the machine's)");
        add("--tool-seconds", settings.tool_seconds, kLeastSeconds, kMostSeconds,
            "Longest time of a program that a request waits for");
        add("--header-seconds", settings.header_seconds, kLeastSeconds, kMostSeconds,
            "Longest time for a request's head");
        add("--idle-seconds", settings.idle_seconds, kLeastSeconds, kMostSeconds,
            "Longest time between requests");
        add("--transfer-seconds", settings.transfer_seconds, kLeastSeconds, kMostSeconds,
            "Longest time for 64 KiB of a body");
        add("--drain-notice-seconds", settings.drain_notice_seconds, 0, kMostSeconds,
            "Time after SIGTERM in which /readyz says 503 and connections are still taken");
        add("--drain-seconds", settings.drain_seconds, 0, kMostSeconds,
            "Longest time after that for requests that were begun (0 = ends them at once)");
    }

    [[nodiscard]] Status read_token() {
        if (const char* token = std::getenv(kTokenVariable)) settings.token = token;
        // Programs that the server runs have no use for it.
        ::unsetenv(kTokenVariable);
        if (!token_file.empty()) {
            const auto bytes = read_file(token_file);
            if (!bytes) return bytes.error();
            settings.token.assign(reinterpret_cast<const char*>(bytes->data()), bytes->size());
            settings.token.erase(settings.token.find_last_not_of(" \t\r\n") + 1);
            if (settings.token.empty()) return Error{token_file + ": is empty"};
        }
        if (is_visible(settings.token)) return Ok{};
        return Error{
            (token_file.empty() ? std::string("$") + kTokenVariable : token_file) +
            ": a token is letters, digits and signs of ASCII, without spaces and line breaks"};
    }

    Status run() {
        parse_listen(listen, settings);
        if (auto status = read_token(); !status) return status;
        if (settings.viewer.empty()) {
            settings.viewer = server::find_viewer(server::program_of(settings));
        }
        // Programs run in folders of their own.
        settings.data = std::filesystem::absolute(settings.data).lexically_normal().string();
        if (settings.data.ends_with('/')) settings.data.pop_back();
        return server::serve(settings, [this](uint16_t port) {
            const bool is_ipv6 = settings.address.find(':') != std::string::npos;
            std::cout << "http://" << (is_ipv6 ? "[" + settings.address + "]" : settings.address)
                      << ":" << port << std::endl;
        });
    }
};

}  // namespace

void add_serve(CLI::App& app, Run& run) {
    add_command<Serve>(app, run, "serve", "Serve scenes, bakes and queries over HTTP",
                       "tetralight serve --data /var/lib/tetralight --listen 127.0.0.1:8080");
}

}  // namespace tetralight::cli
