#include "core/io/exr.h"

#include <algorithm>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>

#include "core/base/check.h"
#include "core/io/file.h"

namespace fluxwalk::io {

namespace {

/// A file in memory: the library goes back in it to fill in its table of offsets.
class Memory final : public Imf::OStream {
  public:
    Memory() : Imf::OStream("memory") {}

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

}  // namespace

std::vector<std::uint8_t> encodeExr(std::uint32_t width, std::uint32_t height, std::span<const float> light) {
    FLUXWALK_CHECK_EQ(light.size(), std::size_t{3} * width * height);
    FLUXWALK_CHECK_LT(0u, light.size());
    Imf::Header header(static_cast<int>(width), static_cast<int>(height));
    header.compression() = Imf::ZIP_COMPRESSION;
    Imf::addWhiteLuminance(header, 1.0f);
    Imf::FrameBuffer channels;
    // The library reads through a pointer that its interface does not make const.
    std::vector<float> copy(light.begin(), light.end());
    constexpr std::size_t kPixel = 3 * sizeof(float);
    const char* const names[] = {"R", "G", "B"};
    for (std::size_t c = 0; c < 3; ++c) {
        header.channels().insert(names[c], Imf::Channel(Imf::FLOAT));
        channels.insert(names[c], Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(copy.data() + c), kPixel,
                                             kPixel * width));
    }
    Memory memory;
    {
        // Without threads of its own; completes the file when it goes.
        Imf::OutputFile file(memory, header, 0);
        file.setFrameBuffer(channels);
        file.writePixels(static_cast<int>(height));
    }
    return memory.take();
}

void writeExr(const std::filesystem::path& file, std::uint32_t width, std::uint32_t height,
              std::span<const float> light) {
    writeFile(file, encodeExr(width, height, light));
}

}  // namespace fluxwalk::io
