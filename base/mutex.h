// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mutex>

namespace tetralight {

// The first macro is that of libc++ up to version 19; later versions define the second one as 0
// or 1.
#if defined(_LIBCPP_HAS_NO_THREADS) || (defined(_LIBCPP_HAS_THREADS) && !_LIBCPP_HAS_THREADS)

/// libc++ without threads, as for WebAssembly, has no mutex: nothing runs at the same time.
class Mutex {
  public:
    void lock() noexcept {}

    void unlock() noexcept {}
};

#else

using Mutex = std::mutex;

#endif

/// Locks a mutex for as long as it lives.
class MutexLock {
  public:
    explicit MutexLock(Mutex& mutex) : mutex_(mutex) { mutex_.lock(); }

    MutexLock(const MutexLock&) = delete;
    MutexLock& operator=(const MutexLock&) = delete;

    ~MutexLock() { mutex_.unlock(); }

  private:
    Mutex& mutex_;
};

}  // namespace tetralight
