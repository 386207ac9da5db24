#include "core/io/sensors_csv.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>

#include "core/base/check.h"
#include "core/base/error.h"
#include "core/base/photometry.h"
#include "core/io/file.h"

namespace fluxwalk::io {

namespace {

constexpr std::array<std::string_view, 6> kColumns{"x", "y", "z", "nx", "ny", "nz"};

std::string_view trim(std::string_view text) {
    constexpr std::string_view kBlank = " \t\r";
    const std::size_t first = text.find_first_not_of(kBlank);
    if (first == std::string_view::npos) {
        return {};
    }
    return text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

// Cuts the text up to `separator` off its front.
std::string_view takeUntil(std::string_view& text, char separator) {
    const std::size_t end = text.find(separator);
    const std::string_view head = text.substr(0, end);
    text = end == std::string_view::npos ? std::string_view{} : text.substr(end + 1);
    return head;
}

class Reader {
  public:
    explicit Reader(const std::filesystem::path& file) : file_(file.string()) {}

    /// `withColumns`: what follows the normals, too.
    SensorTable read(std::string_view text, bool withColumns) {
        constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
        if (text.starts_with(kByteOrderMark)) {
            text.remove_prefix(kByteOrderMark.size());
        }
        withColumns_ = withColumns;
        bool hasHeader = false;
        while (!text.empty()) {
            ++line_;
            const std::string_view row = trim(takeUntil(text, '\n'));
            if (row.empty()) {
                continue;
            }
            if (hasHeader) {
                readRow(row);
            } else {
                readHeader(row);
                hasHeader = true;
            }
        }
        if (table_.sensors.empty()) {
            throw base::FileError(file_, "", "holds no sensors");
        }
        return std::move(table_);
    }

  private:
    [[noreturn]] void fail(const std::string& message) const {
        throw base::FileError(file_, "line " + std::to_string(line_), message);
    }

    void readHeader(std::string_view row) {
        for (const std::string_view column : kColumns) {
            if (trim(takeUntil(row, ',')) != column) {
                fail("the header must begin with x,y,z,nx,ny,nz");
            }
        }
        while (withColumns_ && !row.empty()) {
            table_.columns.push_back({std::string(trim(takeUntil(row, ','))), {}});
        }
    }

    void readRow(std::string_view row) {
        std::array<double, kColumns.size()> v{};
        for (std::size_t i = 0; i < v.size(); ++i) {
            if (row.empty()) {
                fail("has " + std::to_string(i) + " values, x,y,z,nx,ny,nz are needed");
            }
            v[i] = readNumber(trim(takeUntil(row, ',')), kColumns[i]);
        }
        const base::Vec3d normal(v[3], v[4], v[5]);
        // Scaled first, so that neither huge nor tiny normals leave the range of double.
        const double largest = std::max({std::abs(v[3]), std::abs(v[4]), std::abs(v[5])});
        if (largest == 0.0) {
            fail("the normal is zero");
        }
        table_.sensors.push_back({{v[0], v[1], v[2]}, glm::normalize(normal / largest)});
        for (SensorColumn& column : table_.columns) {
            if (row.empty()) {
                fail("has no value for " + column.name);
            }
            column.values.push_back(readNumber(trim(takeUntil(row, ',')), column.name));
        }
    }

    double readNumber(std::string_view text, std::string_view column) const {
        std::string_view digits = text;
        if (digits.starts_with('+')) {
            digits.remove_prefix(1);
        }
        double value = 0.0;
        const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
        if (error != std::errc{} || end != digits.data() + digits.size()) {
            fail(std::string(column) + " is not a number: '" + std::string(text) + "'");
        }
        if (!std::isfinite(value)) {
            fail(std::string(column) + " is not finite");
        }
        return value;
    }

    std::string file_;
    std::size_t line_ = 0;
    bool withColumns_ = false;
    SensorTable table_;
};

}  // namespace

std::optional<std::span<const double>> SensorTable::find(std::string_view name) const {
    for (const SensorColumn& column : columns) {
        if (column.name == name) {
            return column.values;
        }
    }
    return std::nullopt;
}

std::vector<scene::Sensor> readSensors(const std::filesystem::path& file) {
    const std::vector<std::uint8_t> bytes = readFile(file);
    return Reader(file).read({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, false).sensors;
}

SensorTable readSensorTable(const std::filesystem::path& file) {
    const std::vector<std::uint8_t> bytes = readFile(file);
    return Reader(file).read({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, true);
}

std::vector<SensorColumn> irradianceColumns(std::span<const base::Vec3d> irradiance) {
    std::vector<SensorColumn> columns{{"E_r", {}}, {"E_g", {}}, {"E_b", {}}, {"lux", {}}};
    for (const base::Vec3d& e : irradiance) {
        for (int c = 0; c < 3; ++c) {
            columns[static_cast<std::size_t>(c)].values.push_back(e[c]);
        }
        columns[3].values.push_back(base::luminance(e));
    }
    return columns;
}

void writeSensorTable(const std::filesystem::path& file, const SensorTable& table) {
    std::string text = "x,y,z,nx,ny,nz";
    for (const SensorColumn& column : table.columns) {
        FLUXWALK_CHECK_EQ(column.values.size(), table.sensors.size());
        text += ',' + column.name;
    }
    text.push_back('\n');
    const auto add = [&text](double value) {
        std::array<char, 32> buffer{};
        // to_chars, not printf: the decimal point must not follow the user's locale.
        const auto end =
            std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::general, 9);
        text.append(buffer.data(), end.ptr);
        text.push_back(',');
    };
    for (std::size_t i = 0; i < table.sensors.size(); ++i) {
        for (int c = 0; c < 3; ++c) {
            add(table.sensors[i].position[c]);
        }
        for (int c = 0; c < 3; ++c) {
            add(table.sensors[i].normal[c]);
        }
        for (const SensorColumn& column : table.columns) {
            add(column.values[i]);
        }
        text.back() = '\n';
    }
    writeFile(file, text);
}

}  // namespace fluxwalk::io
