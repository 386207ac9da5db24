#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/io/gltf_model.h"

namespace fluxwalk::io {

/// Random access to the elements of one accessor: every component type, normalised or not, interleaved,
/// sparse, or without data (zeros). The constructor checks every range; throws base::FileError. Keeps a
/// reference to the model.
class AccessorReader {
  public:
    AccessorReader(const GltfModel& model, int accessor);

    std::size_t size() const { return count_; }
    /// 1 for SCALAR to 4 for VEC4.
    unsigned components() const { return components_; }
    bool isInteger() const;
    const std::string& place() const { return place_; }

    /// One component; normalised integers become [0, 1] or [-1, 1]. `element` must be below size().
    double component(std::size_t element, unsigned component) const;
    /// An unsigned integer scalar, as indices are.
    std::uint32_t index(std::size_t element) const;

  private:
    /// First byte of an element; null where it is zero for lack of data.
    const std::uint8_t* bytesOf(std::size_t element) const;
    void readSparse(const GltfModel& model, const tinygltf::Accessor& accessor);

    std::string place_;
    std::size_t count_ = 0;
    unsigned components_ = 0;
    int type_ = 0;
    bool normalized_ = false;
    std::size_t elementBytes_ = 0;
    std::size_t stride_ = 0;
    std::span<const std::uint8_t> data_;
    /// Elements that the sparse part replaces, ascending, and their values, packed.
    std::vector<std::uint32_t> sparseIndices_;
    std::span<const std::uint8_t> sparseValues_;
};

}  // namespace fluxwalk::io
