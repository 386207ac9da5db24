#include <algorithm>
#include <array>

#include "core/io/hdf5_arrays.h"
#include "core/io/hdf5_handle.h"

namespace fluxwalk::io {

namespace {

/// Arrays below this many bytes are stored as they are.
constexpr std::size_t kMinDeflated = 4096;
/// Numbers that are deflated together.
constexpr std::size_t kChunk = 1U << 16;
/// The fastest level: after shuffling, higher ones save a few percent for several times the time.
constexpr unsigned kDeflateLevel = 1;
/// The image in memory grows by this many bytes.
constexpr std::size_t kGrowth = 1U << 24;

class ImageWriter {
  public:
    explicit ImageWriter(const std::string& file) : file_(file) {}

    std::vector<std::uint8_t> write(const base::NamedArrays& arrays) const {
        const Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, file_, "");
        check(H5Pset_fapl_core(access.get(), kGrowth, 0), "");
        const Hdf5Handle image(H5Fcreate(file_.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, access.get()), H5Fclose,
                               file_, "");
        writeText(image.get(), "kind", arrays.kind);
        writeVersion(image.get(), arrays.version);
        const Hdf5Handle linking(H5Pcreate(H5P_LINK_CREATE), H5Pclose, file_, "");
        check(H5Pset_create_intermediate_group(linking.get(), 1), "");
        for (const base::NamedArray& array : arrays.arrays) {
            std::visit([&](const auto& values) { writeArray(image.get(), linking.get(), array, values); },
                       array.values);
        }
        check(H5Fflush(image.get(), H5F_SCOPE_GLOBAL), "");
        const ssize_t size = H5Fget_file_image(image.get(), nullptr, 0);
        check(size < 0 ? -1 : 0, "");
        std::vector<std::uint8_t> bytes(static_cast<std::size_t>(size));
        check(H5Fget_file_image(image.get(), bytes.data(), bytes.size()) < 0 ? -1 : 0, "");
        return bytes;
    }

  private:
    void check(herr_t status, const std::string& place) const {
        if (status < 0) {
            throw base::FileError(file_, place, "HDF5 cannot write it");
        }
    }

    void writeText(hid_t at, const char* name, const std::string& text) const {
        const Hdf5Handle type(H5Tcopy(H5T_C_S1), H5Tclose, file_, name);
        check(H5Tset_size(type.get(), std::max<std::size_t>(1, text.size())), name);
        const Hdf5Handle space(H5Screate(H5S_SCALAR), H5Sclose, file_, name);
        const Hdf5Handle attribute(H5Acreate2(at, name, type.get(), space.get(), H5P_DEFAULT, H5P_DEFAULT),
                                   H5Aclose, file_, name);
        check(H5Awrite(attribute.get(), type.get(), text.c_str()), name);
    }

    void writeVersion(hid_t at, std::uint32_t version) const {
        const Hdf5Handle space(H5Screate(H5S_SCALAR), H5Sclose, file_, "version");
        const Hdf5Handle attribute(
            H5Acreate2(at, "version", H5T_STD_U32LE, space.get(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose, file_,
            "version");
        check(H5Awrite(attribute.get(), H5T_STD_U32LE, &version), "version");
    }

    template <class T>
    void writeArray(hid_t at, hid_t linking, const base::NamedArray& array,
                    const std::vector<T>& values) const {
        const std::string& name = array.name;
        const std::array<hsize_t, 2> sizes{array.rows(), array.columns};
        const int rank = array.columns > 1 ? 2 : 1;
        const Hdf5Handle space(H5Screate_simple(rank, sizes.data(), nullptr), H5Sclose, file_, name);
        const Hdf5Handle making(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, file_, name);
        check(H5Pset_obj_track_times(making.get(), false), name);
        if (values.size() * sizeof(T) >= kMinDeflated) {
            const std::array<hsize_t, 2> chunk{std::min<hsize_t>(sizes[0], kChunk / array.columns),
                                               array.columns};
            check(H5Pset_chunk(making.get(), rank, chunk.data()), name);
            check(H5Pset_shuffle(making.get()), name);
            check(H5Pset_deflate(making.get(), kDeflateLevel), name);
        }
        const hid_t type = typeOf(values.data());
        const Hdf5Handle dataset(
            H5Dcreate2(at, name.c_str(), type, space.get(), linking, making.get(), H5P_DEFAULT), H5Dclose,
            file_, name);
        if (!array.unit.empty()) {
            writeText(dataset.get(), "unit", array.unit);
        }
        if (!values.empty()) {
            check(H5Dwrite(dataset.get(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), name);
        }
    }

    const std::string& file_;
};

}  // namespace

std::vector<std::uint8_t> makeHdf5Image(const base::NamedArrays& arrays, const std::string& file) {
    const Hdf5Silence silence;
    return ImageWriter(file).write(arrays);
}

}  // namespace fluxwalk::io
