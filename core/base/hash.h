#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <span>

#include "core/base/random.h"
#include "core/base/vec.h"

/// Digests that tell different contents apart: against accidents, not against forgers.
namespace fluxwalk::base {

/// 64-bit digest of a sequence of values. Each step is a bijection of the state and of the word, so that one
/// altered word always alters the digest. The same on every machine of the same byte order.
class Hasher {
  public:
    void add(std::uint64_t word) { state_ = mix(state_ ^ word) + 0x9e3779b97f4a7c15ULL; }
    void add(double value) { add(std::bit_cast<std::uint64_t>(value)); }
    void add(float value) { add(std::uint64_t{std::bit_cast<std::uint32_t>(value)}); }
    template <glm::length_t L, class T, glm::qualifier Q>
    void add(const glm::vec<L, T, Q>& v) {
        for (glm::length_t i = 0; i < L; ++i) {
            add(v[i]);
        }
    }
    /// The bytes and how many they are.
    void addBytes(std::span<const std::uint8_t> bytes) {
        std::size_t i = 0;
        for (; i + 8 <= bytes.size(); i += 8) {
            std::uint64_t word = 0;
            std::memcpy(&word, bytes.data() + i, 8);
            add(word);
        }
        std::uint64_t rest = 0;
        if (i < bytes.size()) {
            std::memcpy(&rest, bytes.data() + i, bytes.size() - i);
        }
        add(rest);
        add(std::uint64_t{bytes.size()});
    }
    std::uint64_t value() const { return state_; }

  private:
    std::uint64_t state_ = 0x243f6a8885a308d3ULL;
};

}  // namespace fluxwalk::base
