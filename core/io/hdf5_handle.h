#pragma once

#include <string>
#include <utility>

#include <hdf5.h>

#include "core/base/error.h"

namespace fluxwalk::io {

/// Owner of something that HDF5 has opened.
class Hdf5Handle {
  public:
    using Close = herr_t (*)(hid_t);

    /// Throws base::FileError where `id` says that opening failed; `what` then names it.
    Hdf5Handle(hid_t id, Close close, const std::string& file, const std::string& what)
        : id_(id), close_(close) {
        if (id < 0) {
            throw base::FileError(file, what, "HDF5 refuses it");
        }
    }
    ~Hdf5Handle() { close_(id_); }
    Hdf5Handle(const Hdf5Handle&) = delete;
    Hdf5Handle& operator=(const Hdf5Handle&) = delete;

    hid_t get() const { return id_; }

  private:
    hid_t id_;
    Close close_;
};

/// While it lives, HDF5 prints no errors of its own.
class Hdf5Silence {
  public:
    Hdf5Silence() {
        H5Eget_auto2(H5E_DEFAULT, &function_, &data_);
        H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    }
    ~Hdf5Silence() { H5Eset_auto2(H5E_DEFAULT, function_, data_); }
    Hdf5Silence(const Hdf5Silence&) = delete;
    Hdf5Silence& operator=(const Hdf5Silence&) = delete;

  private:
    H5E_auto2_t function_ = nullptr;
    void* data_ = nullptr;
};

/// HDF5's type of an array's numbers, in the file and in memory: little-endian on every machine that this
/// runs on.
inline hid_t typeOf(const std::uint8_t*) {
    return H5T_STD_U8LE;
}
inline hid_t typeOf(const std::int8_t*) {
    return H5T_STD_I8LE;
}
inline hid_t typeOf(const std::uint16_t*) {
    return H5T_STD_U16LE;
}
inline hid_t typeOf(const std::uint32_t*) {
    return H5T_STD_U32LE;
}
inline hid_t typeOf(const std::uint64_t*) {
    return H5T_STD_U64LE;
}
inline hid_t typeOf(const float*) {
    return H5T_IEEE_F32LE;
}
inline hid_t typeOf(const double*) {
    return H5T_IEEE_F64LE;
}

}  // namespace fluxwalk::io
