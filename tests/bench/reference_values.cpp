#include "tests/bench/reference_values.h"

#include <array>
#include <charconv>
#include <string>
#include <string_view>

#include "core/base/error.h"
#include "core/hierarchy/reach.h"
#include "core/io/file.h"
#include "core/io/sensors_csv.h"
#include "core/reference/path_tracer.h"
#include "core/reference/random_sensors.h"

namespace fluxwalk::bench {

namespace {

constexpr std::string_view kHeader = "x,y,z,nx,ny,nz,E_r,E_g,E_b,se_r,se_g,se_b\n";
constexpr std::size_t kFirstValue = 6;
constexpr std::size_t kColumns = 12;
constexpr std::uint64_t kSeed = 1;

// What a ray along the normal meets first from under a solid is the inside of that solid.
bool isHidden(const rays::RayScene& rays, const hierarchy::ReachedSides& reached, const scene::Sensor& s) {
    const auto hit = rays.closest(rays.halfLine(s.position, s.normal, s.normal));
    return hit && !reached.isReached(base::index(hit->object), hit->back);
}

// Shortest text that reads back as this number of digits.
void append(std::string& text, double value, int digits, char separator) {
    std::array<char, 32> buffer{};
    const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value,
                                   std::chars_format::general, digits);
    text.append(buffer.data(), end.ptr);
    text.push_back(separator);
}

std::string_view takeUntil(std::string_view& text, char separator) {
    const std::size_t end = text.find(separator);
    const std::string_view head = text.substr(0, end);
    text = end == std::string_view::npos ? std::string_view{} : text.substr(end + 1);
    return head;
}

}  // namespace

double meanIrradiance(std::span<const ReferencePoint> points) {
    double sum = 0.0;
    for (const ReferencePoint& p : points) {
        sum += p.irradiance.x + p.irradiance.y + p.irradiance.z;
    }
    return sum / (3.0 * static_cast<double>(points.size()));
}

double noiseSquare(std::span<const ReferencePoint> points) {
    double sum = 0.0;
    for (const ReferencePoint& p : points) {
        sum += glm::dot(p.standardError, p.standardError);
    }
    return sum / (3.0 * static_cast<double>(points.size()));
}

Reference traceReference(const scene::Scene& scene, std::uint64_t paths, unsigned threads) {
    SensorGroup all{{}, reference::kBenchmarkSensors};
    for (std::uint32_t object = 0; object < scene.objects.size(); ++object) {
        all.objects.push_back(object);
    }
    return traceReference(scene, paths, threads, std::span(&all, 1));
}

Reference traceReference(const scene::Scene& scene, std::uint64_t paths, unsigned threads,
                         std::span<const SensorGroup> groups) {
    const base::Executor executor(threads);
    const rays::RayScene rays(scene, executor);
    const hierarchy::ReachedSides reached = hierarchy::findReachedSides(scene, rays, executor, kSeed);
    Reference result;
    std::vector<scene::Sensor> sensors;
    for (const SensorGroup& group : groups) {
        std::vector<reference::ObjectSide> sides;
        for (const std::uint32_t object : group.objects) {
            for (const bool back : {false, true}) {
                if (reached.isReached(object, back)) {
                    sides.push_back({object, back});
                }
            }
        }
        for (const scene::Sensor& s :
             reference::randomSensors(scene, sides, group.count, reference::kBenchmarkSeed)) {
            if (isHidden(rays, reached, s)) {
                ++result.hiddenCount;
            } else {
                sensors.push_back(s);
            }
        }
    }
    const reference::PathResult traced =
        reference::traceIrradiance(scene, rays, executor, sensors, {kSeed, paths});
    for (std::size_t i = 0; i < sensors.size(); ++i) {
        const reference::Estimate& e = traced.irradiance[i];
        result.points.push_back({sensors[i], e.mean, e.standardError});
    }
    return result;
}

void writeReference(const std::filesystem::path& file, const Reference& reference) {
    std::string text(kHeader);
    for (const ReferencePoint& p : reference.points) {
        for (int c = 0; c < 3; ++c) {
            append(text, p.sensor.position[c], 9, ',');
        }
        for (int c = 0; c < 3; ++c) {
            append(text, p.sensor.normal[c], 9, ',');
        }
        for (int c = 0; c < 3; ++c) {
            append(text, p.irradiance[c], 7, ',');
        }
        for (int c = 0; c < 3; ++c) {
            append(text, p.standardError[c], 3, c == 2 ? '\n' : ',');
        }
    }
    io::writeFile(file, text);
}

Reference readReference(const std::filesystem::path& file) {
    const std::vector<std::uint8_t> bytes = io::readFile(file);
    std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (!text.starts_with(kHeader)) {
        throw base::FileError(file.string(), "line 1", "is not the header of a reference");
    }
    text.remove_prefix(kHeader.size());
    Reference result;
    for (const scene::Sensor& sensor : io::readSensors(file)) {
        std::string_view row = takeUntil(text, '\n');
        ReferencePoint point{sensor, {}, {}};
        for (std::size_t i = 0; i < kColumns; ++i) {
            const std::string_view cell = takeUntil(row, ',');
            if (i < kFirstValue) {
                continue;
            }
            double value = 0.0;
            const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
            if (error != std::errc{} || end != cell.data() + cell.size()) {
                throw base::FileError(file.string(), "line " + std::to_string(result.points.size() + 2),
                                      "'" + std::string(cell) + "' is not a number");
            }
            const auto channel = static_cast<int>((i - kFirstValue) % 3);
            (i < kFirstValue + 3 ? point.irradiance : point.standardError)[channel] = value;
        }
        result.points.push_back(point);
    }
    if (result.points.size() > reference::kBenchmarkSensors) {
        throw base::FileError(file.string(), "", "holds more than the benchmark sensors");
    }
    result.hiddenCount = reference::kBenchmarkSensors - result.points.size();
    return result;
}

}  // namespace fluxwalk::bench
