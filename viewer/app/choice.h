#pragma once

#include <array>
#include <string>
#include <string_view>
#include <utility>

#include "core/base/error.h"

namespace fluxwalk::app {

/// One of the words that an option takes, with its meaning.
template <class Value, std::size_t N>
using Choices = std::array<std::pair<std::string_view, Value>, N>;

/// The meaning of a word typed for an option. Throws base::UsageError that lists the words.
template <class Value, std::size_t N>
Value parseChoice(std::string_view option, const std::string& text, const Choices<Value, N>& choices) {
    std::string words;
    for (std::size_t i = 0; i < N; ++i) {
        if (text == choices[i].first) {
            return choices[i].second;
        }
        words += (i == 0 ? "" : i + 1 < N ? ", " : " and ") + std::string(choices[i].first);
    }
    throw base::UsageError(std::string(option) + ": '" + text + "' is none of " + words);
}

}  // namespace fluxwalk::app
