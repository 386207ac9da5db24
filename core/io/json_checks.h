#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>

#include <nlohmann/json.hpp>

#include "core/base/error.h"

namespace fluxwalk::io {

/// Elementary checks of a glTF document; each throws base::FileError with a JSON pointer.
class JsonChecks {
  public:
    using json = nlohmann::json;

    /// `root` must outlive this.
    JsonChecks(std::string file, const json& root) : file_(std::move(file)), root_(root) {}

    [[noreturn]] void fail(const std::string& place, const std::string& message) const {
        throw base::FileError(file_, place, message);
    }

    /// Visits the objects of an optional array.
    template <class Visit>
    void forEach(const json& owner, const char* key, const std::string& place, const Visit& visit) const {
        const auto found = owner.find(key);
        if (found == owner.end()) {
            return;
        }
        const std::string arrayPlace = place + "/" + key;
        if (!found->is_array()) {
            fail(arrayPlace, "is not an array");
        }
        std::size_t i = 0;
        for (const json& item : *found) {
            const std::string itemPlace = arrayPlace + "/" + std::to_string(i++);
            if (!item.is_object()) {
                fail(itemPlace, "is not an object");
            }
            visit(item, itemPlace);
        }
    }

    /// Number of items of a section of the document.
    std::uint64_t sizeOf(const char* section) const {
        const auto found = root_.find(section);
        return found == root_.end() ? 0 : found->size();
    }

    /// `value` must be the index of an item of `section`.
    void checkTarget(const json& value, const char* section, const std::string& place) const {
        if (!value.is_number_unsigned()) {
            fail(place, "is not an index");
        }
        if (value.get<std::uint64_t>() >= sizeOf(section)) {
            fail(place, "index " + value.dump() + " is out of range: there are " +
                            std::to_string(sizeOf(section)) + " " + section);
        }
    }

    /// The same for an optional member.
    void checkIndex(const json& owner, const char* key, const char* section, const std::string& place) const {
        if (const auto found = owner.find(key); found != owner.end()) {
            checkTarget(*found, section, place + "/" + key);
        }
    }

    /// The same for an optional array of indices.
    void checkIndices(const json& owner, const char* key, const char* section,
                      const std::string& place) const {
        const auto found = owner.find(key);
        if (found == owner.end()) {
            return;
        }
        const std::string arrayPlace = place + "/" + key;
        if (!found->is_array()) {
            fail(arrayPlace, "is not an array");
        }
        for (std::size_t i = 0; i < found->size(); ++i) {
            checkTarget((*found)[i], section, arrayPlace + "/" + std::to_string(i));
        }
    }

    /// A whole number within [least, most]; `fallback` where the key is absent.
    std::uint64_t count(const json& owner, const char* key, const std::string& place, std::uint64_t fallback,
                        std::uint64_t least, std::uint64_t most) const {
        const auto found = owner.find(key);
        if (found == owner.end()) {
            return fallback;
        }
        if (!found->is_number_unsigned() || found->get<std::uint64_t>() < least ||
            found->get<std::uint64_t>() > most) {
            fail(place + "/" + key, found->dump() + " is not a whole number from " + std::to_string(least) +
                                        " to " + std::to_string(most));
        }
        return found->get<std::uint64_t>();
    }

    void require(const json& owner, const char* key, const std::string& place) const {
        if (!owner.contains(key)) {
            fail(place, std::string("has no ") + key);
        }
    }

    /// An optional array of `length` numbers.
    void checkNumbers(const json& owner, const char* key, std::size_t length,
                      const std::string& place) const {
        const auto found = owner.find(key);
        if (found == owner.end()) {
            return;
        }
        const bool isRight =
            found->is_array() && found->size() == length &&
            std::all_of(found->begin(), found->end(), [](const json& v) { return v.is_number(); });
        if (!isRight) {
            fail(place + "/" + key, "is not an array of " + std::to_string(length) + " numbers");
        }
    }

    const json& root() const { return root_; }

  private:
    std::string file_;
    const json& root_;
};

}  // namespace fluxwalk::io
