#include "core/io/array_file.h"

#include <algorithm>
#include <array>

#include "core/base/error.h"
#include "core/base/hash.h"
#include "core/io/file.h"
#include "core/io/hdf5_arrays.h"

namespace fluxwalk::io {

namespace {

constexpr std::uint64_t kMaxArrayFileBytes = std::uint64_t{1} << 38;
constexpr std::uint32_t kLayoutVersion = 1;

/// What stands in front of HDF5's bytes; HDF5 looks for its own beginning at 0, 512, 1024, ...
struct Header {
    std::array<char, 24> magic{};
    std::uint32_t version = 0;
    std::uint32_t reserved = 0;
    std::uint64_t fileBytes = 0;
    std::uint64_t digest = 0;  ///< of all bytes of the file, this field taken as 0
    std::array<std::uint8_t, 464> padding{};
};
static_assert(sizeof(Header) == 512);

// As in PNG: what transfers as text break shows at once.
constexpr std::array<char, 24> kMagic{'\x89', 'f', 'l', 'u', 'x', 'w', 'a',  'l',  'k',    ' ',
                                      'a',    'r', 'r', 'a', 'y', 's', '\r', '\n', '\x1a', '\n'};

std::span<const std::uint8_t> bytesOf(const Header& header) {
    return {reinterpret_cast<const std::uint8_t*>(&header), sizeof(Header)};
}

std::uint64_t digestOf(Header header, std::span<const std::uint8_t> image) {
    header.digest = 0;
    base::Hasher hash;
    hash.addBytes(bytesOf(header));
    hash.addBytes(image);
    return hash.value();
}

}  // namespace

void writeArrayFile(const std::filesystem::path& file, const base::NamedArrays& arrays) {
    const std::vector<std::uint8_t> image = makeHdf5Image(arrays, file.string());
    Header header;
    header.magic = kMagic;
    header.version = kLayoutVersion;
    header.fileBytes = sizeof(Header) + image.size();
    header.digest = digestOf(header, image);
    replaceFile(file, std::array{bytesOf(header), std::span<const std::uint8_t>(image)});
}

base::NamedArrays readArrayFile(const std::filesystem::path& file) {
    const std::vector<std::uint8_t> bytes = readFile(file, kMaxArrayFileBytes);
    const auto refuse = [&file](const std::string& message) {
        throw base::FileError(file.string(), "", message);
    };
    Header header;
    std::copy_n(bytes.begin(), std::min(bytes.size(), sizeof(header)),
                reinterpret_cast<std::uint8_t*>(&header));
    if (header.magic != kMagic) {
        refuse("is no checkpoint");
    }
    if (bytes.size() < sizeof(Header)) {
        refuse("is cut short");
    }
    if (header.version != kLayoutVersion) {
        refuse("was written by another version: layout " + std::to_string(header.version) + ", not " +
               std::to_string(kLayoutVersion));
    }
    if (header.fileBytes != bytes.size()) {
        refuse("has " + std::to_string(bytes.size()) + " bytes in place of " +
               std::to_string(header.fileBytes) + ": it is cut short or altered");
    }
    const std::span<const std::uint8_t> image = std::span(bytes).subspan(sizeof(Header));
    if (digestOf(header, image) != header.digest) {
        refuse("is damaged: its digest does not agree");
    }
    return readHdf5Image(image, file.string());
}

}  // namespace fluxwalk::io
