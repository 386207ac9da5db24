#pragma once

#include <filesystem>
#include <functional>
#include <string_view>

#include "core/base/error.h"

/// Results leave the program here: nothing half-written, and failures told apart from bad input.
namespace fluxwalk::cli {

/// A result could not be written.
class WriteError : public base::FileError {
  public:
    using base::FileError::FileError;
};

/// Throws WriteError where no file could be made or replaced at that path; called before the work whose
/// result it will hold.
void requireWritable(const std::filesystem::path& file);

/// Runs `write`, which writes a file; its base::FileErrors become WriteErrors.
void writeOutput(const std::function<void()>& write);

/// To standard output, at once. Throws WriteError (a full disk behind a redirection).
void printText(std::string_view text);

/// One line to standard error: "fluxwalk: warning: ...".
void printWarning(std::string_view message);

}  // namespace fluxwalk::cli
