#pragma once

#include <bit>
#include <cstdint>
#include <vector>

namespace fluxwalk::display {

inline constexpr std::uint32_t kNone = 0xffffffffu;

/// Name of a vertex of an object's mesh in whole numbers, so that no position is compared. Vertices inside a
/// patch are named by the patch, those on its border by the edge or corner that they share with neighbours.
struct PointKey {
    std::uint64_t place = 0;
    std::uint32_t where = 0;

    bool operator==(const PointKey&) const = default;
};

/// Numbers keys in the order in which they come. Open addressing, at most half full.
class PointTable {
  public:
    explicit PointTable(std::size_t expected) : slots_(std::bit_ceil(2 * expected + 16)) {}

    std::uint32_t size() const { return size_; }

    /// Number of `key`, or kNone.
    std::uint32_t find(const PointKey& key) const { return slots_[slotOf(key)].number; }

    /// Number of `key`, a new one where it was not known.
    std::uint32_t insert(const PointKey& key) {
        std::size_t slot = slotOf(key);
        if (slots_[slot].number == kNone) {
            if (2 * (static_cast<std::size_t>(size_) + 1) > slots_.size()) {
                grow();
                slot = slotOf(key);
            }
            slots_[slot] = {key, size_++};
        }
        return slots_[slot].number;
    }

  private:
    struct Slot {
        PointKey key;
        std::uint32_t number = kNone;
    };

    std::size_t slotOf(const PointKey& key) const {
        const std::size_t mask = slots_.size() - 1;
        // Fibonacci hashing; the fold brings the high bits of both coordinates down.
        std::uint64_t h = (key.place ^ (static_cast<std::uint64_t>(key.where) << 17)) * 0x9e3779b97f4a7c15ULL;
        h = (h ^ (h >> 32)) * 0xd6e8feb86659fd93ULL;
        std::size_t slot = static_cast<std::size_t>(h >> 32) & mask;
        while (slots_[slot].number != kNone && !(slots_[slot].key == key)) {
            slot = (slot + 1) & mask;
        }
        return slot;
    }

    void grow() {
        std::vector<Slot> old(2 * slots_.size());
        old.swap(slots_);
        for (const Slot& s : old) {
            if (s.number != kNone) {
                slots_[slotOf(s.key)] = s;
            }
        }
    }

    std::vector<Slot> slots_;
    std::uint32_t size_ = 0;
};

}  // namespace fluxwalk::display
