#include "tests/bench/growth_plot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace fluxwalk::bench {

namespace {

/// Of one plot and the room around it, in pixels.
constexpr double kWidth = 400.0;
constexpr double kHeight = 280.0;
constexpr double kLeft = 70.0;
constexpr double kTop = 40.0;
constexpr double kBelow = 50.0;
constexpr double kBetween = 30.0;
constexpr std::array<const char*, 4> kColors{"#1b6ca8", "#c8553d", "#3c8d5a", "#7a5195"};

/// Whole decades that hold all values.
struct Decades {
    double first = std::numeric_limits<double>::infinity();
    double last = -std::numeric_limits<double>::infinity();

    void add(double value) {
        first = std::min(first, std::floor(std::log10(value)));
        last = std::max(last, std::ceil(std::log10(value)));
    }
    double placeOf(double value) const { return (std::log10(value) - first) / std::max(1.0, last - first); }
};

std::string formatDecade(double decade) {
    if (decade >= 6.0) {
        return fmt::format("{:g} M", std::pow(10.0, decade - 6.0));
    }
    return decade >= 3.0 ? fmt::format("{:g} k", std::pow(10.0, decade - 3.0))
                         : fmt::format("{:g}", std::pow(10.0, decade));
}

std::string drawAxes(const Plot& plot, const Decades& x, const Decades& y) {
    std::string svg = fmt::format(
        "<text x='{:g}' y='-14' text-anchor='middle' font-size='14'>{}</text>\n"
        "<text x='{:g}' y='{:g}' text-anchor='middle'>{}</text>\n"
        "<text transform='translate(-52 {:g}) rotate(-90)' text-anchor='middle'>{}</text>\n",
        0.5 * kWidth, plot.title, 0.5 * kWidth, kHeight + 38.0, plot.xName, 0.5 * kHeight, plot.yName);
    for (double decade = x.first; decade <= x.last; ++decade) {
        const double at = kWidth * x.placeOf(std::pow(10.0, decade));
        svg += fmt::format(
            "<path d='M{0:g} 0V{1:g}' stroke='#ddd'/><text x='{0:g}' y='{2:g}' "
            "text-anchor='middle'>{3}</text>\n",
            at, kHeight, kHeight + 18.0, formatDecade(decade));
    }
    for (double decade = y.first; decade <= y.last; ++decade) {
        const double at = kHeight * (1.0 - y.placeOf(std::pow(10.0, decade)));
        svg += fmt::format(
            "<path d='M0 {0:g}H{1:g}' stroke='#ddd'/><text x='-8' y='{2:g}' text-anchor='end'>{3}</text>\n",
            at, kWidth, at + 4.0, formatDecade(decade));
    }
    return svg +
           fmt::format("<rect width='{:g}' height='{:g}' fill='none' stroke='#888'/>\n", kWidth, kHeight);
}

std::string drawPlot(const Plot& plot) {
    Decades x;
    Decades y;
    for (const PlotLine& line : plot.lines) {
        std::for_each(line.x.begin(), line.x.end(), [&](double value) { x.add(value); });
        std::for_each(line.y.begin(), line.y.end(), [&](double value) { y.add(value); });
    }
    if (!std::isfinite(x.first)) {
        return {};
    }
    std::string svg = drawAxes(plot, x, y);
    for (std::size_t l = 0; l < plot.lines.size(); ++l) {
        const PlotLine& line = plot.lines[l];
        const char* color = kColors[l % kColors.size()];
        std::string path;
        for (std::size_t i = 0; i < line.x.size(); ++i) {
            const double px = kWidth * x.placeOf(line.x[i]);
            const double py = kHeight * (1.0 - y.placeOf(line.y[i]));
            path += fmt::format("{}{:.1f} {:.1f}", i == 0 ? 'M' : 'L', px, py);
            svg += fmt::format("<circle cx='{:.1f}' cy='{:.1f}' r='3.5' fill='{}'/>\n", px, py, color);
        }
        const double exponent = fitExponent(line);
        const std::string slope = std::isfinite(exponent) ? fmt::format(", n^{:.2f}", exponent) : "";
        svg += fmt::format(
            "<path d='{}' fill='none' stroke='{}' stroke-width='2'/>\n"
            "<text x='12' y='{:g}' fill='{}'>{}{}</text>\n",
            path, color, 20.0 + 18.0 * static_cast<double>(l), color, line.name, slope);
    }
    return svg;
}

}  // namespace

double fitExponent(const PlotLine& line) {
    double sx = 0.0;
    double sy = 0.0;
    double sxx = 0.0;
    double sxy = 0.0;
    const auto n = static_cast<double>(line.x.size());
    for (std::size_t i = 0; i < line.x.size(); ++i) {
        const double x = std::log(line.x[i]);
        const double y = std::log(line.y[i]);
        sx += x;
        sy += y;
        sxx += x * x;
        sxy += x * y;
    }
    const double spread = n * sxx - sx * sx;
    return spread > 1e-9 ? (n * sxy - sx * sy) / spread : std::numeric_limits<double>::quiet_NaN();
}

std::string drawPlots(const std::vector<Plot>& plots) {
    const double each = kLeft + kWidth + kBetween;
    const double width = each * static_cast<double>(plots.size());
    const double height = kTop + kHeight + kBelow;
    std::string svg = fmt::format(
        "<svg xmlns='http://www.w3.org/2000/svg' width='{0:g}' height='{1:g}' viewBox='0 0 {0:g} {1:g}' "
        "font-family='sans-serif' font-size='12'>\n<rect width='100%' height='100%' fill='white'/>\n",
        width, height);
    for (std::size_t i = 0; i < plots.size(); ++i) {
        svg += fmt::format("<g transform='translate({:g} {:g})'>\n{}</g>\n",
                           kLeft + each * static_cast<double>(i), kTop, drawPlot(plots[i]));
    }
    return svg + "</svg>\n";
}

}  // namespace fluxwalk::bench
