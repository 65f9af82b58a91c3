// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tetralight/base/detail/portable_int128.h>

// What compilers offer beyond standard C++, with a standard substitute for those that lack it. No
// other file of the ship set uses built-in functions, attributes or types of a compiler, and a test
// holds that; the C header's export attribute is the exception.

namespace tetralight {

/// Integers of 128 bits. Without such a type, two halves of 64 bits do the work.
#ifdef __SIZEOF_INT128__
__extension__ using Int128 = __int128;
__extension__ using Uint128 = unsigned __int128;
#else
using Int128 = detail::PortableInt128;
using Uint128 = detail::PortableUint128;
#endif

/// Asks the processor to bring the cache line of an address near, to read it soon. Every address is
/// allowed.
inline void prefetch(const void* address) noexcept {
#ifdef __GNUC__
    __builtin_prefetch(address);
#else
    static_cast<void>(address);
#endif
}

/// The same, to write there soon.
inline void prefetch_for_writing(const void* address) noexcept {
#ifdef __GNUC__
    __builtin_prefetch(address, 1);
#else
    static_cast<void>(address);
#endif
}

/// Makes the compiler read what `stored` points to from memory again. Without it, compilers take
/// stored vectors apart lane by lane, which is slower.
inline void read_from_memory(const void* stored) noexcept {
#ifdef __GNUC__
    asm volatile("" : : "r"(stored) : "memory");
#else
    static_cast<void>(stored);
#endif
}

}  // namespace tetralight
