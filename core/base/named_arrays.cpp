#include "core/base/named_arrays.h"

#include "core/base/error.h"

namespace fluxwalk::base {

std::size_t NamedArray::rows() const {
    return std::visit([this](const auto& all) { return all.size() / columns; }, values);
}

const NamedArray* NamedArrays::find(std::string_view name) const {
    for (const NamedArray& array : arrays) {
        if (array.name == name) {
            return &array;
        }
    }
    return nullptr;
}

void ArrayReader::fail(const std::string& name, const std::string& message) const {
    throw FileError(file_, name, message);
}

void ArrayReader::failLength(const std::string& name, std::size_t rows, std::size_t expected) const {
    fail(name, "has " + std::to_string(rows) + " rows in place of " + std::to_string(expected));
}

const NamedArray& ArrayReader::need(const std::string& name) const {
    const NamedArray* array = arrays_.find(name);
    if (array == nullptr) {
        fail(name, "is missing");
    }
    return *array;
}

}  // namespace fluxwalk::base
