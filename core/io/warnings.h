#pragma once

#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/base/error.h"

namespace fluxwalk::io {

/// What a reader worked around: each message once, with its first place and how many more there are.
class Warnings {
  public:
    /// `place` is a JSON pointer, possibly with a name.
    void add(const std::string& message, const std::string& place) {
        const auto [found, isNew] = indexOf_.try_emplace(message, entries_.size());
        if (isNew) {
            entries_.push_back({message, place, 1});
        } else {
            ++entries_[found->second].count;
        }
    }

    /// "PLACE: message (and 3 more)", in the order of their first appearance.
    std::vector<std::string> lines() const {
        std::vector<std::string> result;
        for (const Entry& entry : entries_) {
            std::string line = entry.place.empty() ? entry.message : entry.place + ": " + entry.message;
            if (entry.count > 1) {
                line += " (and " + std::to_string(entry.count - 1) + " more)";
            }
            result.push_back(base::toOneLine(std::move(line)));
        }
        return result;
    }

  private:
    struct Entry {
        std::string message;
        std::string place;
        std::size_t count = 0;
    };
    std::vector<Entry> entries_;
    std::unordered_map<std::string, std::size_t> indexOf_;
};

}  // namespace fluxwalk::io
