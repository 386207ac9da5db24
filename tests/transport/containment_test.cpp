#include <iostream>

#include <gtest/gtest.h>

#include "core/scene/builders.h"
#include "core/transport/form_factor.h"
#include "tests/transport/polygon_pairs.h"

namespace fluxwalk {
namespace {

using base::NodeId;
using base::Vec2d;
using base::Vec3d;
using test::Built;
using transport::ElementPoints;
using transport::makeElementPoints;
using transport::PairFactor;

struct Containment {
    double rate = 0.0;   ///< of points whose kernel lies within the spread about the linear function
    double pairs = 0.0;  ///< of pairs all of whose points do
    double excess = 0.0; ///< largest deviation over the spread, relative to the mean kernel
};

// Random element pairs of the Cornell box, `level` times quartered: the kernel at random points of one end.
Containment contain(unsigned level, int count) {
    Built built(scene::buildCornellBox(base::Rgb(100.0f)));
    built.split(level);
    std::vector<NodeId> leaves;
    for (const NodeId id : built.tree.patches()) {
        const std::vector<NodeId> below = built.leavesOf(id);
        leaves.insert(leaves.end(), below.begin(), below.end());
    }
    base::RandomStream random(50 + level);
    Containment result;
    int points = 0;
    int used = 0;
    while (used < count) {
        const auto pick = [&] { return leaves[static_cast<std::size_t>(random.next() * static_cast<double>(leaves.size()))]; };
        const ElementPoints a = makeElementPoints(built.tree, pick());
        const ElementPoints b = makeElementPoints(built.tree, pick());
        const PairFactor f = transport::computePairFactor(a, b);
        if (!(f.coupling > 0.0)) {
            continue;
        }
        ++used;
        bool all = true;
        for (int i = 0; i < 32; ++i) {
            // In the local coordinates of localPointCoordinates().
            Vec2d local;
            Vec3d x;
            const auto& c = a.corners;
            if (a.cornerCount == 3) {
                const double root = std::sqrt(random.next());
                const Vec2d uv(1.0 - root, root * random.next());
                local = uv - Vec2d(1.0 / 3.0);
                x = (1.0 - uv.x - uv.y) * c[0] + uv.x * c[1] + uv.y * c[2];
            } else {
                const Vec2d st = random.next2();
                local = 2.0 * st - 1.0;
                x = (1.0 - st.y) * ((1.0 - st.x) * c[0] + st.x * c[1]) +
                    st.y * ((1.0 - st.x) * c[3] + st.x * c[2]);
            }
            const double kernel = transport::computePointFactor(x, a.axis, b) * a.area / f.coupling;
            const double excess = std::abs(kernel - 1.0 - glm::dot(f.gradientA, local)) - f.spreadA;
            const bool isInside = excess <= 1e-3;
            result.rate += isInside ? 1.0 : 0.0;
            result.excess = std::max(result.excess, excess);
            all = all && isInside;
            ++points;
        }
        result.pairs += all ? 1.0 : 0.0;
    }
    result.rate /= points;
    result.pairs /= count;
    return result;
}

// Eight points cannot bound a kernel between them; how often they do is what the oracle rests on.
TEST(Containment, kernelDeviationsOfTheCornellBox) {
    const std::array<double, 4> rates{0.95, 0.97, 0.98, 0.99};
    for (unsigned level = 0; level < rates.size(); ++level) {
        const Containment found = contain(level, 1500);
        EXPECT_GT(found.rate, rates[level]) << level;
        std::cout << "STAT containment level " << level << " points " << found.rate << " pairs " << found.pairs
                  << " excess " << found.excess << '\n';
    }
}

}  // namespace
}  // namespace fluxwalk
