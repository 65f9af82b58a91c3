// SPDX-License-Identifier: Apache-2.0
#include <tetralight/server/map_guard.h>

#include <sys/mman.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <mutex>

namespace tetralight::server {
namespace {

/// Guarded addresses. The handler reads them, so that they are neither locked nor allocated.
struct Slot {
    std::atomic<bool> is_used;
    std::atomic<bool> is_damaged;
    std::atomic<uintptr_t> begin;
    std::atomic<uintptr_t> end;
};

constexpr size_t kMostGuards = 8192;  // more than OpenVolumes keeps

constinit std::array<Slot, kMostGuards> slots{};
constinit thread_local volatile sig_atomic_t thread_guards = 0;
constinit thread_local volatile sig_atomic_t thread_is_damaged = 0;
struct sigaction default_action = {};

/// Marks what an address belongs to. Returns false if it is not guarded.
bool mark(uintptr_t address) {
    for (Slot& slot : slots) {
        if (!slot.is_used || address < slot.begin || address >= slot.end) continue;
        slot.is_damaged = true;
        return true;
    }
    if (thread_guards == 0) return false;
    thread_is_damaged = 1;
    return true;
}

/// Only system calls and atomic variables are allowed here.
void handle_bus_error(int, siginfo_t* info, void*) {
    const int saved = errno;
    const auto page_size = static_cast<uintptr_t>(::sysconf(_SC_PAGESIZE));
    const auto address = reinterpret_cast<uintptr_t>(info->si_addr);
    void* page = reinterpret_cast<void*>(address / page_size * page_size);
    const bool is_read =
        mark(address) && ::mmap(page, page_size, PROT_READ, MAP_PRIVATE | MAP_ANONYMOUS | MAP_FIXED,
                                -1, 0) != MAP_FAILED;
    // The thread reads again. Without a page it ends the process then, as without this handler.
    if (!is_read) ::sigaction(SIGBUS, &default_action, nullptr);
    errno = saved;
}

void install() {
    static std::once_flag once;
    std::call_once(once, [] {
        struct sigaction action = {};
        action.sa_sigaction = handle_bus_error;
        action.sa_flags = SA_SIGINFO;
        ::sigemptyset(&action.sa_mask);
        ::sigaction(SIGBUS, &action, &default_action);
    });
}

}  // namespace

Result<MapGuard> MapGuard::make(std::span<const std::byte> bytes) {
    install();
    for (size_t i = 0; i < slots.size(); ++i) {
        Slot& slot = slots[i];
        bool is_used = false;
        if (!slot.is_used.compare_exchange_strong(is_used, true)) continue;
        slot.is_damaged = false;
        slot.begin = reinterpret_cast<uintptr_t>(bytes.data());
        slot.end = slot.begin + bytes.size();
        return MapGuard(i);
    }
    return Error{ErrorCode::OutOfResources, "too many volumes are open"};
}

MapGuard::~MapGuard() {
    if (slot_ == kNone) return;
    slots[slot_].end = 0;
    slots[slot_].begin = 0;
    slots[slot_].is_used = false;
}

bool MapGuard::is_damaged() const {
    return slots[slot_].is_damaged;
}

ThreadGuard::ThreadGuard() {
    install();
    if (thread_guards == 0) thread_is_damaged = 0;
    thread_guards = thread_guards + 1;
}

ThreadGuard::~ThreadGuard() {
    thread_guards = thread_guards - 1;
}

bool ThreadGuard::is_damaged() const {
    return thread_is_damaged != 0;
}

}  // namespace tetralight::server
