#pragma once

#include <filesystem>
#include <string>

namespace fluxwalk::app {

/// Files of numbered pictures, named by a pattern with one place for the number: "walk_%04d.png".
class PictureSequence {
  public:
    /// Throws base::UsageError where the pattern has no such place, more than one, or an unknown "%".
    explicit PictureSequence(const std::filesystem::path& pattern);

    std::filesystem::path file(unsigned number) const;

  private:
    std::string before_;
    std::string after_;
    unsigned digits_ = 0;
};

/// Pictures that show so many seconds at `fps`: both ends are shown.
unsigned countPictures(double seconds, double fps);

}  // namespace fluxwalk::app
