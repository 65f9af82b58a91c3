// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <tetralight/server/keep.h>
#include <tetralight/server/log.h>

namespace tetralight::server {

struct Settings {
    /// The folder of all state; created if it does not exist.
    std::string data;
    std::string address = "127.0.0.1";
    uint16_t port = 8080;
    /// What clients send as `Authorization: Bearer` to do everything. Without any token no client
    /// needs one.
    std::string token;
    /// Files of such a token, and of one for requests that change nothing. They are read again
    /// when they change; empty: none.
    std::string token_file;
    std::string read_token_file;
    /// Names besides localhost by which a proxy may call a server without a token.
    std::vector<std::string> allowed_hosts;
    /// Answers queries from the folder of another server, and changes nothing.
    bool is_read_only = false;
    /// Pages of other origins that may call; "*" = all.
    std::vector<std::string> cors_origins;
    /// Folder of the static files at `/`; empty: none (`find_viewer`).
    std::string viewer;
    /// The `tetralight` program that runs jobs; empty: this one.
    std::string program;
    Log::Level log_level = Log::Level::Info;

    /// Threads that answer requests; 0 = one per processor.
    uint32_t thread_count = 0;
    /// Threads of each job; 0 = one per processor.
    uint32_t tool_thread_count = 0;
    /// Requests that wait for jobs of minutes at once, and those that store or check.
    uint32_t worker_count = 4;
    uint32_t storage_worker_count = 4;
    /// Requests that may wait for each kind of thread, and their longest wait.
    uint32_t max_waiting = 256;
    double queue_seconds = 60.0;
    enum class BakesOn : uint8_t { Local, Slurm };
    BakesOn bakes_on = BakesOn::Local;
    uint32_t bakes_at_once = 1;
    uint32_t max_connections = 4096;
    uint32_t max_queued_bakes = 1000;
    uint64_t max_body_bytes = uint64_t{64} << 20;
    uint64_t max_upload_bytes = uint64_t{1} << 30;
    uint64_t max_positions = 1'000'000;
    uint64_t max_triangles = 50'000'000;
    /// Size of all files together; 0 = as much as the disk has.
    uint64_t quota_bytes = 0;
    /// Which volumes without a name and which ended bakes are kept; no limit: all.
    Keep keep;
    /// Volumes of at most this size are copied into memory when they are opened; larger ones are
    /// mapped, and their files are read again after `recheck_seconds`.
    uint64_t copy_limit_bytes = uint64_t{64} << 20;
    double recheck_seconds = 60.0;
    /// Memory of each job; 0 = three quarters of the machine's.
    uint64_t tool_memory_bytes = 0;
    /// Address space of each job; 0 = four times the machine's memory, at least 64 GiB.
    uint64_t tool_address_space_bytes = 0;
    /// Processor time of a job that a request waits for; 0 = its time on all its threads.
    uint64_t tool_processor_seconds = 0;
    uint32_t max_header_bytes = 16384;
    double header_seconds = 10.0;
    double idle_seconds = 60.0;
    /// Time for 64 KiB of a body in either direction.
    double transfer_seconds = 30.0;
    /// Time of a job that a request waits for; after it the job is killed.
    double tool_seconds = 300.0;
    /// Time after SIGTERM in which connections are accepted and /readyz answers 503.
    double drain_notice_seconds = 0.0;
    /// Time after that for requests in progress.
    double drain_seconds = 30.0;
};

}  // namespace tetralight::server
