// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/commands.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <filesystem>
#include <iostream>

#include <tetralight/base/str_cat.h>
#include <tetralight/cli/common.h>
#include <tetralight/cli/paths.h>
#include <tetralight/server/find_viewer.h>
#include <tetralight/server/job.h>
#include <tetralight/server/serve.h>
#include <tetralight/server/tokens.h>

namespace tetralight::cli {
namespace {

constexpr const char* kTokenVariable = "TETRALIGHT_TOKEN";

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

/// "light.example.com": the `Host` header without its port.
bool is_host(std::string_view text) {
    return !text.empty() && is_visible(text) &&
           text.find_first_of(":/?#@,*") == std::string_view::npos;
}

struct Serve {
    server::Settings settings;

    explicit Serve(const Values& values) {
        settings.token_file = values.text("token_file");
        settings.read_token_file = values.text("read_token_file");
        settings.data = values.text("data");
        settings.is_read_only = values.flag("read_only");
        settings.cors_origins = values.texts("cors_origin");
        settings.allowed_hosts = values.texts("allowed_host");
        settings.viewer = values.text("viewer");
        settings.bakes_on = choice<server::Settings::BakesOn>(values, "bakes_on");
        settings.log_level = choice<server::Log::Level>(values, "log");
        take_limits(values);
        check(values);
    }

    void take_limits(const Values& values) {
        settings.thread_count = values.integer32("threads");
        settings.tool_thread_count = values.integer32("tool_threads");
        settings.worker_count = values.integer32("workers");
        settings.storage_worker_count = values.integer32("storage_workers");
        settings.max_waiting = values.integer32("max_waiting");
        settings.queue_seconds = values.number("queue_seconds");
        settings.bakes_at_once = values.integer32("bakes_at_once");
        settings.max_queued_bakes = values.integer32("max_bakes");
        settings.max_connections = values.integer32("max_connections");
        settings.max_body_bytes = values.integer("max_body");
        settings.max_upload_bytes = values.integer("max_upload");
        settings.max_positions = values.integer("max_positions");
        settings.max_triangles = values.integer("max_triangles");
        settings.quota_bytes = values.integer("quota");
        settings.copy_limit_bytes = values.integer("copy_limit");
        settings.recheck_seconds = values.number("recheck_seconds");
        settings.tool_memory_bytes = values.integer("tool_memory");
        settings.tool_address_space_bytes = values.integer("tool_address_space");
        settings.tool_processor_seconds = values.integer("tool_processor_seconds");
        settings.tool_seconds = values.number("tool_seconds");
        settings.header_seconds = values.number("header_seconds");
        settings.idle_seconds = values.number("idle_seconds");
        settings.transfer_seconds = values.number("transfer_seconds");
        settings.drain_notice_seconds = values.number("drain_notice_seconds");
        settings.drain_seconds = values.number("drain_seconds");
    }

    /// Throws a `UsageError` if an address, a name or a folder is of another form.
    void check(const Values& values) {
        const auto wrong = [&](const char* name, const std::string& text, const char* form) {
            refuse(values, name, "\"" + text + "\" is not " + form);
        };
        const std::string listen = values.text("listen");
        if (!parse_listen(listen, settings)) wrong("listen", listen, "ADDRESS:PORT");
        if (const std::string keep = values.text("keep"); !keep.empty()) {
            const auto parsed = server::parse_keep(keep);
            if (!parsed) wrong("keep", keep, "a number such as 100 or an age such as 30d");
            settings.keep = parsed.value_or(server::Keep());
        }
        for (const std::string& origin : settings.cors_origins) {
            if (!is_origin(origin)) {
                wrong("cors_origin", origin, "an origin such as https://example.com");
            }
        }
        for (const std::string& host : settings.allowed_hosts) {
            if (!is_host(host)) {
                wrong("allowed_host", host, "a name without a port, such as light.example.com");
            }
        }
        if (!settings.viewer.empty() && !server::has_page(settings.viewer)) {
            wrong("viewer", settings.viewer, "a folder with an index.html");
        }
    }

    /// The variable counts where no file is named. Programs that the server runs have no use for
    /// it.
    [[nodiscard]] Status read_token_variable() {
        const char* variable = std::getenv(kTokenVariable);
        const std::string text = variable == nullptr ? "" : variable;
        ::unsetenv(kTokenVariable);
        if (text.empty() || !settings.token_file.empty()) return Ok{};
        auto token = server::parse_token(text, "token_file", std::string("$") + kTokenVariable);
        if (!token) return token.error();
        settings.token = std::move(*token);
        return Ok{};
    }

    Status run() {
        if (auto status = read_token_variable(); !status) return status;
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

Status run_serve(const Values& values) {
    return Serve(values).run();
}

}  // namespace tetralight::cli
