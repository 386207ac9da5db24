#pragma once

#include <atomic>
#include <memory>

namespace fluxwalk::image {

/// What `place` points to; where nothing does, what `make` returns as a std::unique_ptr. For any number of
/// threads that would make the same: the first one's is kept.
template <class T, class Make>
T& findOrMake(std::atomic<T*>& place, const Make& make) {
    if (T* known = place.load(std::memory_order_acquire)) {
        return *known;
    }
    std::unique_ptr<T> made = make();
    T* before = nullptr;
    return place.compare_exchange_strong(before, made.get(), std::memory_order_acq_rel) ? *made.release()
                                                                                        : *before;
}

}  // namespace fluxwalk::image
