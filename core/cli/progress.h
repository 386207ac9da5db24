#pragma once

#include <cstdio>
#include <functional>
#include <string>
#include <string_view>

/// How far a solve is: a bar with the time left on a terminal, plain lines elsewhere.
namespace fluxwalk::cli {

/// "0.4 s", "12 s", "3:20 min", "1:02:03 h".
std::string formatDuration(double seconds);

/// Seconds until the end if the pace stays; negative while it cannot be said.
double estimateRemaining(double fraction, double elapsed);

/// "[######----------]  38 %  refine  1.2 s, 2 s left", at most `columns` wide.
std::string formatBar(double fraction, std::string_view stage, double elapsed, unsigned columns);
/// "38 %  refine  1.2 s, 2 s left".
std::string formatLine(double fraction, std::string_view stage, double elapsed);

enum class ProgressStyle : std::uint8_t { none, bar, lines };
ProgressStyle chooseStyle(std::FILE* stream, bool quiet);

/// Written to one stream, at most five times a second as a bar and once a second as lines.
class Progress {
  public:
    /// `clock` gives seconds and never goes back; by default the steady clock.
    Progress(std::FILE* stream, ProgressStyle style, std::function<double()> clock = {});
    /// Clears the bar.
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// `fraction` in [0, 1].
    void update(double fraction, std::string_view stage);

  private:
    std::FILE* stream_;
    ProgressStyle style_;
    std::function<double()> clock_;
    double start_;
    double nextWrite_;
    bool hasBar_ = false;
};

}  // namespace fluxwalk::cli
