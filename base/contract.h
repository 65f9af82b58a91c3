// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace tetralight::detail {

/// Prints the broken contract on stderr and aborts. Called by TETRALIGHT_ASSERT only.
[[noreturn]] void assertion_failed(const char* condition, const char* why, const char* file,
                                   int line) noexcept;

}  // namespace tetralight::detail

/// Checks a precondition of a function: an error of the caller, never bad data. NDEBUG removes it.
#ifdef NDEBUG
#define TETRALIGHT_ASSERT(condition, why) static_cast<void>(0)
#else
#define TETRALIGHT_ASSERT(condition, why) \
    ((condition) ? static_cast<void>(0)   \
                 : ::tetralight::detail::assertion_failed(#condition, why, __FILE__, __LINE__))
#endif
