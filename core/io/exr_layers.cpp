#include "core/io/exr_layers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <list>
#include <tuple>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <glm/gtc/packing.hpp>

#include "core/base/check.h"
#include "core/io/exr_memory.h"
#include "core/io/file.h"

namespace fluxwalk::io {

namespace {

/// Rows handed to the library at once; ZIP compresses 16.
constexpr std::uint32_t kRows = 64;
constexpr float kLargestHalf = 65504.0f;

template <class Value>
constexpr Imf::PixelType typeOf() {
    if constexpr (std::is_same_v<Value, float>) {
        return Imf::FLOAT;
    } else if constexpr (std::is_same_v<Value, std::uint16_t>) {
        return Imf::HALF;
    } else {
        return Imf::UINT;
    }
}

std::uint16_t halfBits(float value) {
    return glm::packHalf1x16(std::clamp(value, -kLargestHalf, kLargestHalf));
}

/// Some rows of one layer in a form that the library takes: it reads through a pointer that its interface
/// does not make const.
template <class Value>
class Rows {
  public:
    Rows(const ExrLayer& layer, std::uint32_t width)
        : names_(layer.channels), row_(width * layer.channels.size()), values_(row_ * kRows) {}

    Value* data() { return values_.data(); }
    std::size_t row() const { return row_; }

    // Slices for the rows from `first` on.
    void insertInto(Imf::FrameBuffer& buffer, std::uint32_t first) {
        const std::size_t pixel = sizeof(Value) * names_.size();
        const std::size_t line = sizeof(Value) * row_;
        for (std::size_t c = 0; c < names_.size(); ++c) {
            // The library adds line times the row's number.
            char* base =
                reinterpret_cast<char*>(values_.data() + c) - static_cast<std::ptrdiff_t>(line * first);
            buffer.insert(names_[c], Imf::Slice(typeOf<Value>(), base, pixel, line));
        }
    }

  private:
    std::vector<std::string> names_;
    std::size_t row_;
    std::vector<Value> values_;
};

/// A layer's rows, of the type that the file has.
class LayerRows {
  public:
    LayerRows(const ExrLayer& layer, std::uint32_t width) : layer_(layer) {
        if (const auto* floats = std::get_if<std::span<const float>>(&layer.values)) {
            if (layer.asHalf) {
                halves_.emplace_back(layer, width);
            } else {
                floats_.emplace_back(layer, width);
            }
            count_ = floats->size();
        } else if (const auto* bits = std::get_if<std::span<const std::uint16_t>>(&layer.values)) {
            halves_.emplace_back(layer, width);
            count_ = bits->size();
        } else {
            numbers_.emplace_back(layer, width);
            count_ = std::get<std::span<const std::uint32_t>>(layer.values).size();
        }
    }

    std::size_t count() const { return count_; }
    Imf::PixelType type() const {
        return !floats_.empty() ? Imf::FLOAT : !halves_.empty() ? Imf::HALF : Imf::UINT;
    }

    void fill(Imf::FrameBuffer& buffer, std::uint32_t first, std::uint32_t rows) {
        if (!floats_.empty()) {
            copy(std::get<std::span<const float>>(layer_.values), floats_.front(), first, rows);
            floats_.front().insertInto(buffer, first);
        } else if (!numbers_.empty()) {
            copy(std::get<std::span<const std::uint32_t>>(layer_.values), numbers_.front(), first, rows);
            numbers_.front().insertInto(buffer, first);
        } else {
            if (const auto* light = std::get_if<std::span<const float>>(&layer_.values)) {
                const std::size_t row = halves_.front().row();
                std::transform(light->begin() + static_cast<std::ptrdiff_t>(first * row),
                               light->begin() + static_cast<std::ptrdiff_t>((first + rows) * row),
                               halves_.front().data(), halfBits);
            } else {
                copy(std::get<std::span<const std::uint16_t>>(layer_.values), halves_.front(), first, rows);
            }
            halves_.front().insertInto(buffer, first);
        }
    }

  private:
    template <class Value>
    static void copy(std::span<const Value> values, Rows<Value>& rows, std::uint32_t first,
                     std::uint32_t count) {
        std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(first * rows.row()), count * rows.row(),
                    rows.data());
    }

    const ExrLayer& layer_;
    std::size_t count_ = 0;
    // One of them has one.
    std::vector<Rows<float>> floats_;
    std::vector<Rows<std::uint16_t>> halves_;
    std::vector<Rows<std::uint32_t>> numbers_;
};

}  // namespace

std::vector<std::uint8_t> encodeExrLayers(std::uint32_t width, std::uint32_t height,
                                          std::span<const ExrLayer> layers) {
    Imf::Header header(static_cast<int>(width), static_cast<int>(height));
    header.compression() = Imf::ZIP_COMPRESSION;
    Imf::addWhiteLuminance(header, 1.0f);
    std::vector<LayerRows> rows;
    rows.reserve(layers.size());
    for (const ExrLayer& layer : layers) {
        rows.emplace_back(layer, width);
        FLUXWALK_CHECK_EQ(rows.back().count(), layer.channels.size() * width * height);
        for (const std::string& name : layer.channels) {
            header.channels().insert(name, Imf::Channel(rows.back().type()));
        }
    }
    ExrMemory memory;
    {
        // Without threads of its own; completes the file when it goes.
        Imf::OutputFile file(memory, header, 0);
        for (std::uint32_t first = 0; first < height; first += kRows) {
            const std::uint32_t count = std::min(kRows, height - first);
            Imf::FrameBuffer buffer;
            for (LayerRows& layer : rows) {
                layer.fill(buffer, first, count);
            }
            file.setFrameBuffer(buffer);
            file.writePixels(static_cast<int>(count));
        }
    }
    return memory.take();
}

void writeExrLayers(const std::filesystem::path& file, std::uint32_t width, std::uint32_t height,
                    std::span<const ExrLayer> layers) {
    writeFile(file, encodeExrLayers(width, height, layers));
}

}  // namespace fluxwalk::io
