#include "core/base/parallel.h"

#include <algorithm>
#include <thread>

#ifdef FLUXWALK_PARALLEL_THREADS
#include <atomic>
#include <exception>
#include <mutex>
#include <vector>
#else
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#endif

#include <tbb/global_control.h>

namespace fluxwalk::base {

namespace {

constexpr unsigned kMaxThreads = 1024;

unsigned resolveThreads(unsigned threads) {
    return std::min(kMaxThreads, threads != 0 ? threads : std::max(1u, std::thread::hardware_concurrency()));
}

}  // namespace

#ifdef FLUXWALK_PARALLEL_THREADS

struct Executor::Impl {};

Executor::Executor(unsigned threads) : threads_(resolveThreads(threads)) {}
Executor::~Executor() = default;

void Executor::forRange(std::size_t count, std::size_t grain,
                        const std::function<void(std::size_t, std::size_t)>& body) const {
    if (count == 0) {
        return;
    }
    const std::size_t step = std::max<std::size_t>(1, grain);
    const std::size_t chunks = (count + step - 1) / step;
    std::atomic<std::size_t> next{0};
    std::exception_ptr failure;
    std::mutex failureMutex;
    const auto work = [&] {
        for (std::size_t c = next.fetch_add(1); c < chunks; c = next.fetch_add(1)) {
            try {
                body(c * step, std::min(count, (c + 1) * step));
            } catch (...) {
                const std::lock_guard lock(failureMutex);
                if (!failure) {
                    failure = std::current_exception();
                }
                next = chunks;
            }
        }
    };
    const std::size_t helpers = std::min<std::size_t>(threads_, chunks) - 1;
    std::vector<std::thread> workers;
    workers.reserve(helpers);
    for (std::size_t i = 0; i < helpers; ++i) {
        workers.emplace_back(work);
    }
    work();
    for (std::thread& worker : workers) {
        worker.join();
    }
    if (failure) {
        std::rethrow_exception(failure);
    }
}

void Executor::within(const std::function<void()>& work) const {
    // ThreadSanitizer cannot see how TBB hands work over: what TBB's threads did to our memory would look
    // like a race.
    const tbb::global_control alone(tbb::global_control::max_allowed_parallelism, 1);
    work();
}

#else

struct Executor::Impl {
    explicit Impl(unsigned threads) : arena(static_cast<int>(threads)) {}
    // TBB fixes the number of its workers when its first arena is made; a later, larger arena would get no
    // more.
    tbb::global_control ceiling{tbb::global_control::max_allowed_parallelism, kMaxThreads};
    tbb::task_arena arena;
};

Executor::Executor(unsigned threads)
    : threads_(resolveThreads(threads)), impl_(std::make_unique<Impl>(threads_)) {}
Executor::~Executor() = default;

void Executor::forRange(std::size_t count, std::size_t grain,
                        const std::function<void(std::size_t, std::size_t)>& body) const {
    if (count == 0) {
        return;
    }
    const std::size_t step = std::max<std::size_t>(1, grain);
    const std::size_t chunks = (count + step - 1) / step;
    if (chunks == 1) {
        body(0, count);
        return;
    }
    impl_->arena.execute([&] {
        tbb::parallel_for(
            std::size_t{0}, chunks, [&](std::size_t c) { body(c * step, std::min(count, (c + 1) * step)); },
            tbb::simple_partitioner());
    });
}

void Executor::within(const std::function<void()>& work) const {
    impl_->arena.execute(work);
}

#endif

}  // namespace fluxwalk::base
