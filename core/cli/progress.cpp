#include "core/cli/progress.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

namespace fluxwalk::cli {

namespace {

constexpr double kBarInterval = 0.2;   // seconds
constexpr double kLineInterval = 1.0;  // seconds
constexpr unsigned kDefaultColumns = 80;

double steadySeconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

unsigned terminalColumns(std::FILE* stream) {
    winsize size{};
    const bool isKnown = ioctl(fileno(stream), TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
    return isKnown ? size.ws_col : kDefaultColumns;
}

int toPercent(double fraction) {
    return static_cast<int>(std::floor(100.0 * std::clamp(fraction, 0.0, 1.0)));
}

}  // namespace

std::string formatDuration(double seconds) {
    if (seconds < 9.95) {
        return fmt::format("{:.1f} s", std::max(0.0, seconds));
    }
    const auto whole = static_cast<std::int64_t>(std::llround(seconds));
    if (whole < 60) {
        return fmt::format("{} s", whole);
    }
    if (whole < 3600) {
        return fmt::format("{}:{:02} min", whole / 60, whole % 60);
    }
    return fmt::format("{}:{:02}:{:02} h", whole / 3600, whole / 60 % 60, whole % 60);
}

double estimateRemaining(double fraction, double elapsed) {
    if (fraction < 0.01 || elapsed < 0.2) {
        return -1.0;
    }
    return elapsed * (1.0 - std::min(1.0, fraction)) / fraction;
}

std::string formatLine(double fraction, std::string_view stage, double elapsed) {
    std::string line = fmt::format("{:3} %  {}  {}", toPercent(fraction), stage, formatDuration(elapsed));
    const double remaining = estimateRemaining(fraction, elapsed);
    if (remaining >= 0.0) {
        line += fmt::format(", {} left", formatDuration(remaining));
    }
    return line;
}

std::string formatBar(double fraction, std::string_view stage, double elapsed, unsigned columns) {
    const std::string line = formatLine(fraction, stage, elapsed);
    if (columns < line.size() + 8) {
        return line.substr(0, columns);
    }
    const std::size_t cells = std::min<std::size_t>(30, columns - line.size() - 3);
    const auto full =
        static_cast<std::size_t>(std::floor(static_cast<double>(cells) * std::clamp(fraction, 0.0, 1.0)));
    return "[" + std::string(full, '#') + std::string(cells - full, '-') + "] " + line;
}

ProgressStyle chooseStyle(std::FILE* stream, bool quiet) {
    if (quiet) {
        return ProgressStyle::none;
    }
    return isatty(fileno(stream)) != 0 ? ProgressStyle::bar : ProgressStyle::lines;
}

Progress::Progress(std::FILE* stream, ProgressStyle style, std::function<double()> clock)
    : stream_(stream),
      style_(style),
      clock_(clock ? std::move(clock) : steadySeconds),
      start_(clock_()),
      // What is done within an interval needs no progress.
      nextWrite_(start_ + (style == ProgressStyle::bar ? kBarInterval : kLineInterval)) {}

Progress::~Progress() {
    if (hasBar_) {
        std::fputs("\r\033[K", stream_);
        std::fflush(stream_);
    }
}

void Progress::update(double fraction, std::string_view stage) {
    const double now = clock_();
    if (style_ == ProgressStyle::none || now < nextWrite_) {
        return;
    }
    const double elapsed = now - start_;
    if (style_ == ProgressStyle::bar) {
        const std::string bar = formatBar(fraction, stage, elapsed, terminalColumns(stream_) - 1);
        fmt::print(stream_, "\r{}\033[K", bar);
        hasBar_ = true;
        nextWrite_ = now + kBarInterval;
    } else {
        fmt::print(stream_, "{}\n", formatLine(fraction, stage, elapsed));
        nextWrite_ = now + kLineInterval;
    }
    std::fflush(stream_);
}

}  // namespace fluxwalk::cli
