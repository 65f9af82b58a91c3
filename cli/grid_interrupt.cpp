// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/grid_interrupt.h>

#include <unistd.h>

#include <csignal>

#include <tetralight/cli/common.h>
#include <tetralight/cli/failure.h>

namespace tetralight::cli {
namespace {

// A signal handler can reach nothing else.
std::string g_line;
std::string g_json;

extern "C" void say_and_exit(int signal) {
    constexpr int kExitSignal = 128;
    [[maybe_unused]] auto written = ::write(STDOUT_FILENO, g_json.data(), g_json.size());
    written = ::write(STDERR_FILENO, g_line.data(), g_line.size());
    ::_exit(kExitSignal + signal);
}

}  // namespace

GridInterrupt::GridInterrupt(const std::string& line, bool is_json) {
    const Json error = error_json({ErrorCode::Cancelled, line});
    g_json = is_json ? dump(Json{{"error", error}}) + "\n" : "";
    g_line = "tetralight: " + printable(line) + "\n";
    for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, say_and_exit);
}

GridInterrupt::~GridInterrupt() {
    for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, SIG_DFL);
}

}  // namespace tetralight::cli
