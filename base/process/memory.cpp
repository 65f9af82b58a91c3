// SPDX-License-Identifier: Apache-2.0
#include <tetralight/base/process/memory.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>

#include <tetralight/base/str_cat.h>

namespace tetralight {
namespace {

constexpr uint64_t kUnknown = std::numeric_limits<uint64_t>::max();

/// The number behind a word at the start of a line; without a word the first of the file.
uint64_t number_in(const char* path, const std::string& word) {
    std::ifstream file(path);
    std::string first;
    uint64_t number = 0;
    if (word.empty()) return file >> number ? number : kUnknown;
    while (file >> first) {
        if (first == word) return file >> number ? number : kUnknown;
        file.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
    }
    return kUnknown;
}

/// Bytes of a line that gives kilobytes; kUnknown if there is none.
uint64_t kilobytes_in(const char* path, const std::string& word) {
    const uint64_t kilobytes = number_in(path, word);
    return kilobytes > kUnknown / 1024 ? kUnknown : kilobytes * 1024;
}

/// Free memory within the limit of the control group of a container.
uint64_t free_in_group() {
    const uint64_t limit = number_in("/sys/fs/cgroup/memory.max", "");  // "max" is no number
    const uint64_t used = number_in("/sys/fs/cgroup/memory.current", "");
    if (limit == kUnknown || used == kUnknown) return kUnknown;
    return limit - std::min(limit, used);
}

}  // namespace

uint64_t add_bytes(uint64_t sum, uint64_t count, uint64_t size) {
    constexpr uint64_t kMost = std::numeric_limits<uint64_t>::max();
    const bool fits = size == 0 || count <= (kMost - sum) / size;
    return fits ? sum + count * size : kMost;
}

std::string gigabytes(double bytes) {
    return str_cat(std::round(bytes / 1e8) / 10.0, " GB");
}

std::string gigabytes(uint64_t bytes) {
    return gigabytes(static_cast<double>(bytes));
}

uint64_t free_memory() {
    return std::min(kilobytes_in("/proc/meminfo", "MemAvailable:"), free_in_group());
}

}  // namespace tetralight
