#pragma once

#include <string>
#include <vector>

namespace fluxwalk::bench {

/// Points of one line of a plot; all values above 0.
struct PlotLine {
    std::string name;
    std::vector<double> x;
    std::vector<double> y;
};

struct Plot {
    std::string title;
    std::string xName;
    std::string yName;
    std::vector<PlotLine> lines;
};

/// Slope of the least-squares line through the logarithms: the exponent with which y grows. Not a number
/// with fewer than two different x.
double fitExponent(const PlotLine& line);

/// Plots side by side as one SVG picture, both axes logarithmic.
std::string drawPlots(const std::vector<Plot>& plots);

}  // namespace fluxwalk::bench
