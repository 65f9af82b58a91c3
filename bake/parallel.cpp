// SPDX-License-Identifier: Apache-2.0
#include <tetralight/bake/parallel.h>

#include <tbb/blocked_range.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <thread>
#include <vector>

#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace tetralight {
namespace {

/// Sets the flush-to-zero modes of the processor for its lifetime.
class FlushDenormals {
  public:
#if defined(__SSE2__)
    FlushDenormals() : saved_(_mm_getcsr()) {
        _mm_setcsr(saved_ | kFlushToZero | kDenormalsAreZero);
    }

    ~FlushDenormals() {
        _mm_setcsr(saved_);
    }

    FlushDenormals(const FlushDenormals&) = delete;
    FlushDenormals& operator=(const FlushDenormals&) = delete;

  private:
    static constexpr unsigned kFlushToZero = 0x8000;
    static constexpr unsigned kDenormalsAreZero = 0x0040;
    unsigned saved_;
#endif
};

#if defined(__SANITIZE_THREAD__)

/// ThreadSanitizer does not see the synchronization in TBB, which is not instrumented. Under it,
/// plain threads do the same work.
void run_on_threads(uint32_t threads, const std::function<void()>& run) {
    std::vector<std::jthread> pool;
    for (uint32_t t = 0; t < threads; ++t) pool.emplace_back(run);
}

#else

void run_on_threads(uint32_t threads, const std::function<void()>& run) {
    tbb::task_arena arena(static_cast<int>(threads));
    arena.execute([&] {
        tbb::parallel_for(
            tbb::blocked_range<uint32_t>(0, threads),
            [&](const tbb::blocked_range<uint32_t>&) { run(); }, tbb::simple_partitioner());
    });
}

#endif

}  // namespace

void parallel_for(size_t count, uint32_t thread_count, const std::function<void(size_t)>& work) {
    // TBB prints a warning if asked for more threads than the machine has.
    const auto available = static_cast<uint32_t>(tbb::info::default_concurrency());
    const uint32_t threads = thread_count == 0 ? available : std::min(thread_count, available);
    // A shared counter instead of ranges: at the end of a range per thread, the other threads would
    // wait for the last one. An atomic increment costs far less than a call here.
    std::atomic<size_t> next = 0;
    run_on_threads(threads, [&] {
        const FlushDenormals flush;
        for (size_t i = next++; i < count; i = next++) work(i);
    });
}

}  // namespace tetralight
