// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdlib>

namespace tetralight {

/// Where tetrahedra get their memory: that of an engine, or of the system.
struct MemorySource {
    /// As std::realloc: resizes memory that it gave before (nullptr: none) to a number of bytes, of
    /// any alignment that malloc gives; frees it for 0 bytes. Returns nullptr, and leaves the
    /// memory as it is, if there is not enough.
    using Resize = void* (*)(void* context, void* memory, size_t byte_count);

    Resize resize = [](void*, void* memory, size_t byte_count) -> void* {
        if (byte_count > 0) return std::realloc(memory, byte_count);
        std::free(memory);
        return nullptr;
    };
    void* context = nullptr;
};

}  // namespace tetralight
