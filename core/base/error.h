#pragma once

#include <stdexcept>
#include <string>

/// Errors of the world (files, options, values), as opposed to bugs (check.h). Thrown where found, caught
/// once in main.
namespace fluxwalk::base {

/// Text from a file made fit for a terminal: control characters become '?', so that it stays on one line.
std::string toOneLine(std::string text);

/// A file could not be read, understood or written. what() is one line: "FILE: PLACE: message".
class FileError : public std::runtime_error {
  public:
    /// `place` is a JSON pointer ("/meshes/0/primitives/1"), "line 12", or empty.
    FileError(std::string file, std::string place, const std::string& message);

    const std::string& file() const { return file_; }
    const std::string& place() const { return place_; }

  private:
    std::string file_;
    std::string place_;
};

/// An option or a value given by the user makes no sense. what() is one line.
class UsageError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

}  // namespace fluxwalk::base
