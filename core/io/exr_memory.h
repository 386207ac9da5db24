#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include <OpenEXR/ImfIO.h>

namespace fluxwalk::io {

/// A file in memory: the library goes back in it to fill in its table of offsets.
class ExrMemory final : public Imf::OStream {
  public:
    ExrMemory() : Imf::OStream("memory") {}

    void write(const char data[], int count) override {
        const auto size = static_cast<std::size_t>(count);
        bytes_.resize(std::max(bytes_.size(), at_ + size));
        std::copy_n(data, size, bytes_.begin() + static_cast<std::ptrdiff_t>(at_));
        at_ += size;
    }
    std::uint64_t tellp() override { return at_; }
    void seekp(std::uint64_t position) override { at_ = position; }

    std::vector<std::uint8_t> take() { return std::move(bytes_); }

  private:
    std::vector<std::uint8_t> bytes_;
    std::size_t at_ = 0;
};

}  // namespace fluxwalk::io
