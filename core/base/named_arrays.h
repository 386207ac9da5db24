#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

/// Flat arrays by name: what a file keeps, without a word about files.
namespace fluxwalk::base {

struct NamedArray {
    using Values = std::variant<std::vector<std::uint8_t>, std::vector<std::int8_t>,
                                std::vector<std::uint16_t>, std::vector<std::uint32_t>,
                                std::vector<std::uint64_t>, std::vector<float>, std::vector<double>>;

    std::string name;  ///< "group/array", of letters, digits and '-'
    Values values;     ///< row after row
    std::uint32_t columns = 1;
    std::string unit{};  ///< "lux", or empty

    /// Number of rows.
    std::size_t rows() const;
};

struct NamedArrays {
    std::string kind;           ///< what the arrays are together, "fluxwalk checkpoint"
    std::uint32_t version = 0;  ///< of that kind
    std::vector<NamedArray> arrays;

    const NamedArray* find(std::string_view name) const;
};

/// Looks arrays up that must be there as they are expected. Every failure is a base::FileError that names
/// `file` and the array.
class ArrayReader {
  public:
    ArrayReader(const NamedArrays& arrays, std::string file) : arrays_(arrays), file_(std::move(file)) {}

    /// Values of an array of this type and number of columns.
    template <class T>
    const std::vector<T>& values(const std::string& name, std::uint32_t columns = 1) const {
        const NamedArray& array = need(name);
        const auto* values = std::get_if<std::vector<T>>(&array.values);
        if (values == nullptr || array.columns != columns) {
            fail(name, "holds numbers of another kind");
        }
        return *values;
    }
    /// The same, with this many rows.
    template <class T>
    const std::vector<T>& values(const std::string& name, std::uint32_t columns, std::size_t rows) const {
        const std::vector<T>& values = this->values<T>(name, columns);
        if (values.size() != rows * columns) {
            failLength(name, values.size() / columns, rows);
        }
        return values;
    }
    /// The one value of an array.
    template <class T>
    T value(const std::string& name) const {
        return values<T>(name, 1, 1).front();
    }

    const std::string& file() const { return file_; }
    [[noreturn]] void fail(const std::string& name, const std::string& message) const;

  private:
    const NamedArray& need(const std::string& name) const;
    [[noreturn]] void failLength(const std::string& name, std::size_t rows, std::size_t expected) const;

    const NamedArrays& arrays_;
    std::string file_;
};

}  // namespace fluxwalk::base
