// SPDX-License-Identifier: Apache-2.0
#include <tetralight/settings/setting.h>

namespace tetralight::settings {
namespace {

constexpr double kMostThreads = 1024;
constexpr double kMostCount = 1e6;
constexpr double kMostBytes = 1e15;

constexpr Setting kAddress[] = {
    {.name = "data",
     .type = Type::Path,
     .help = "Folder of all state; it is created if it does not exist",
     .value_name = "FOLDER",
     .is_required = true,
     .access = Access::Command},
    {.name = "listen",
     .type = Type::Text,
     .help = "Address and port; an address other than this machine's own needs a token",
     .default_text = "127.0.0.1:8080",
     .value_name = "ADDRESS:PORT",
     .access = Access::Command},
    {.name = "token_file",
     .type = Type::Path,
     .help = "File with the bearer token that clients send; it is read again when it changes",
     .without = "$TETRALIGHT_TOKEN, or no token",
     .access = Access::Command},
    {.name = "read_token_file",
     .type = Type::Path,
     .help = "File with a bearer token that may only read; it is read again when it changes",
     .without = "no such token",
     .access = Access::Command},
    {.name = "read_only",
     .type = Type::Flag,
     .help = "Answer queries from a folder that another server writes to",
     .access = Access::Command},
    {.name = "bakes_on",
     .type = Type::Choice,
     .help = "Where bakes run: local = on this machine; slurm = on machines of a Slurm cluster, "
             "which see the data folder and this program at the same paths",
     .choices = "local slurm",
     .default_text = "local",
     .access = Access::Command},
    {.name = "cors_origin",
     .type = Type::Text,
     .help = "Origin whose pages may call; * = all",
     .without = "pages of this server only",
     .value_name = "ORIGIN",
     .is_list = true,
     .access = Access::Command},
    {.name = "allowed_host",
     .type = Type::Text,
     .help = "Name by which a proxy may call a server without a token",
     .without = "localhost only",
     .value_name = "HOST",
     .is_list = true,
     .access = Access::Command},
    {.name = "viewer",
     .type = Type::Path,
     .help = "Folder of the web page to serve at /",
     .without = "the viewer that was built or installed with this program",
     .value_name = "FOLDER",
     .access = Access::Command},
    {.name = "log",
     .type = Type::Choice,
     .help = "Least severe messages to write to stderr, as lines of JSON",
     .choices = "debug info warning error nothing",
     .default_text = "info",
     .access = Access::Command}};

constexpr Setting limit(std::string_view name, std::string_view unit, std::string_view help,
                        double min, double max, std::string_view default_text) {
    return {.name = name,
            .type = Type::Integer,
            .help = help,
            .unit = unit,
            .range = {min, max},
            .default_text = default_text,
            .access = Access::Command};
}

constexpr Setting seconds(std::string_view name, std::string_view help, double min,
                          std::string_view default_text) {
    return {.name = name,
            .type = Type::Number,
            .help = help,
            .unit = "seconds",
            .range = {min, 86400},
            .default_text = default_text,
            .access = Access::Command};
}

constexpr Setting kLimits[] = {
    limit("threads", "threads", "Threads that answer requests; 0 = one per processor", 0,
          kMostThreads, "0"),
    limit("tool_threads", "threads",
          "Threads of each bake and of each other program that works for requests; 0 = one per "
          "processor",
          0, kMostThreads, "0"),
    limit("workers", "programs",
          "Programs that draw, relight and place for requests at once, in addition to the bake", 1,
          kMostThreads, "4"),
    limit("storage_workers", "requests",
          "Uploads, deletions and orders that are checked and stored at once", 1, kMostThreads,
          "4"),
    limit("max_waiting", "requests",
          "Requests that may wait for these programs, for storage or for processors, each", 1,
          kMostCount, "256"),
    limit("bakes_at_once", "bakes",
          "Bakes that run at once; here each has all processors, and --tool-memory", 1,
          kMostThreads, "1"),
    limit("max_bakes", "bakes", "Bakes that may wait", 1, kMostCount, "1000"),
    limit("max_connections", "connections", "Open connections", 1, kMostCount, "4096"),
    limit("max_body", "bytes", "Largest body of a request", 1, kMostBytes, "67108864"),
    limit("max_upload", "bytes", "Largest uploaded file", 1, kMostBytes, "1073741824"),
    limit("max_positions", "positions", "Most positions of a query", 1, kMostBytes, "1000000"),
    limit("max_triangles", "triangles", "Most triangles of a scene", 1, kMostBytes, "50000000"),
    limit("quota", "bytes", "Size of all stored files; 0 = as much as the disk has", 0, kMostBytes,
          "0"),
    {.name = "keep",
     .type = Type::Text,
     .help =
         "Keep this many volumes, lightmaps and reflection probes without a name, each, and this "
         "many ended bakes, or those younger than an age: 100, 30d, 12h, 90m, 45s; the server "
         "deletes the others",
     .without = "all are kept",
     .value_name = "COUNT|AGE",
     .access = Access::Command},
    limit("copy_limit", "bytes",
          "Volumes up to this size are copied into memory when they are opened; larger ones are "
          "mapped, and their files are read again from time to time",
          0, kMostBytes, "67108864"),
    seconds("recheck_seconds", "Time after which the file of a mapped volume is read again", 0.01,
            "60"),
    limit("tool_memory", "bytes", "Memory of each program; 0 = three quarters of the machine's", 0,
          kMostBytes, "0"),
    limit(
        "tool_address_space", "bytes",
        "Address space of each program, with the files that it maps; 0 = four times the machine's "
        "memory, at least 64 GiB",
        0, kMostBytes, "0"),
    limit("tool_processor_seconds", "seconds",
          "Processor time of a program that a request waits for; 0 = --tool-seconds on each thread",
          0, 1e9, "0"),
    seconds("queue_seconds", "Longest time that a request waits for a thread", 0.01, "60"),
    seconds("tool_seconds", "Longest time of a program that a request waits for", 0.01, "300"),
    seconds("header_seconds", "Longest time to receive the head of a request", 0.01, "10"),
    seconds("idle_seconds", "Longest time between requests of a connection", 0.01, "60"),
    seconds("transfer_seconds", "Longest time for 64 KiB of a body", 0.01, "30"),
    seconds("drain_notice_seconds",
            "Time after SIGTERM in which /readyz returns 503 and connections are still accepted", 0,
            "0"),
    seconds("drain_seconds",
            "Longest time after that for requests in progress; 0 = ends them at once", 0, "30")};

constexpr Group kGroups[] = {{"Service", kAddress}, {"Limits", kLimits}};

}  // namespace

const Table kServe{
    .command = "serve",
    .summary = "Serve scenes, bakes and queries over HTTP",
    .examples = "tetralight serve --data /var/lib/tetralight --listen 127.0.0.1:8080",
    .groups = kGroups};

}  // namespace tetralight::settings
