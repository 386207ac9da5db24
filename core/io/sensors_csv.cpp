#include "core/io/sensors_csv.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string>
#include <string_view>

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

    std::vector<scene::Sensor> read(std::string_view text) {
        constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
        if (text.starts_with(kByteOrderMark)) {
            text.remove_prefix(kByteOrderMark.size());
        }
        std::vector<scene::Sensor> sensors;
        bool hasHeader = false;
        while (!text.empty()) {
            ++line_;
            const std::string_view row = trim(takeUntil(text, '\n'));
            if (row.empty()) {
                continue;
            }
            if (hasHeader) {
                sensors.push_back(readRow(row));
            } else {
                readHeader(row);
                hasHeader = true;
            }
        }
        if (sensors.empty()) {
            throw base::FileError(file_, "", "holds no sensors");
        }
        return sensors;
    }

  private:
    [[noreturn]] void fail(const std::string& message) const {
        throw base::FileError(file_, "line " + std::to_string(line_), message);
    }

    void readHeader(std::string_view row) const {
        for (const std::string_view column : kColumns) {
            if (trim(takeUntil(row, ',')) != column) {
                fail("the header must begin with x,y,z,nx,ny,nz");
            }
        }
    }

    scene::Sensor readRow(std::string_view row) const {
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
        return {{v[0], v[1], v[2]}, glm::normalize(normal / largest)};
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
};

}  // namespace

std::vector<scene::Sensor> readSensors(const std::filesystem::path& file) {
    const std::vector<std::uint8_t> bytes = readFile(file);
    return Reader(file).read({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

void writeSensors(const std::filesystem::path& file, std::span<const scene::Sensor> sensors,
                  std::span<const base::Rgb> irradiance) {
    FLUXWALK_CHECK_EQ(sensors.size(), irradiance.size());
    std::string text = "x,y,z,nx,ny,nz,E_r,E_g,E_b,lux\n";
    const auto add = [&text](double value, char separator) {
        std::array<char, 32> buffer{};
        // to_chars, not printf: the decimal point must not follow the user's locale.
        const auto end =
            std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::general, 9);
        text.append(buffer.data(), end.ptr);
        text.push_back(separator);
    };
    for (std::size_t i = 0; i < sensors.size(); ++i) {
        for (int c = 0; c < 3; ++c) {
            add(sensors[i].position[c], ',');
        }
        for (int c = 0; c < 3; ++c) {
            add(sensors[i].normal[c], ',');
        }
        for (int c = 0; c < 3; ++c) {
            add(static_cast<double>(irradiance[i][c]), ',');
        }
        add(base::luminance(base::Vec3d(irradiance[i])), '\n');
    }
    writeFile(file, text);
}

}  // namespace fluxwalk::io
