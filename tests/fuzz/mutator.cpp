// SPDX-License-Identifier: Apache-2.0
#include "tests/fuzz/mutator.h"

#include <algorithm>
#include <cstring>
#include <limits>

namespace tetralight::fuzz {
namespace {

constexpr float kFloats[] = {0.0f,
                             -0.0f,
                             1.0f,
                             -1.0f,
                             2.0f,
                             0.5f,
                             1e-30f,
                             1e30f,
                             3e38f,
                             std::numeric_limits<float>::infinity(),
                             -std::numeric_limits<float>::infinity(),
                             std::numeric_limits<float>::quiet_NaN(),
                             std::numeric_limits<float>::denorm_min()};

constexpr double kDoubles[] = {0.0,
                               -1.0,
                               2.0,
                               1e-300,
                               1e306,
                               -1e306,
                               1e18,
                               1e-18,
                               1e38,
                               std::numeric_limits<double>::infinity(),
                               std::numeric_limits<double>::quiet_NaN()};

constexpr uint32_t kIntegers[] = {0,           1,           2,           3,          4,
                                  0x7fffffffu, 0x80000000u, 0xffffffffu, 0xfffffffeu};

constexpr const char* kTokens[] = {"0",
                                   "-1",
                                   "1e308",
                                   "1e400",
                                   "null",
                                   "true",
                                   "{}",
                                   "[]",
                                   "\"\"",
                                   "\"\\u0000\"",
                                   "\"\xff\"",
                                   "[[[[",
                                   "18446744073709551616",
                                   ",",
                                   ":",
                                   "\"a\":1,",
                                   " ",
                                   "\"\\ud800\""};

}  // namespace

size_t Mutator::below(size_t count) {
    return std::uniform_int_distribution<size_t>(0, count - 1)(engine_);
}

void Mutator::write_number(std::span<std::byte> bytes) {
    const auto write = [&](const auto& value) {
        if (bytes.size() < sizeof value) return;
        const size_t place = below(bytes.size() / sizeof value) * sizeof value;
        std::memcpy(bytes.data() + place, &value, sizeof value);
    };
    switch (below(3)) {
        case 0:
            return write(kFloats[below(std::size(kFloats))]);
        case 1:
            return write(kDoubles[below(std::size(kDoubles))]);
        default:
            return write(kIntegers[below(std::size(kIntegers))]);
    }
}

void Mutator::change_bytes(std::span<std::byte> bytes) {
    if (bytes.empty()) return;
    switch (below(4)) {
        case 0: {
            bytes[below(bytes.size())] ^= std::byte{1} << below(8);
            return;
        }
        case 1: {
            const size_t size = std::min(bytes.size(), size_t{4} << below(4));
            const size_t from = below(bytes.size() - size + 1) / 4 * 4;
            const size_t to = below(bytes.size() - size + 1) / 4 * 4;
            std::memmove(bytes.data() + to, bytes.data() + from, size);
            return;
        }
        default:
            write_number(bytes);
    }
}

void Mutator::change_file(std::string& file) {
    if (file.empty()) return;
    const size_t place = below(file.size());
    const size_t size = std::min(below(16) + 1, file.size() - place);
    switch (below(8)) {
        case 0:
            file[place] = static_cast<char>(below(256));
            return;
        case 1:
            file.erase(place, size);
            return;
        case 2:
            file.insert(below(file.size() + 1), file.substr(place, size));
            return;
        case 3:
            file.resize(place);
            return;
        case 4:
            return change_text(file);
        default:
            change_bytes(std::as_writable_bytes(std::span(file).subspan(below(file.size()))));
    }
}

void Mutator::change_text(std::string& text) {
    const size_t place = below(text.size() + 1);
    const size_t size = std::min(below(12) + 1, text.size() - place);
    switch (below(5)) {
        case 0:
            text.insert(place, kTokens[below(std::size(kTokens))]);
            return;
        case 1:
            text.replace(place, size, kTokens[below(std::size(kTokens))]);
            return;
        case 2:
            text.erase(place, size);
            return;
        case 3:
            text.insert(below(text.size() + 1), text.substr(place, size));
            return;
        default:
            if (place < text.size()) text[place] = static_cast<char>(text[place] ^ (1 << below(8)));
    }
}

}  // namespace tetralight::fuzz
