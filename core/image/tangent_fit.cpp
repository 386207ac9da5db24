#include "core/image/tangent_fit.h"

#include <algorithm>
#include <cmath>

namespace fluxwalk::image {

namespace {

using base::kLanes;
using base::Lanes;
using base::Lanes3;

// Solves the symmetric system m x = y in place; m is well conditioned by its ridge.
void solveSystem(std::array<std::array<double, kTerms>, kTerms> m,
                 std::array<std::array<double, kLanes>, kTerms>& y) {
    for (std::size_t i = 0; i < kTerms; ++i) {
        for (std::size_t j = i + 1; j < kTerms; ++j) {
            const double factor = m[j][i] / m[i][i];
            for (std::size_t k = i; k < kTerms; ++k) {
                m[j][k] -= factor * m[i][k];
            }
            for (std::size_t k = 0; k < kLanes; ++k) {
                y[j][k] -= factor * y[i][k];
            }
        }
    }
    for (std::size_t i = kTerms; i-- > 0;) {
        for (std::size_t k = 0; k < kLanes; ++k) {
            for (std::size_t j = i + 1; j < kTerms; ++j) {
                y[i][k] -= m[i][j] * y[j][k];
            }
            y[i][k] /= m[i][i];
        }
    }
}

Vec3d lane(const Lanes3& v, int i) {
    return {v.x[i], v.y[i], v.z[i]};
}

}  // namespace

TangentFit::TangentFit(const transport::ElementPoints& element) : middle_(element.center) {
    const Vec3d normal = lane(element.normal, 0);
    const Vec3d edge = element.corners[1] - element.corners[0];
    Vec3d along = edge - glm::dot(edge, normal) * normal;
    if (!(glm::length(along) > 1e-9 * element.radius)) {
        along = glm::cross(normal, std::abs(normal.y) < 0.7 ? Vec3d(0, 1, 0) : Vec3d(0, 0, 1));
    }
    along = glm::normalize(along);
    const Vec3d across = glm::cross(normal, along);
    double longest = 1e-300;
    double widest = 1e-300;
    for (int i = 0; i < kLanes; ++i) {
        const Vec3d d = lane(element.position, i) - middle_;
        longest = std::max(longest, std::abs(glm::dot(d, along)));
        widest = std::max(widest, std::abs(glm::dot(d, across)));
    }
    along_ = along / longest;
    across_ = across / widest;
    std::array<std::array<double, kTerms>, kTerms> normalMatrix{};
    for (std::size_t i = 0; i < kLanes; ++i) {
        const Terms terms = termsAt(lane(element.position, static_cast<int>(i)));
        for (std::size_t k = 0; k < kTerms; ++k) {
            solution_[k][i] = static_cast<double>(terms[k]);
            for (std::size_t l = 0; l < kTerms; ++l) {
                normalMatrix[k][l] += static_cast<double>(terms[k]) * static_cast<double>(terms[l]);
            }
        }
    }
    for (std::size_t k = 0; k < kTerms; ++k) {
        normalMatrix[k][k] += 1e-5;
    }
    solveSystem(normalMatrix, solution_);
}

Terms TangentFit::termsAt(const Vec3d& position) const {
    const Vec3d d = position - middle_;
    const auto a = static_cast<float>(glm::dot(d, along_));
    const auto b = static_cast<float>(glm::dot(d, across_));
    return {1.0f, a, b, a * a, a * b, b * b};
}

Terms TangentFit::fit(const Lanes& values) const {
    Terms result{};
    for (std::size_t k = 0; k < kTerms; ++k) {
        double sum = 0.0;
        for (int i = 0; i < kLanes; ++i) {
            sum += solution_[k][static_cast<std::size_t>(i)] * values[i];
        }
        result[k] = static_cast<float>(sum);
    }
    return result;
}

}  // namespace fluxwalk::image
