#include "core/io/file.h"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <string>

#include <fcntl.h>
#include <unistd.h>

#include "core/base/error.h"

namespace fluxwalk::io {

namespace {

namespace fs = std::filesystem;

std::string reason() {
    return errno != 0 ? std::strerror(errno) : "unknown error";
}

using Parts = std::span<const std::span<const std::uint8_t>>;

// False where the stream failed; errno then says why.
bool writeStream(const fs::path& file, Parts parts) {
    errno = 0;
    std::ofstream out(file, std::ios::binary | std::ios::trunc);
    if (!out) {
        return false;
    }
    for (const std::span<const std::uint8_t> bytes : parts) {
        out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    }
    out.close();
    return !out.fail();
}

// Waits until a file or folder is on the disk. False where that failed; errno then says why.
bool waitForDisk(const fs::path& file) {
    const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0) {
        return false;
    }
    const bool isDone = ::fsync(descriptor) == 0;
    const int why = errno;
    ::close(descriptor);
    errno = why;
    return isDone;
}

void writeBeside(const fs::path& file, Parts parts, bool isDurable) {
    std::error_code error;
    // A link is written through, not replaced.
    const fs::path target = fs::is_symlink(file, error) ? fs::weakly_canonical(file, error) : file;
    const fs::file_status status = fs::status(target, error);
    if (fs::is_directory(status)) {
        throw base::FileError(file.string(), "", "cannot be written: it is a folder");
    }
    if (fs::exists(status) && !fs::is_regular_file(status)) {
        if (!writeStream(target, parts)) {
            throw base::FileError(file.string(), "", "cannot be written: " + reason());
        }
        return;
    }
    fs::path partial = target;
    partial += ".partial-" + std::to_string(::getpid());
    if (!writeStream(partial, parts) || (isDurable && !waitForDisk(partial))) {
        const std::string why = reason();
        fs::remove(partial, error);
        throw base::FileError(file.string(), "", "cannot be written: " + why);
    }
    fs::rename(partial, target, error);
    if (error) {
        const std::string why = error.message();
        fs::remove(partial, error);
        throw base::FileError(file.string(), "", "cannot be written: " + why);
    }
    if (isDurable) {
        // Some file systems cannot do this for folders; the name is then as safe as they make it.
        waitForDisk(target.has_parent_path() ? target.parent_path() : fs::path("."));
    }
}

}  // namespace

std::vector<std::uint8_t> readFile(const fs::path& file, std::uint64_t maxBytes) {
    std::error_code error;
    const fs::file_status status = fs::status(file, error);
    if (!fs::exists(status)) {
        throw base::FileError(file.string(), "", "no such file");
    }
    if (!fs::is_regular_file(status)) {
        throw base::FileError(file.string(), "", "not a file");
    }
    const std::uintmax_t size = fs::file_size(file, error);
    if (error) {
        throw base::FileError(file.string(), "", "cannot be read: " + error.message());
    }
    if (size > maxBytes) {
        throw base::FileError(
            file.string(), "",
            "has " + std::to_string(size) + " bytes, more than the limit of " + std::to_string(maxBytes));
    }
    errno = 0;
    std::ifstream in(file, std::ios::binary);
    std::vector<std::uint8_t> bytes(static_cast<std::size_t>(size));
    if (!in || !in.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()))) {
        throw base::FileError(file.string(), "", "cannot be read: " + reason());
    }
    return bytes;
}

void writeFile(const fs::path& file, std::span<const std::uint8_t> bytes) {
    writeBeside(file, std::span(&bytes, 1), false);
}

void writeFile(const fs::path& file, std::string_view text) {
    writeFile(file, std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
}

void replaceFile(const fs::path& file, std::span<const std::span<const std::uint8_t>> parts) {
    writeBeside(file, parts, true);
}

}  // namespace fluxwalk::io
