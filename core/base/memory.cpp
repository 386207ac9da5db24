#include "core/base/memory.h"

#include <algorithm>
#include <fstream>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

namespace fluxwalk::base {

namespace {

// The value of "NAME:   123 kB" in a file of such lines.
std::uint64_t readEntry(const char* file, std::string_view name) {
    std::ifstream stream(file);
    std::string key;
    while (stream >> key) {
        std::uint64_t kibibytes = 0;
        if (key == name && stream >> kibibytes) {
            return kibibytes * 1024;
        }
        stream.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
    }
    return 0;
}

// The one number of a file; nothing where it says "max" or is not there.
std::optional<std::uint64_t> readNumber(const std::string& file) {
    std::ifstream stream(file);
    std::uint64_t value = 0;
    return stream >> value ? std::optional(value) : std::nullopt;
}

}  // namespace

std::uint64_t residentMemory() {
    return readEntry("/proc/self/status", "VmRSS:");
}

std::uint64_t peakMemory() {
    return readEntry("/proc/self/status", "VmHWM:");
}

std::uint64_t availableMemory() {
    std::uint64_t available = readEntry("/proc/meminfo", "MemAvailable:");
    // Containers mount their own control group at the root.
    const std::string group = "/sys/fs/cgroup/memory";
    const auto most = readNumber(group + ".max");
    const auto used = readNumber(group + ".current");
    if (most && used) {
        available = std::min(available, *most - std::min(*most, *used));
    }
    return available;
}

}  // namespace fluxwalk::base
