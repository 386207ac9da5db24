#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

namespace fluxwalk::test {

/// Mean and standard error of independent values.
class Sample {
  public:
    void add(double value) {
        ++count_;
        const double step = value - mean_;
        mean_ += step / static_cast<double>(count_);
        squares_ += step * (value - mean_);
    }
    std::size_t count() const { return count_; }
    double mean() const { return mean_; }
    double deviation() const { return count_ > 1 ? std::sqrt(squares_ / static_cast<double>(count_ - 1)) : 0.0; }
    double standardError() const { return deviation() / std::sqrt(static_cast<double>(count_)); }

  private:
    std::size_t count_ = 0;
    double mean_ = 0.0;
    double squares_ = 0.0;
};

/// Value below which a part of all values lies.
inline double quantile(std::vector<double> values, double part) {
    const auto at = static_cast<std::size_t>(part * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(at), values.end());
    return values[at];
}

}  // namespace fluxwalk::test
