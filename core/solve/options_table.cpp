#include "core/solve/options_table.h"

#include <charconv>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "core/base/error.h"

namespace fluxwalk::solve {

namespace {

constexpr double kLargestInteger = 0x1.0p53;
/// Less than the program alone takes.
constexpr double kLeastMemory = 0x1.0p20;
constexpr std::string_view kByteUnits = "KMGT";

std::vector<OptionInfo> makeTable() {
    std::vector<OptionInfo> table;
    table.push_back(
        {.name = "error",
         .kind = OptionKind::fraction,
         .unit = "%",
         .minimum = 1e-4,
         .maximum = 1.0,
         .explanation =
             "Requested error: root mean square of E - E* over all lit sides, as a part of the "
             "mean illuminance. Halving it takes several times the work. Turned up while solving, links "
             "go back to where they reached it.",
         .get = [](const Options& o) { return o.error; },
         .set = [](Options& o, double value) { o.error = value; }});
    table.push_back(
        {.name = "oracle",
         .kind = OptionKind::choice,
         .minimum = 0.0,
         .maximum = 3.0,
         .choices = {"bounded", "bfa", "bf", "strict"},
         .explanation =
             "What decides that a link is fine enough: 'bounded' weighs the spread of kernel, "
             "visibility and radiosity by power; 'bfa' the transferred power; 'bf' the "
             "transferred illuminance; 'strict' takes certain bounds of kernel, visibility and "
             "radiosity instead of samples: many times the work. Turned while solving, links are made anew "
             "with the light there is.",
         .get = [](const Options& o) { return static_cast<double>(o.oracle); },
         .set = [](Options& o, double value) { o.oracle = static_cast<OracleKind>(value); }});
    table.push_back({.name = "threshold",
                     .unit = "lux",
                     .minimum = 0.0,
                     .maximum = 1e9,
                     .zero = "automatic",
                     .explanation = "Largest error of one link; automatic lowers it until the requested "
                                    "error is reached. Turned down "
                                    "while solving, refinement goes on from where it is; turned up to more "
                                    "than twice, links are taken "
                                    "back.",
                     .get = [](const Options& o) { return o.threshold; },
                     .set = [](Options& o, double value) { o.threshold = value; }});
    table.push_back(
        {.name = "curvature-weight",
         .unit = "times",
         .minimum = 0.0,
         .maximum = 16.0,
         .zero = "off",
         .explanation = "How much the spread of the normals over a curved element counts in the oracle "
                        "'bounded': more refines curved objects further. Planar scenes do not change. Turned "
                        "while solving, links are judged again.",
         .get = [](const Options& o) { return o.curvatureWeight; },
         .set = [](Options& o, double value) { o.curvatureWeight = value; }});
    table.push_back({.name = "min-area",
                     .unit = "m2",
                     .minimum = 0.0,
                     .maximum = 1e9,
                     .zero = "automatic",
                     .explanation =
                         "Elements below this area are not split; automatic is 1e-7 of the scene's area. "
                         "Turned up while solving, smaller ones go.",
                     .get = [](const Options& o) { return o.minArea; },
                     .set = [](Options& o, double value) { o.minArea = value; }});
    table.push_back(
        {.name = "pull",
         .kind = OptionKind::choice,
         .minimum = 0.0,
         .maximum = 1.0,
         .choices = {"true-area", "projected"},
         .explanation =
             "How radiosity is averaged on curved surfaces: 'true-area' conserves power; 'projected' "
             "weighs by the area projected on the parent's normal, which does not: for comparison.",
         .get = [](const Options& o) { return static_cast<double>(o.pullRule); },
         .set = [](Options& o, double value) { o.pullRule = static_cast<PullRule>(value); }});
    table.push_back({.name = "row-scaling",
                     .kind = OptionKind::flag,
                     .maximum = 1.0,
                     .explanation =
                         "In closed scenes, scale the coefficients symmetrically until every row sums to 1, "
                         "by 5 % at most. The audit counts what it changes.",
                     .get = [](const Options& o) { return o.rowScaling ? 1.0 : 0.0; },
                     .set = [](Options& o, double value) { o.rowScaling = value != 0.0; }});
    table.push_back(
        {.name = "display-angle",
         .unit = "degrees",
         .minimum = 0.25,
         .maximum = 90.0,
         .explanation =
             "Curved surfaces are shown by triangles whose true normals lie within this angle of a "
             "common axis: smaller makes silhouettes rounder, without solving anew.",
         .get = [](const Options& o) { return o.displayAngle; },
         .set = [](Options& o, double value) { o.displayAngle = value; }});
    table.push_back(
        {.name = "display",
         .kind = OptionKind::choice,
         .minimum = 0.0,
         .maximum = 1.0,
         .choices = {"interpolate", "gather"},
         .explanation =
             "Light of the displayed mesh, in the window, in its pictures and in lit files: 'interpolate' is "
             "smooth between the elements and costs nothing; 'gather' finds it at each vertex by rays and "
             "cuts the mesh finer where it changes, so that shadows are sharp.",
         .get = [](const Options& o) { return static_cast<double>(o.display); },
         .set = [](Options& o, double value) { o.display = static_cast<DisplayLight>(value); }});
    table.push_back(
        {.name = "clusters",
         .kind = OptionKind::choice,
         .minimum = 0.0,
         .maximum = 2.0,
         .choices = {"sah", "hybrid", "embree"},
         .explanation =
             "How the hierarchy above the patches is built: 'sah' weighs surface, number and the spread of "
             "normals; 'hybrid' surface and number, with regular grids where a region is evenly filled; "
             "'embree' takes Embree's tree over boxes. Turned while solving, the solve begins anew.",
         .get = [](const Options& o) { return static_cast<double>(o.clusters); },
         .set = [](Options& o, double value) { o.clusters = static_cast<TreeBuilder>(value); }});
    table.push_back(
        {.name = "cluster-links",
         .kind = OptionKind::choice,
         .minimum = 0.0,
         .maximum = 2.0,
         .choices = {"auto", "on", "off"},
         .explanation =
             "Whether links may end at clusters: 'auto' in scenes of more than 2,000 patches. 'off' links "
             "all "
             "pairs of patches that see each other: the work grows with the square of their number.",
         .get = [](const Options& o) { return static_cast<double>(o.clusterLinks); },
         .set = [](Options& o, double value) { o.clusterLinks = static_cast<ClusterLinks>(value); }});
    table.push_back(
        {.name = "cluster-model",
         .kind = OptionKind::choice,
         .minimum = 0.0,
         .maximum = 1.0,
         .choices = {"oriented", "isotropic"},
         .explanation =
             "What links take clusters for: 'oriented' shares light among the surfaces by their directions "
             "and asks rays what they see; 'isotropic' takes them for fog that sends and receives alike in "
             "all directions: a cheaper approximation, for comparison. Turned while solving, the solve "
             "begins anew.",
         .get = [](const Options& o) { return static_cast<double>(o.clusterModel); },
         .set = [](Options& o, double value) { o.clusterModel = static_cast<ClusterModel>(value); }});
    table.push_back(
        {.name = "visibility-rays",
         .kind = OptionKind::choice,
         .minimum = 0.0,
         .maximum = 2.0,
         .choices = {"16", "64", "256"},
         .explanation =
             "Rays that tell how much two elements see of each other. Fewer are faster and miss thin beams "
             "and shadows; more make penumbrae cleaner. Turned while solving, the solve begins anew.",
         .get = [](const Options& o) { return static_cast<double>(o.visibilityRays); },
         .set = [](Options& o, double value) { o.visibilityRays = static_cast<RayCount>(value); }});
    table.push_back(
        {.name = "rays",
         .kind = OptionKind::choice,
         .minimum = 0.0,
         .maximum = 1.0,
         .choices = {"embree", "clusters"},
         .explanation =
             "What answers rays of visibility: Embree, or the same kind of tree as the clusters. "
             "Both meet the original objects; Embree is faster. Turned while solving, the solve begins "
             "anew.",
         .get = [](const Options& o) { return static_cast<double>(o.rays); },
         .set = [](Options& o, double value) { o.rays = static_cast<RayEngine>(value); }});
    table.push_back(
        {.name = "seed",
         .kind = OptionKind::integer,
         .minimum = 0.0,
         .maximum = kLargestInteger,
         .explanation = "Seed of all random numbers: same seed, same result, on any number of threads.",
         .get = [](const Options& o) { return static_cast<double>(o.seed); },
         .set = [](Options& o, double value) { o.seed = static_cast<std::uint64_t>(value); }});
    table.push_back({.name = "time-limit",
                     .unit = "s",
                     .minimum = 0.0,
                     .maximum = 1e9,
                     .zero = "none",
                     .explanation = "Stop after this time and keep what is solved.",
                     .get = [](const Options& o) { return o.timeLimit; },
                     .set = [](Options& o, double value) { o.timeLimit = value; }});
    table.push_back(
        {.name = "link-limit",
         .kind = OptionKind::integer,
         .minimum = 0.0,
         .maximum = 4e9,
         .zero = "none",
         .explanation = "Make no more links than this: those with the largest errors are refined first, and "
                        "what error was reached is reported.",
         .get = [](const Options& o) { return static_cast<double>(o.linkLimit); },
         .set = [](Options& o, double value) { o.linkLimit = static_cast<std::uint64_t>(value); }});
    table.push_back(
        {.name = "memory-limit",
         .kind = OptionKind::bytes,
         .minimum = 0.0,
         .maximum = kLargestInteger,
         .zero = "automatic",
         .explanation = "Let the program take no more memory than this, largest errors first; automatic is "
                        "three quarters of what the machine has left.",
         .get = [](const Options& o) { return static_cast<double>(o.memoryLimit); },
         .set = [](Options& o, double value) { o.memoryLimit = static_cast<std::uint64_t>(value); }});
    return table;
}

/// A finite number that fills the whole text; std::from_chars knows no locale.
std::optional<double> parseNumber(std::string_view text) {
    double value = 0.0;
    const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (failure != std::errc{} || end != text.data() + text.size() || !std::isfinite(value)) {
        return std::nullopt;
    }
    return value;
}

[[noreturn]] void rejectValue(const OptionInfo& option, std::string_view text, std::string_view hint = {}) {
    throw base::UsageError(
        fmt::format("--{}: '{}' is not {}{}", option.name, text, describeRange(option), hint));
}

double parseChoice(const OptionInfo& option, std::string_view text) {
    for (std::size_t i = 0; i < option.choices.size(); ++i) {
        if (option.choices[i] == text) {
            return static_cast<double>(i);
        }
    }
    rejectValue(option, text);
}

double parseFraction(const OptionInfo& option, std::string_view text) {
    std::string_view digits = text;
    const bool isPercent = digits.ends_with('%');
    if (isPercent) {
        digits.remove_suffix(1);
        while (digits.ends_with(' ')) {
            digits.remove_suffix(1);
        }
    }
    const std::optional<double> number = parseNumber(digits);
    if (!number) {
        rejectValue(option, text);
    }
    const double value = isPercent ? *number / 100.0 : *number;
    if (value >= option.minimum && value <= option.maximum) {
        return value;
    }
    if (!isPercent && value > option.maximum && value / 100.0 <= option.maximum) {
        rejectValue(option, text, fmt::format("; did you mean {}%?", digits));
    }
    rejectValue(option, text);
}

// Bytes with an optional K, M, G or T, each 1024 times the one before, and an optional "B" or "iB" behind.
double parseBytes(const OptionInfo& option, std::string_view text) {
    std::string_view digits = text;
    double unit = 1.0;
    if (digits.ends_with("iB")) {
        digits.remove_suffix(2);
    } else if (digits.ends_with('B')) {
        digits.remove_suffix(1);
    }
    const std::size_t power = digits.empty() ? std::string_view::npos : kByteUnits.find(digits.back());
    if (power != std::string_view::npos) {
        digits.remove_suffix(1);
        unit = std::exp2(10.0 * static_cast<double>(power + 1));
        while (digits.ends_with(' ')) {
            digits.remove_suffix(1);
        }
    }
    const std::optional<double> number = parseNumber(digits);
    if (!number) {
        rejectValue(option, text);
    }
    const double value = std::floor(*number * unit);
    if (value != 0.0 && !(value >= kLeastMemory && value <= option.maximum)) {
        const bool isBare = digits.size() == text.size() && value > 0.0 && value < kLeastMemory;
        rejectValue(option, text, isBare ? fmt::format("; did you mean {}G?", text) : "");
    }
    return value;
}

std::string formatBytes(double value) {
    std::size_t power = 0;
    for (; power < kByteUnits.size() && value >= 1024.0; ++power) {
        value /= 1024.0;
    }
    return power == 0 ? fmt::format("{:.17g}", value)
                      : fmt::format("{:.17g}{}", value, kByteUnits[power - 1]);
}

}  // namespace

std::span<const OptionInfo> optionsTable() {
    static const std::vector<OptionInfo> kTable = makeTable();
    return kTable;
}

const OptionInfo* findOption(std::string_view name) {
    for (const OptionInfo& option : optionsTable()) {
        if (option.name == name) {
            return &option;
        }
    }
    return nullptr;
}

double parseOption(const OptionInfo& option, std::string_view text) {
    if (option.kind == OptionKind::choice) {
        return parseChoice(option, text);
    }
    if (option.kind == OptionKind::fraction) {
        return parseFraction(option, text);
    }
    if (option.kind == OptionKind::bytes) {
        return parseBytes(option, text);
    }
    const std::optional<double> value = parseNumber(text);
    const bool isWhole = value && *value == std::floor(*value);
    if (!value || *value < option.minimum || *value > option.maximum ||
        (option.kind != OptionKind::quantity && !isWhole)) {
        rejectValue(option, text);
    }
    return *value;
}

std::string formatOption(const OptionInfo& option, double value) {
    if (value == 0.0 && !option.zero.empty()) {
        return std::string(option.zero);
    }
    switch (option.kind) {
        case OptionKind::fraction:
            return fmt::format("{:g} %", value * 100.0);
        case OptionKind::choice:
            return std::string(option.choices[static_cast<std::size_t>(value)]);
        case OptionKind::flag:
            return value != 0.0 ? "on" : "off";
        case OptionKind::integer:
            return fmt::format("{:.0f}", value);
        case OptionKind::bytes:
            return formatBytes(value);
        case OptionKind::quantity:
            break;
    }
    return option.unit.empty() ? fmt::format("{:g}", value) : fmt::format("{:g} {}", value, option.unit);
}

std::string describeRange(const OptionInfo& option) {
    switch (option.kind) {
        case OptionKind::flag:
            return {};
        case OptionKind::choice: {
            std::string text;
            for (std::size_t i = 0; i < option.choices.size(); ++i) {
                text += i == 0 ? "" : i + 1 == option.choices.size() ? " or " : ", ";
                text += option.choices[i];
            }
            return text;
        }
        case OptionKind::integer:
            return fmt::format("a whole number from {:.0f} to {:.0f}", option.minimum, option.maximum);
        case OptionKind::bytes:
            return fmt::format("bytes from {} on, as 512M or 4G", formatBytes(kLeastMemory));
        case OptionKind::fraction:
            return fmt::format("{:g} % to {:g} %", option.minimum * 100.0, option.maximum * 100.0);
        case OptionKind::quantity:
            break;
    }
    return fmt::format("{:g} to {:g} {}", option.minimum, option.maximum, option.unit);
}

}  // namespace fluxwalk::solve
