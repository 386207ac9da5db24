#include "core/io/exr.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>

#include "core/base/check.h"
#include "core/io/exr_memory.h"
#include "core/io/file.h"

namespace fluxwalk::io {

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
    ExrMemory memory;
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
