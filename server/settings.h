// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <tetralight/server/log.h>

namespace tetralight::server {

struct Settings {
    /// Holds all state; made when it is not there.
    std::string data;
    std::string address = "127.0.0.1";
    uint16_t port = 8080;
    /// What clients send as `Authorization: Bearer`. Empty: everyone may, who reaches the address.
    std::string token;
    /// Names beside localhost by which a proxy may call a server without a token.
    std::vector<std::string> allowed_hosts;
    /// Serves what another server's folder holds, and changes nothing.
    bool is_read_only = false;
    /// Pages of other origins that may call; "*" = all.
    std::vector<std::string> cors_origins;
    /// Static files at `/`; empty: none (`find_viewer`).
    std::string viewer;
    /// The `tetralight` program that bakes and writes files; empty: this one.
    std::string program;
    Log::Level log_level = Log::Level::Info;

    /// Answer requests; 0 = all.
    uint32_t thread_count = 0;
    /// Of bakes and other programs that work for requests; 0 = all.
    uint32_t tool_thread_count = 0;
    /// Requests that wait for programs or disks at once, and those that may wait for them.
    uint32_t worker_count = 4;
    uint32_t max_waiting = 256;
    uint32_t max_connections = 4096;
    uint32_t max_queued_bakes = 1000;
    uint64_t max_body_bytes = uint64_t{64} << 20;
    uint64_t max_upload_bytes = uint64_t{1} << 30;
    uint64_t max_positions = 1'000'000;
    uint64_t max_triangles = 50'000'000;
    /// Of all files together; 0 = what the disk has.
    uint64_t quota_bytes = 0;
    /// Of each program; 0 = three quarters of the machine's.
    uint64_t tool_memory_bytes = 0;
    uint32_t max_header_bytes = 16384;
    double header_seconds = 10.0;
    double idle_seconds = 60.0;
    /// In which 64 KiB of a body must come or go.
    double transfer_seconds = 30.0;
    /// After this a program that works for a waiting request is ended.
    double tool_seconds = 300.0;
    /// When the server is to end, it takes connections for so long, and says that it is not ready.
    double drain_notice_seconds = 0.0;
    /// Requests that are being answered have this long after that.
    double drain_seconds = 30.0;
};

}  // namespace tetralight::server
