#include "core/cli/output.h"

#include <cerrno>
#include <cstdio>
#include <string>
#include <system_error>

#include <unistd.h>

namespace fluxwalk::cli {

namespace {

std::string lastFailure() {
    return std::generic_category().message(errno);
}

}  // namespace

void requireWritable(const std::filesystem::path& file) {
    std::error_code ignored;
    const std::filesystem::file_status status = std::filesystem::status(file, ignored);
    if (std::filesystem::is_directory(status)) {
        throw WriteError(file.string(), "", "cannot be written: it is a folder");
    }
    if (std::filesystem::is_other(status)) {
        // A device or pipe is written to directly.
        if (access(file.c_str(), W_OK) != 0) {
            throw WriteError(file.string(), "", "cannot be written: " + lastFailure());
        }
        return;
    }
    if (!file.has_filename()) {
        throw WriteError(file.string(), "", "cannot be written: it names no file");
    }
    std::filesystem::path probe = file;
    probe += ".part" + std::to_string(getpid());
    std::FILE* stream = std::fopen(probe.c_str(), "wb");
    if (stream == nullptr) {
        throw WriteError(file.string(), "", "cannot be written: " + lastFailure());
    }
    std::fclose(stream);
    std::filesystem::remove(probe, ignored);
}

void writeOutput(const std::function<void()>& write) {
    try {
        write();
    } catch (const WriteError&) {
        throw;
    } catch (const base::FileError& error) {
        // what() already names file and place.
        const std::string whole = error.what();
        const std::string prefix =
            error.place().empty() ? error.file() + ": " : error.file() + ": " + error.place() + ": ";
        throw WriteError(error.file(), error.place(), whole.substr(std::min(prefix.size(), whole.size())));
    }
}

void printText(std::string_view text) {
    if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0) {
        throw WriteError("standard output", "", "cannot be written: " + lastFailure());
    }
}

void printWarning(std::string_view message) {
    std::fprintf(stderr, "fluxwalk: warning: %.*s\n", static_cast<int>(message.size()), message.data());
}

}  // namespace fluxwalk::cli
