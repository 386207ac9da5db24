#include "core/display/sample_net.h"

#include <map>

#include <gtest/gtest.h>

#include "core/display/balance.h"
#include "core/display/cell_regions.h"
#include "core/surface/disk.h"
#include "tests/display/display_scenes.h"
#include "tests/support/curved_scenes.h"

// Cells that are cut at random, each followed by what PatchTopology and halfRegions() say of it.

namespace fluxwalk::display {
namespace {

double constant(const Vec3d& /*p*/) {
    return 1.0;
}

class RandomCuts {
  public:
    RandomCuts(const surface::Surface& surface, std::uint64_t seed)
        : surface_(surface), topology_(surface), points_(0), random_(seed) {
        const std::vector<Leaf> leaves = makeLeaves(surface, constant, SplitRandomly{seed, 3, 0.5}, 1);
        for (std::uint32_t i = 0; i < leaves.size(); ++i) {
            cells_.push_back(makeCell(topology_, leaves[i].patch, leaves[i].path, i));
        }
        balance(topology_, points_, cells_);
        vertices_ = collectVertices(topology_, points_, cells_, 0.5);
        net_.reset(topology_, vertices_);
        RegionCursor cursor(surface);
        for (std::size_t i = 0; i < cells_.size(); ++i) {
            regions_.push_back(cursor.at(cells_[i]));
            nets_.push_back(net_.addRoot(cells_[i], vertices_.cells[i], regions_[i]));
        }
    }

    void cut(unsigned count) {
        for (unsigned n = 0; n < count; ++n) {
            const auto i = static_cast<std::size_t>(random_.next() * static_cast<double>(cells_.size()));
            if (cells_[i].cornerCount == 3) {
                quarter(i);
            } else {
                halve(i, random_.next() < 0.5 ? Axis::x : Axis::y);
            }
        }
    }

    void checkSamples() {
        for (std::size_t i = 0; i < cells_.size(); ++i) {
            const unsigned count = cells_[i].cornerCount;
            for (unsigned k = 0; k < count; ++k) {
                expectAt(nets_[i].corners[k], i, regions_[i].corners[k]);
                const Vec2d middle = surface_.splitPoint(cells_[i].patch, regions_[i].corners[k],
                                                         regions_[i].corners[(k + 1) % count]);
                expectAt(net_.middleOf(nets_[i], k, count), i, middle);
            }
            if (count == 4) {
                const auto& c = regions_[i].corners;
                const std::uint32_t patch = cells_[i].patch;
                expectAt(net_.centerOf(nets_[i]), i,
                         surface_.splitPoint(patch, surface_.splitPoint(patch, c[3], c[0]),
                                             surface_.splitPoint(patch, c[1], c[2])));
            }
        }
    }

    // Points have one number where and only where they have one name.
    void checkNumbers() {
        std::map<std::pair<std::uint64_t, std::uint32_t>, std::uint32_t> numberOf;
        std::map<std::uint32_t, std::pair<std::uint64_t, std::uint32_t>> nameOf;
        for (std::size_t i = 0; i < cells_.size(); ++i) {
            const auto corners = cornersOf(cells_[i]);
            for (unsigned k = 0; k < cells_[i].cornerCount; ++k) {
                const PointKey key = topology_.keyOf(cells_[i].patch, corners[k]);
                const std::pair name(key.place, key.where);
                const std::uint32_t number = net_.samples()[nets_[i].corners[k]].point;
                ASSERT_LT(number, net_.pointCount());
                EXPECT_EQ(numberOf.try_emplace(name, number).first->second, number);
                EXPECT_EQ(nameOf.try_emplace(number, name).first->second, name);
            }
        }
    }

    // Returns how many sides were crowded.
    std::size_t checkCrowding() {
        std::size_t crowded = 0;
        for (std::size_t i = 0; i < cells_.size(); ++i) {
            const auto corners = cornersOf(cells_[i]);
            for (unsigned k = 0; k < cells_[i].cornerCount; ++k) {
                const GridPoint& a = corners[k];
                const GridPoint& b = corners[(k + 1u) % cells_[i].cornerCount];
                const GridPoint middle = middleOf(a, b);
                const bool isSplit = has(i, middle);
                const bool isCrowded =
                    isSplit && (has(i, middleOf(a, middle)) || has(i, middleOf(middle, b)));
                EXPECT_EQ(net_.isSplit(nets_[i].sides[k]), isSplit);
                EXPECT_EQ(net_.isCrowded(nets_[i].sides[k]), isCrowded);
                crowded += isCrowded ? 1 : 0;
            }
        }
        return crowded;
    }

  private:
    bool has(std::size_t cell, const GridPoint& p) const {
        return points_.find(topology_.keyOf(cells_[cell].patch, p)) != kNone;
    }

    void expectAt(std::uint32_t sample, std::size_t cell, const Vec2d& uv) const {
        const SurfaceSample& at = net_.samples()[sample];
        const surface::SurfacePoint expected = surface_.evaluate(cells_[cell].patch, uv);
        EXPECT_EQ(at.patch, cells_[cell].patch);
        EXPECT_EQ(at.uv, uv);
        EXPECT_EQ(at.position, expected.position);
        EXPECT_EQ(at.normal, expected.normal);
    }

    void number(std::size_t i) {
        const auto corners = cornersOf(cells_[i]);
        for (unsigned k = 0; k < cells_[i].cornerCount; ++k) {
            points_.insert(topology_.keyOf(cells_[i].patch, corners[k]));
        }
    }

    // The first part takes the place of the cell.
    void replace(std::size_t i, unsigned part, const Cell& cell, const CellNet& net,
                 const surface::Region& region) {
        if (part == 0) {
            cells_[i] = cell;
            nets_[i] = net;
            regions_[i] = region;
            number(i);
        } else {
            cells_.push_back(cell);
            nets_.push_back(net);
            regions_.push_back(region);
            number(cells_.size() - 1);
        }
    }

    void halve(std::size_t i, Axis axis) {
        const Cell parent = cells_[i];
        const auto regions = halfRegions(surface_, parent.patch, regions_[i], axis);
        const auto nets = net_.halve(nets_[i], axis);
        for (unsigned half = 0; half < 2; ++half) {
            replace(i, half, halfOf(parent, axis, half), nets[half], regions[half]);
        }
    }

    void quarter(std::size_t i) {
        const Cell parent = cells_[i];
        const auto regions =
            surface::childRegions(surface_, parent.patch, regions_[i], surface::Split::quarters);
        const auto nets = net_.quarter(nets_[i]);
        for (unsigned k = 0; k < 4; ++k) {
            replace(i, k, partOf(parent, surface::Split::quarters, k), nets[k], regions[k]);
        }
    }

    const surface::Surface& surface_;
    PatchTopology topology_;
    PointTable points_;
    base::RandomStream random_;
    std::vector<Cell> cells_;
    MeshVertices vertices_;
    SampleNet net_;
    std::vector<CellNet> nets_;
    std::vector<surface::Region> regions_;
};

class SampleNetOf : public testing::TestWithParam<std::pair<const char*, test::SurfacePtr>> {};

TEST_P(SampleNetOf, KnowsEveryPointAndNeighbour) {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        RandomCuts cuts(*GetParam().second, seed);
        cuts.cut(400);
        cuts.checkNumbers();
        EXPECT_GT(cuts.checkCrowding(), 10u);
        cuts.checkSamples();
    }
}

// A quad beside two of half its size: a corner in the middle of an edge.
test::SurfacePtr makeStep() {
    surface::TriangleSoup soup;
    soup.positions = {{0, 0, 0},   {1, 0, 0},    {1, 0, 1},      {0, 0, 1},
                      {1, 0, .5f}, {1.5f, 0, 0}, {1.5f, 0, .5f}, {1.5f, 0, 1}};
    const std::array<std::array<std::uint32_t, 4>, 3> quads{{{0, 3, 2, 1}, {1, 4, 6, 5}, {4, 2, 7, 6}}};
    for (const auto& q : quads) {
        soup.triangles.push_back({q[0], q[1], q[2]});
        soup.triangles.push_back({q[0], q[2], q[3]});
    }
    return std::make_shared<surface::PolygonMesh>(std::move(soup));
}

INSTANTIATE_TEST_SUITE_P(
    Shapes, SampleNetOf,
    testing::Values(std::pair("sphere", std::make_shared<surface::Sphere>(Vec3d(.3, -.2, .7), 1.7)),
                    // Four sides of no length about one point, which is the middle of each.
                    std::pair("disk", std::make_shared<surface::Disk>(base::Mat4d(1.0), 1.2)),
                    std::pair("torus", std::make_shared<surface::Torus>(base::Mat4d(1.0), 1.1, .4)),
                    std::pair("subdivision",
                              std::make_shared<surface::SubdivisionSurface>(test::closedVaseCage())),
                    std::pair("step", makeStep())),
    [](const auto& shape) { return std::string(shape.param.first); });

}  // namespace
}  // namespace fluxwalk::display
