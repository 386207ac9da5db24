#include "viewer/app/picture_sequence.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <optional>

#include "core/base/error.h"

namespace fluxwalk::app {
namespace {

constexpr unsigned kMostDigits = 9;

}  // namespace

PictureSequence::PictureSequence(const std::filesystem::path& pattern) {
    const std::string text = pattern.string();
    const auto fail = [&](const std::string& what) {
        throw base::UsageError("--screenshot '" + base::toOneLine(text) + "': " + what +
                               "; pictures of a path are named like walk_%04d.png");
    };
    std::optional<std::size_t> end;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] != '%') {
            (end ? after_ : before_) += text[i];
            continue;
        }
        if (i + 1 < text.size() && text[i + 1] == '%') {
            (end ? after_ : before_) += '%';
            ++i;
            continue;
        }
        std::size_t d = i + 1;
        while (d < text.size() && std::isdigit(static_cast<unsigned char>(text[d])) != 0) {
            ++d;
        }
        const std::string width = text.substr(i + 1, d - i - 1);
        if (d >= text.size() || text[d] != 'd' || width.size() > 2 || (!width.empty() && width[0] != '0')) {
            fail("knows no '" + base::toOneLine(text.substr(i, 4)) + "'");
        }
        if (end) {
            fail("has two places for the number");
        }
        digits_ = width.empty() ? 1 : static_cast<unsigned>(std::stoul(width));
        if (digits_ > kMostDigits) {
            fail("has more than 9 digits");
        }
        end = i = d;
    }
    if (!end) {
        fail("has no place for the number");
    }
}

std::filesystem::path PictureSequence::file(unsigned number) const {
    std::string digits = std::to_string(number);
    digits.insert(0, std::max<std::size_t>(digits_, digits.size()) - digits.size(), '0');
    return before_ + digits + after_;
}

unsigned countPictures(double seconds, double fps) {
    // A hair less than a whole frame is rounding.
    return 1 + static_cast<unsigned>(std::floor(seconds * fps + 1e-6));
}

}  // namespace fluxwalk::app
