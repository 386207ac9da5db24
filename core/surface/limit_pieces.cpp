#include "core/surface/limit_pieces.h"

#include <cmath>
#include <memory>

#include <opensubdiv/far/patchTableFactory.h>
#include <opensubdiv/far/primvarRefiner.h>
#include <opensubdiv/far/topologyDescriptor.h>

#include "core/base/check.h"

namespace fluxwalk::surface {

namespace {

namespace Far = OpenSubdiv::Far;
namespace Sdc = OpenSubdiv::Sdc;

/// OpenSubdiv's largest.
constexpr unsigned kIsolationLevel = 10;

/// A position as OpenSubdiv combines them.
struct Point {
    Vec3d at{};
    // NOLINTNEXTLINE(readability-identifier-naming): OpenSubdiv calls it so
    void Clear() { at = Vec3d(0.0); }
    // NOLINTNEXTLINE(readability-identifier-naming)
    void AddWithWeight(const Point& from, double weight) { at += weight * from.at; }
};

std::unique_ptr<Far::TopologyRefiner> makeRefiner(const ControlCage& cage) {
    const std::vector<int> sizes(cage.faceSizes.begin(), cage.faceSizes.end());
    const std::vector<int> corners(cage.corners.begin(), cage.corners.end());
    std::vector<int> creaseEnds;
    std::vector<float> sharpness;
    for (const Crease& crease : cage.creases) {
        creaseEnds.push_back(static_cast<int>(crease.from));
        creaseEnds.push_back(static_cast<int>(crease.to));
        sharpness.push_back(std::min(crease.sharpness, Sdc::Crease::SHARPNESS_INFINITE));
    }
    Far::TopologyDescriptor descriptor;
    descriptor.numVertices = static_cast<int>(cage.positions.size());
    descriptor.numFaces = static_cast<int>(sizes.size());
    descriptor.numVertsPerFace = sizes.data();
    descriptor.vertIndicesPerFace = corners.data();
    descriptor.numCreases = static_cast<int>(sharpness.size());
    descriptor.creaseVertexIndexPairs = creaseEnds.data();
    descriptor.creaseWeights = sharpness.data();
    Sdc::Options options;
    options.SetVtxBoundaryInterpolation(Sdc::Options::VTX_BOUNDARY_EDGE_AND_CORNER);
    using Factory = Far::TopologyRefinerFactory<Far::TopologyDescriptor>;
    const Sdc::SchemeType scheme =
        cage.scheme == SubdivisionScheme::loop ? Sdc::SCHEME_LOOP : Sdc::SCHEME_CATMARK;
    std::unique_ptr<Far::TopologyRefiner> refiner(
        Factory::Create(descriptor, Factory::Options(scheme, options)));
    FLUXWALK_CHECK(refiner != nullptr);
    return refiner;
}

Far::PatchTableFactory::Options patchOptions() {
    Far::PatchTableFactory::Options options(kIsolationLevel);
    options.useInfSharpPatch = true;
    options.generateLegacySharpCornerPatches = false;
    options.generateVaryingTables = false;
    options.generateVaryingLocalPoints = false;
    options.SetEndCapType(Far::PatchTableFactory::Options::ENDCAP_GREGORY_BASIS);
    options.SetPatchPrecision<double>();
    return options;
}

// Control points of all levels, then those that caps add.
std::vector<Point> refinePoints(const ControlCage& cage, const Far::TopologyRefiner& refiner,
                                const Far::PatchTable& table) {
    const auto refined = static_cast<std::size_t>(refiner.GetNumVerticesTotal());
    std::vector<Point> points(refined + static_cast<std::size_t>(table.GetNumLocalPoints()));
    for (std::size_t i = 0; i < cage.positions.size(); ++i) {
        points[i].at = cage.positions[i];
    }
    const Far::PrimvarRefinerReal<double> primvar(refiner);
    Point* from = points.data();
    for (int level = 1; level < refiner.GetNumLevels(); ++level) {
        Point* to = from + refiner.GetLevel(level - 1).GetNumVertices();
        primvar.Interpolate(level, from, to);
        from = to;
    }
    if (table.GetNumLocalPoints() > 0) {
        table.GetLocalPointStencilTable<double>()->UpdateValues(points.data(), points.data() + refined);
    }
    return points;
}

/// Turns values at evenly spaced parameters into Bezier points, by the inverse of the Bernstein polynomials
/// there.
class QuarticInterpolation {
  public:
    QuarticInterpolation() {
        // Gauss-Jordan with pivoting on [A | I].
        std::array<std::array<double, 30>, 15> m{};
        for (std::size_t node = 0; node < 15; ++node) {
            const Vec2d uv = nodeAt(node);
            for (std::size_t j = 0; j <= 4; ++j) {
                for (std::size_t i = 0; i + j <= 4; ++i) {
                    BezierPiece basis;
                    basis.domain = PatchDomain::triangle;
                    basis.points[quarticIndex(i, j)].x = 1.0;
                    m[node][quarticIndex(i, j)] = evaluatePiece(basis, uv).position.x;
                }
            }
            m[node][15 + node] = 1.0;
        }
        for (std::size_t column = 0; column < 15; ++column) {
            std::size_t pivot = column;
            for (std::size_t row = column + 1; row < 15; ++row) {
                if (std::abs(m[row][column]) > std::abs(m[pivot][column])) {
                    pivot = row;
                }
            }
            std::swap(m[column], m[pivot]);
            const double scale = 1.0 / m[column][column];
            for (double& value : m[column]) {
                value *= scale;
            }
            for (std::size_t row = 0; row < 15; ++row) {
                const double factor = m[row][column];
                if (row != column && factor != 0.0) {
                    for (std::size_t k = 0; k < 30; ++k) {
                        m[row][k] -= factor * m[column][k];
                    }
                }
            }
        }
        for (std::size_t i = 0; i < 15; ++i) {
            std::copy(m[i].begin() + 15, m[i].end(), inverse_[i].begin());
        }
    }

    /// Parameter of node k, in the order of a quartic's points.
    static Vec2d nodeAt(std::size_t k) {
        std::size_t row = 0;
        while (k >= 5 - row) {
            k -= 5 - row;
            ++row;
        }
        return {0.25 * static_cast<double>(k), 0.25 * static_cast<double>(row)};
    }

    std::array<Vec3d, 16> apply(const std::array<Vec3d, 16>& values) const {
        std::array<Vec3d, 16> result{};
        for (std::size_t i = 0; i < 15; ++i) {
            for (std::size_t k = 0; k < 15; ++k) {
                result[i] += inverse_[i][k] * values[k];
            }
        }
        return result;
    }

  private:
    std::array<std::array<double, 15>, 15> inverse_{};
};

// Bezier points of the cubic through four values at 0, 1/3, 2/3 and 1.
void interpolateCubic(Vec3d* f, std::size_t stride) {
    const Vec3d f1 = f[stride];
    const Vec3d f2 = f[2 * stride];
    f[stride] = (-5.0 * f[0] + 18.0 * f1 - 9.0 * f2 + 2.0 * f[3 * stride]) / 6.0;
    f[2 * stride] = (2.0 * f[0] - 9.0 * f1 + 18.0 * f2 - 5.0 * f[3 * stride]) / 6.0;
}

/// Reads OpenSubdiv's patches as Bezier pieces.
class PieceReader {
  public:
    PieceReader(const Far::PatchTable& table, const std::vector<Point>& points)
        : table_(table), points_(points) {}

    LimitPiece read(int array, int index) const {
        const Far::PatchParam param = table_.GetPatchParam(array, index);
        const auto type = table_.GetPatchArrayDescriptor(array).GetType();
        const bool isTriangle =
            type == Far::PatchDescriptor::LOOP || type == Far::PatchDescriptor::GREGORY_TRIANGLE;
        const auto toPatch = [&](Vec2d uv) {
            if (isTriangle) {
                param.UnnormalizeTriangle(uv.x, uv.y);
            } else {
                param.Unnormalize(uv.x, uv.y);
            }
            return uv;
        };
        LimitPiece piece;
        piece.patch = static_cast<std::uint32_t>(param.GetFaceId());
        piece.depth = static_cast<unsigned>(param.GetDepth() - (param.NonQuadRoot() ? 1 : 0));
        piece.map.origin = toPatch({0, 0});
        piece.map.du = toPatch({1, 0}) - piece.map.origin;
        piece.map.dv = toPatch({0, 1}) - piece.map.origin;
        piece.bezier.domain = isTriangle ? PatchDomain::triangle : PatchDomain::quad;
        const Far::ConstIndexArray vertices = table_.GetPatchVertices(array, index);
        switch (type) {
            case Far::PatchDescriptor::GREGORY_BASIS:
                piece.bezier.points = readGregoryQuad(vertices);
                break;
            case Far::PatchDescriptor::GREGORY_TRIANGLE:
                piece.bezier.points = readGregoryTriangle(vertices);
                break;
            case Far::PatchDescriptor::REGULAR:
                for (std::size_t k = 0; k < 16; ++k) {
                    const std::size_t row = k / 4;
                    const Vec2d node(static_cast<double>(k % 4) / 3.0, static_cast<double>(row) / 3.0);
                    piece.bezier.points[k] = valueAt(array, index, toPatch(node));
                }
                for (std::size_t k = 0; k < 4; ++k) {
                    interpolateCubic(piece.bezier.points.data() + 4 * k, 1);
                }
                for (std::size_t k = 0; k < 4; ++k) {
                    interpolateCubic(piece.bezier.points.data() + k, 4);
                }
                break;
            default:
                FLUXWALK_CHECK_EQ(static_cast<int>(type), static_cast<int>(Far::PatchDescriptor::LOOP));
                for (std::size_t k = 0; k < 15; ++k) {
                    piece.bezier.points[k] = valueAt(array, index, toPatch(QuarticInterpolation::nodeAt(k)));
                }
                piece.bezier.points = quartic_.apply(piece.bezier.points);
        }
        return piece;
    }

  private:
    const Vec3d& point(const Far::ConstIndexArray& vertices, int k) const {
        return points_[static_cast<std::size_t>(vertices[k])].at;
    }

    Vec3d valueAt(int array, int index, const Vec2d& uv) const {
        const Far::ConstIndexArray vertices = table_.GetPatchVertices(array, index);
        std::array<double, 20> weights{};
        const Far::PatchTable::PatchHandle handle = handleOf(array, index);
        table_.EvaluateBasis(handle, uv.x, uv.y, weights.data());
        Vec3d sum(0.0);
        for (int k = 0; k < vertices.size(); ++k) {
            sum += weights[static_cast<std::size_t>(k)] * point(vertices, k);
        }
        return sum;
    }

    Far::PatchTable::PatchHandle handleOf(int array, int index) const {
        Far::PatchTable::PatchHandle handle;
        handle.arrayIndex = array;
        handle.patchIndex = index;
        for (int before = 0; before < array; ++before) {
            handle.patchIndex += table_.GetNumPatches(before);
        }
        handle.vertIndex = index * table_.GetPatchArrayDescriptor(array).GetNumControlVertices();
        return handle;
    }

    // A Gregory patch has for each corner: the point, the edge points after and before it, and two inner
    // points.
    std::array<Vec3d, 16> readGregoryQuad(const Far::ConstIndexArray& v) const {
        constexpr std::array<std::array<std::size_t, 4>, 4> kPlaces{
            {{0, 1, 4, 5}, {3, 7, 2, 6}, {15, 14, 11, 10}, {12, 8, 13, 9}}};
        std::array<Vec3d, 16> points{};
        for (int corner = 0; corner < 4; ++corner) {
            const std::array<std::size_t, 4>& place = kPlaces[static_cast<std::size_t>(corner)];
            points[place[0]] = point(v, 5 * corner);
            points[place[1]] = point(v, 5 * corner + 1);
            points[place[2]] = point(v, 5 * corner + 2);
            points[place[3]] = 0.5 * (point(v, 5 * corner + 3) + point(v, 5 * corner + 4));
        }
        return points;
    }

    // The triangle's edges have a middle point each besides.
    std::array<Vec3d, 16> readGregoryTriangle(const Far::ConstIndexArray& v) const {
        constexpr std::array<std::array<std::size_t, 4>, 3> kPlaces{
            {{quarticIndex(0, 0), quarticIndex(1, 0), quarticIndex(0, 1), quarticIndex(1, 1)},
             {quarticIndex(4, 0), quarticIndex(3, 1), quarticIndex(3, 0), quarticIndex(2, 1)},
             {quarticIndex(0, 4), quarticIndex(0, 3), quarticIndex(1, 3), quarticIndex(1, 2)}}};
        std::array<Vec3d, 16> points{};
        for (int corner = 0; corner < 3; ++corner) {
            const std::array<std::size_t, 4>& place = kPlaces[static_cast<std::size_t>(corner)];
            points[place[0]] = point(v, 5 * corner);
            points[place[1]] = point(v, 5 * corner + 1);
            points[place[2]] = point(v, 5 * corner + 2);
            points[place[3]] = 0.5 * (point(v, 5 * corner + 3) + point(v, 5 * corner + 4));
        }
        points[quarticIndex(2, 0)] = point(v, 15);
        points[quarticIndex(2, 2)] = point(v, 16);
        points[quarticIndex(0, 2)] = point(v, 17);
        return points;
    }

    const Far::PatchTable& table_;
    const std::vector<Point>& points_;
    QuarticInterpolation quartic_;
};

}  // namespace

std::vector<LimitPiece> findLimitPieces(const ControlCage& cage) {
    const std::unique_ptr<Far::TopologyRefiner> refiner = makeRefiner(cage);
    const Far::PatchTableFactory::Options options = patchOptions();
    refiner->RefineAdaptive(options.GetRefineAdaptiveOptions());
    const std::unique_ptr<Far::PatchTable> table(Far::PatchTableFactory::Create(*refiner, options));
    FLUXWALK_CHECK(table != nullptr);
    const std::vector<Point> points = refinePoints(cage, *refiner, *table);
    const PieceReader reader(*table, points);
    std::vector<LimitPiece> pieces;
    pieces.reserve(static_cast<std::size_t>(table->GetNumPatchesTotal()));
    for (int array = 0; array < table->GetNumPatchArrays(); ++array) {
        for (int index = 0; index < table->GetNumPatches(array); ++index) {
            pieces.push_back(reader.read(array, index));
        }
    }
    return pieces;
}

}  // namespace fluxwalk::surface
