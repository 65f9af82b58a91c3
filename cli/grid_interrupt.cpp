// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/grid_interrupt.h>

#include <unistd.h>

#include <csignal>

#include <tetralight/cli/common.h>

namespace tetralight::cli {
namespace {

std::string g_line;  // a signal handler can reach nothing else

extern "C" void say_and_exit(int signal) {
    constexpr int kExitSignal = 128;
    [[maybe_unused]] const auto written = ::write(STDERR_FILENO, g_line.data(), g_line.size());
    ::_exit(kExitSignal + signal);
}

}  // namespace

GridInterrupt::GridInterrupt(const std::string& line) {
    g_line = "tetralight: " + printable(line) + "\n";
    for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, say_and_exit);
}

GridInterrupt::~GridInterrupt() {
    for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, SIG_DFL);
}

}  // namespace tetralight::cli
