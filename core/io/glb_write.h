#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/base/vec.h"

namespace fluxwalk::io {

/// A .glb under construction: JSON and the binary chunk that its accessors and images point into.
// NOLINTNEXTLINE(bugprone-exception-escape): nlohmann::json moves without exceptions
class GlbBuilder {
  public:
    /// The document; bufferViews, accessors and buffers are filled by this class.
    nlohmann::json root;

    /// Appends to an array of the document and returns the index.
    std::size_t append(const char* section, nlohmann::json item);
    std::size_t addView(std::span<const std::uint8_t> bytes);
    std::size_t addVectors(std::span<const base::Vec2> values);
    /// `withBounds`: with the smallest and largest components, as POSITION must have.
    std::size_t addVectors(std::span<const base::Vec3> values, bool withBounds = false);
    std::size_t addIndices(std::span<const std::uint32_t> indices);

    /// The whole file; empty where it would exceed the 4 GiB that the format can count.
    std::vector<std::uint8_t> pack();

  private:
    std::vector<std::uint8_t> bin_;
};

}  // namespace fluxwalk::io
