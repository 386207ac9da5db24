#include <array>

#include "core/io/hdf5_arrays.h"
#include "core/io/hdf5_handle.h"

namespace fluxwalk::io {

namespace {

constexpr std::size_t kMaxArrays = 4096;
constexpr std::size_t kMaxText = 256;
/// Deflate makes nothing smaller than by this factor: a longer array cannot come from its bytes.
constexpr std::uint64_t kMaxDeflation = 1032;

class ImageReader {
  public:
    ImageReader(std::span<const std::uint8_t> image, const std::string& file) : image_(image), file_(file) {}

    base::NamedArrays read() {
        const Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, file_, "");
        check(H5Pset_fapl_core(access.get(), 1U << 16, 0), "");
        // HDF5 takes a copy and does not write to what it is given.
        check(H5Pset_file_image(access.get(), const_cast<std::uint8_t*>(image_.data()), image_.size()), "");
        // HDF5 takes no image by the name of a file that exists: a name inside one cannot.
        const std::string inside = file_ + "/image";
        const Hdf5Handle file(H5Fopen(inside.c_str(), H5F_ACC_RDONLY, access.get()), H5Fclose, file_, "");
        base::NamedArrays arrays;
        const Hdf5Handle root(H5Gopen2(file.get(), "/", H5P_DEFAULT), H5Gclose, file_, "");
        arrays.kind = readText(root.get(), "kind");
        arrays.version = readVersion(root.get());
        for (const std::string& group : namesIn(root.get(), "")) {
            const Hdf5Handle open(H5Gopen2(root.get(), group.c_str(), H5P_DEFAULT), H5Gclose, file_, group);
            for (const std::string& name : namesIn(open.get(), group)) {
                arrays.arrays.push_back(readArray(open.get(), name, group + "/" + name));
                if (arrays.arrays.size() > kMaxArrays) {
                    fail("", "holds too many arrays");
                }
            }
        }
        return arrays;
    }

  private:
    [[noreturn]] void fail(const std::string& place, const char* message) const {
        throw base::FileError(file_, place, message);
    }
    void check(herr_t status, const std::string& place) const {
        if (status < 0) {
            fail(place, "HDF5 cannot read it");
        }
    }

    std::vector<std::string> namesIn(hid_t group, const std::string& place) const {
        H5G_info_t info{};
        check(H5Gget_info(group, &info), place);
        if (info.nlinks > kMaxArrays) {
            fail(place, "holds too many arrays");
        }
        std::vector<std::string> names;
        for (hsize_t i = 0; i < info.nlinks; ++i) {
            std::array<char, kMaxText> name{};
            const ssize_t length = H5Lget_name_by_idx(group, ".", H5_INDEX_NAME, H5_ITER_INC, i, name.data(),
                                                      name.size(), H5P_DEFAULT);
            if (length <= 0 || static_cast<std::size_t>(length) >= name.size()) {
                fail(place, "holds something without a proper name");
            }
            H5L_info_t link{};
            check(H5Lget_info(group, name.data(), &link, H5P_DEFAULT), place);
            if (link.type != H5L_TYPE_HARD) {
                fail(place + "/" + name.data(), "is a link");
            }
            names.emplace_back(name.data());
        }
        return names;
    }

    std::string readText(hid_t at, const char* name) const {
        const Hdf5Handle attribute(H5Aopen(at, name, H5P_DEFAULT), H5Aclose, file_, name);
        const Hdf5Handle type(H5Aget_type(attribute.get()), H5Tclose, file_, name);
        const Hdf5Handle space(H5Aget_space(attribute.get()), H5Sclose, file_, name);
        std::array<char, kMaxText> text{};
        if (H5Tget_class(type.get()) != H5T_STRING || H5Tis_variable_str(type.get()) != 0 ||
            H5Tget_size(type.get()) >= text.size() || H5Sget_simple_extent_npoints(space.get()) != 1) {
            fail(name, "is no short text");
        }
        check(H5Aread(attribute.get(), type.get(), text.data()), name);
        return text.data();
    }

    std::uint32_t readVersion(hid_t at) const {
        const Hdf5Handle attribute(H5Aopen(at, "version", H5P_DEFAULT), H5Aclose, file_, "version");
        const Hdf5Handle space(H5Aget_space(attribute.get()), H5Sclose, file_, "version");
        if (H5Sget_simple_extent_npoints(space.get()) != 1) {
            fail("version", "is no number");
        }
        std::uint32_t version = 0;
        check(H5Aread(attribute.get(), H5T_STD_U32LE, &version), "version");
        return version;
    }

    // Only what makeHdf5Image sets: other filters would load code, external and virtual data other files.
    void checkStorage(hid_t dataset, const std::string& place) const {
        const Hdf5Handle making(H5Dget_create_plist(dataset), H5Pclose, file_, place);
        const H5D_layout_t layout = H5Pget_layout(making.get());
        bool isPlain = (layout == H5D_CONTIGUOUS || layout == H5D_CHUNKED || layout == H5D_COMPACT) &&
                       H5Pget_external_count(making.get()) == 0;
        const int filters = H5Pget_nfilters(making.get());
        for (int i = 0; isPlain && i < filters; ++i) {
            unsigned flags = 0;
            std::size_t values = 0;
            const H5Z_filter_t filter = H5Pget_filter2(making.get(), static_cast<unsigned>(i), &flags,
                                                       &values, nullptr, 0, nullptr, nullptr);
            isPlain = filter == H5Z_FILTER_DEFLATE || filter == H5Z_FILTER_SHUFFLE;
        }
        if (!isPlain || filters < 0) {
            fail(place, "is stored in another way");
        }
    }

    template <class T>
    bool readAs(hid_t dataset, hid_t type, std::uint64_t count, base::NamedArray& array) const {
        const hid_t wanted = typeOf(static_cast<const T*>(nullptr));
        if (H5Tequal(type, wanted) <= 0) {
            return false;
        }
        if (count > image_.size() * kMaxDeflation / sizeof(T)) {
            fail(array.name, "is longer than its bytes can tell");
        }
        std::vector<T> values(static_cast<std::size_t>(count));
        if (count > 0) {
            check(H5Dread(dataset, wanted, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), array.name);
        }
        array.values = std::move(values);
        return true;
    }

    base::NamedArray readArray(hid_t group, const std::string& name, const std::string& place) const {
        const Hdf5Handle dataset(H5Dopen2(group, name.c_str(), H5P_DEFAULT), H5Dclose, file_, place);
        checkStorage(dataset.get(), place);
        const Hdf5Handle space(H5Dget_space(dataset.get()), H5Sclose, file_, place);
        const int rank = H5Sget_simple_extent_ndims(space.get());
        std::array<hsize_t, 2> sizes{0, 1};
        if (rank < 1 || rank > 2) {
            fail(place, "has neither one nor two dimensions");
        }
        check(H5Sget_simple_extent_dims(space.get(), sizes.data(), nullptr), place);
        if (sizes[1] == 0 || sizes[1] > 64 || sizes[0] > (std::uint64_t{1} << 48)) {
            fail(place, "has an impossible size");
        }
        const Hdf5Handle type(H5Dget_type(dataset.get()), H5Tclose, file_, place);
        base::NamedArray array;
        array.name = place;
        array.columns = static_cast<std::uint32_t>(sizes[1]);
        const std::uint64_t count = sizes[0] * sizes[1];
        const hid_t d = dataset.get();
        const hid_t t = type.get();
        if (!readAs<std::uint8_t>(d, t, count, array) && !readAs<std::int8_t>(d, t, count, array) &&
            !readAs<std::uint16_t>(d, t, count, array) && !readAs<std::uint32_t>(d, t, count, array) &&
            !readAs<std::uint64_t>(d, t, count, array) && !readAs<float>(d, t, count, array) &&
            !readAs<double>(d, t, count, array)) {
            fail(place, "holds numbers of an unknown kind");
        }
        return array;
    }

    std::span<const std::uint8_t> image_;
    const std::string& file_;
};

}  // namespace

base::NamedArrays readHdf5Image(std::span<const std::uint8_t> image, const std::string& file) {
    const Hdf5Silence silence;
    return ImageReader(image, file).read();
}

}  // namespace fluxwalk::io
