#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/base/named_arrays.h"

/// Named arrays as an HDF5 file in memory. The HDF5 library is not re-entrant: one call of these at a time.
namespace fluxwalk::io {

/// Image of an HDF5 file with one dataset for each array, its unit as an attribute. Long arrays are shuffled
/// and deflated. Equal arrays give equal bytes. Throws base::FileError that names `file`.
std::vector<std::uint8_t> makeHdf5Image(const base::NamedArrays& arrays, const std::string& file);

/// The arrays of such an image, whose bytes have been checked by a digest already. Everything that
/// makeHdf5Image does not write (links, other types and filters, external data, sizes that cannot be) is
/// refused by a base::FileError that names `file`.
base::NamedArrays readHdf5Image(std::span<const std::uint8_t> image, const std::string& file);

}  // namespace fluxwalk::io
