#pragma once

#include <cstddef>
#include <functional>
#include <memory>

/// All parallelism goes through here (TBB, or std::thread workers so that ThreadSanitizer sees every
/// synchronisation).
namespace fluxwalk::base {

/// A fixed number of threads that run ranges. Results must not depend on which thread runs what: write to
/// disjoint outputs.
class Executor {
  public:
    /// `threads` 0 means all hardware threads; at most 1,024 are made.
    explicit Executor(unsigned threads = 0);
    ~Executor();
    Executor(const Executor&) = delete;
    Executor& operator=(const Executor&) = delete;

    unsigned threadCount() const { return threads_; }

    /// Calls body(begin, end) on sub-ranges that cover [0, count), each `grain` long except the last. Blocks
    /// until all are done. The first exception thrown by a body is rethrown here.
    void forRange(std::size_t count, std::size_t grain,
                  const std::function<void(std::size_t, std::size_t)>& body) const;

    /// Runs `work` where nested parallelism of libraries (Embree builds) is held to the same number of
    /// threads (std::thread backend: to the calling thread).
    void within(const std::function<void()>& work) const;

  private:
    struct Impl;
    unsigned threads_;
    std::unique_ptr<Impl> impl_;
};

}  // namespace fluxwalk::base
