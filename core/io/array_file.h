#pragma once

#include <filesystem>

#include "core/base/named_arrays.h"

/// Files of named arrays: an HDF5 file behind a block of 512 bytes, which HDF5 skips (a user block), with
/// length and digest of the whole. h5py and h5dump open them as they are.
namespace fluxwalk::io {

/// Writes beside `file`, waits for the disk and renames: at every moment the old or the new file is there
/// complete. Throws base::FileError and then leaves the old one.
void writeArrayFile(const std::filesystem::path& file, const base::NamedArrays& arrays);

/// HDF5 sees the bytes only after length and digest agree. Throws base::FileError.
base::NamedArrays readArrayFile(const std::filesystem::path& file);

}  // namespace fluxwalk::io
