// SPDX-License-Identifier: Apache-2.0
#include <tetralight/cli/interrupt.h>

#include <csignal>
#include <initializer_list>

namespace tetralight::cli {
namespace {

volatile std::sig_atomic_t g_signal = 0;  // a signal handler can reach nothing else

extern "C" void on_interrupt(int signal) {
    g_signal = signal;
    std::signal(signal, SIG_DFL);  // a second one ends the program at once
}

}  // namespace

Interrupt::Interrupt() {
    for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, on_interrupt);
}

Interrupt::~Interrupt() {
    for (const int signal : {SIGINT, SIGTERM}) std::signal(signal, SIG_DFL);
}

int Interrupt::signal() {
    return g_signal;
}

}  // namespace tetralight::cli
