#include "core/display/gathered_mesh.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "core/base/check.h"
#include "core/display/balance.h"
#include "core/display/carry_values.h"
#include "core/display/mesh_parts.h"
#include "core/display/post_refine.h"
#include "core/display/triangulate.h"

namespace fluxwalk::display {

namespace {

/// So many cells deep into what is hidden, light is taken over from where it is known.
constexpr unsigned kFillRounds = 3;

const LightSample* findSample(const LeafLight& light, const GridPoint& at) {
    const auto place = std::lower_bound(light.samples.begin(), light.samples.end(), at,
                                        [](const LightSample& sample, const GridPoint& p) {
                                            return sample.at.y != p.y ? sample.at.y < p.y : sample.at.x < p.x;
                                        });
    const bool isFound = place != light.samples.end() && place->at.x == at.x && place->at.y == at.y;
    return isFound ? &*place : nullptr;
}

/// The balanced cells of a side, cut as its light asks for, and the light at their corners and middles.
class GatheredSide {
  public:
    GatheredSide(const PatchTopology& topology, std::span<const Leaf> leaves,
                 std::span<const LeafLight* const> lights, double creaseAngle)
        : topology_(topology), leaves_(leaves), lights_(lights), creaseAngle_(creaseAngle), points_(0) {}

    void make() {
        makeCells();
        collectSamples();
        for (unsigned round = 0; round < kFillRounds && fillHidden(); ++round) {
        }
        fillBetween();
    }

    const std::vector<Cell>& cells() const { return cells_; }
    const MeshVertices& vertices() const { return vertices_; }
    const MeshValues& values() const { return values_; }

  private:
    enum class State : std::uint8_t { unknown, hidden, known };

    std::uint32_t leafOf(std::size_t i) const { return coarse_[cells_[i].source].source; }

    // What buildDisplayMeshes() shows, carried over to the cells that the light asks for.
    void makeCells() {
        for (std::uint32_t i = 0; i < leaves_.size(); ++i) {
            coarse_.push_back(makeCell(topology_, leaves_[i].patch, leaves_[i].path, i));
        }
        PointTable coarsePoints(coarse_.size() + coarse_.size() / 4);
        balance(topology_, coarsePoints, coarse_);
        const MeshVertices coarseVertices = collectVertices(topology_, coarsePoints, coarse_, creaseAngle_);
        const MeshValues coarseValues = reconstructValues(coarse_, coarseVertices, leaves_);

        for (std::uint32_t i = 0; i < coarse_.size(); ++i) {
            Cell cell = makeCell(topology_, coarse_[i].patch, coarse_[i].path, i);
            askFor(cell, lights_[coarse_[i].source]);
        }
        points_ = PointTable(cells_.size() + cells_.size() / 4);
        balance(topology_, points_, cells_);
        vertices_ = collectVertices(topology_, points_, cells_, creaseAngle_);
        values_ = carryValues({coarse_, coarseVertices, coarseValues}, planCarrying(cells_, vertices_),
                              vertices_.pointOfValue.size());
    }

    static bool isCut(const LeafLight& light, surface::Path path) {
        return std::binary_search(light.splits.begin(), light.splits.end(), path);
    }

    Cell partOfCell(const Cell& cell, unsigned part) const {
        return partOf(cell, surface::splitAt(topology_.strips(cell.patch), surface::pathLevel(cell.path)),
                      part);
    }

    void askFor(const Cell& cell, const LeafLight* light) {
        if (light == nullptr || !isCut(*light, cell.path)) {
            cells_.push_back(cell);
            return;
        }
        for (unsigned k = 0; k < 4; ++k) {
            askFor(partOfCell(cell, k), light);
        }
    }

    // The smallest cell about a balanced one that has light at its corners.
    Cell lightCellOf(std::size_t i) const {
        const std::uint32_t leaf = leafOf(i);
        Cell cell = makeCell(topology_, leaves_[leaf].patch, leaves_[leaf].path, leaf);
        while (cell.path != cells_[i].path && isCut(*lights_[leaf], cell.path)) {
            cell = partOfCell(cell, surface::pathStep(cells_[i].path, surface::pathLevel(cell.path)));
        }
        return cell;
    }

    // Calls visit(value, place) for what a cell shows, values behind those of vertices being cells' middles.
    template <class Visit>
    void forValues(std::size_t i, const Visit& visit) const {
        const CellVertices& own = vertices_.cells[i];
        const Cell& cell = cells_[i];
        const std::array<GridPoint, 4> corners = cornersOf(cell);
        for (unsigned k = 0; k < cell.cornerCount; ++k) {
            visit(vertices_.vertices[own.corners[k]].value, corners[k]);
            if (own.middles[k] != kNone) {
                visit(vertices_.vertices[own.middles[k]].value,
                      middleOf(corners[k], corners[(k + 1) % cell.cornerCount]));
            }
        }
        if (own.isFan) {
            visit(static_cast<std::uint32_t>(values_.values.size() + i), middleOf(corners[0], corners[2]));
        }
    }

    Rgb& valueAt(std::size_t value) {
        return value < values_.values.size() ? values_.values[value]
                                             : values_.centers[value - values_.values.size()];
    }

    // Rays miss a little of the light of each leaf, not the same of its neighbours: what a leaf's corners are
    // off from the mean of the leaves about them is spread over the leaf.
    void collectSamples() {
        const std::size_t count = values_.values.size() + cells_.size();
        states_.assign(count, State::unknown);
        sums_.assign(count, Rgb(0.0f));
        counts_.assign(count, 0);
        forSamples([&](std::uint32_t value, const GridPoint&, const LightSample& sample, std::uint32_t) {
            if (sample.isHidden) {
                states_[value] = states_[value] == State::known ? State::known : State::hidden;
                return;
            }
            states_[value] = State::known;
            sums_[value] += sample.irradiance;
            ++counts_[value];
        });
        takeSums(State::known);
        const std::vector<Offsets> offsets = findOffsets();
        forSamples(
            [&](std::uint32_t value, const GridPoint& at, const LightSample& sample, std::uint32_t leaf) {
                if (!sample.isHidden) {
                    sums_[value] += glm::max(sample.irradiance + offsets[leaf].at(at), Rgb(0.0f));
                    ++counts_[value];
                }
            });
        takeSums(State::known);
    }

    // Calls visit(value, place, sample, leaf) for all that is known of the light at the cells' points.
    template <class Visit>
    void forSamples(const Visit& visit) const {
        for (std::size_t i = 0; i < cells_.size(); ++i) {
            const std::uint32_t leaf = leafOf(i);
            if (lights_[leaf] == nullptr) {
                continue;
            }
            forValues(i, [&](std::uint32_t value, const GridPoint& at) {
                if (const LightSample* sample = findSample(*lights_[leaf], at)) {
                    visit(value, at, *sample, leaf);
                }
            });
        }
    }

    /// What is to be added to a leaf's light.
    struct Offsets {
        Cell leaf;
        std::array<Rgb, 4> corners{};

        Rgb at(const GridPoint& p) const {
            const base::Vec2d place = placeIn(leaf, p);
            return interpolateIn(leaf, corners, place);
        }
    };

    std::vector<Offsets> findOffsets() const {
        std::vector<Offsets> all(leaves_.size());
        for (std::uint32_t i = 0; i < leaves_.size(); ++i) {
            if (lights_[i] == nullptr) {
                continue;
            }
            Offsets& own = all[i];
            own.leaf = makeCell(topology_, leaves_[i].patch, leaves_[i].path, i);
            const std::array<GridPoint, 4> at = cornersOf(own.leaf);
            for (unsigned k = 0; k < own.leaf.cornerCount; ++k) {
                const LightSample* sample = findSample(*lights_[i], at[k]);
                const std::uint32_t value = valueOf(own.leaf, at[k]);
                if (sample != nullptr && !sample->isHidden && value != kNone) {
                    own.corners[k] = values_.values[value] - sample->irradiance;
                }
            }
        }
        return all;
    }

    static base::Vec2d placeIn(const Cell& cell, const GridPoint& at) {
        const auto offset = [&](std::uint32_t to, std::uint32_t from, std::uint32_t extent) {
            const double d = cell.inverted ? static_cast<double>(from) - to : static_cast<double>(to) - from;
            return d / extent;
        };
        return {offset(at.x, cell.origin.x, cell.extent.x), offset(at.y, cell.origin.y, cell.extent.y)};
    }

    static Rgb interpolateIn(const Cell& cell, const std::array<Rgb, 4>& c, const base::Vec2d& place) {
        const auto x = static_cast<float>(place.x);
        const auto y = static_cast<float>(place.y);
        return cell.cornerCount == 3 ? (1.0f - x - y) * c[0] + x * c[1] + y * c[2]
                                     : glm::mix(glm::mix(c[0], c[1], x), glm::mix(c[3], c[2], x), y);
    }

    void takeSums(State state) {
        for (std::size_t v = 0; v < sums_.size(); ++v) {
            if (counts_[v] > 0) {
                valueAt(v) = sums_[v] / static_cast<float>(counts_[v]);
                states_[v] = state;
            }
            sums_[v] = Rgb(0.0f);
            counts_[v] = 0;
        }
    }

    // One step into what is hidden; whether there was any.
    bool fillHidden() {
        bool isAny = false;
        for (std::size_t i = 0; i < cells_.size(); ++i) {
            Rgb sum(0.0f);
            std::uint32_t known = 0;
            bool hasHidden = false;
            forValues(i, [&](std::uint32_t value, const GridPoint&) {
                hasHidden = hasHidden || states_[value] == State::hidden;
                if (states_[value] == State::known) {
                    sum += valueAt(value);
                    ++known;
                }
            });
            if (!hasHidden || known == 0) {
                continue;
            }
            forValues(i, [&](std::uint32_t value, const GridPoint&) {
                if (states_[value] == State::hidden) {
                    sums_[value] += sum;
                    counts_[value] += known;
                    isAny = true;
                }
            });
        }
        takeSums(State::known);
        return isAny;
    }

    // Balancing cuts cells further than their light asked for: there it is linear.
    void fillBetween() {
        for (std::size_t i = 0; i < cells_.size(); ++i) {
            if (lights_[leafOf(i)] == nullptr) {
                continue;
            }
            std::optional<Cell> around;
            forValues(i, [&](std::uint32_t value, const GridPoint& at) {
                if (states_[value] == State::unknown) {
                    if (!around) {
                        around = lightCellOf(i);
                    }
                    if (const std::optional<Rgb> between = interpolate(*around, at)) {
                        sums_[value] += *between;
                        ++counts_[value];
                    }
                }
            });
        }
        takeSums(State::unknown);
    }

    std::uint32_t valueOf(const Cell& cell, const GridPoint& at) const {
        const std::uint32_t point = points_.find(topology_.keyOf(cell.patch, at));
        if (point == kNone) {
            return kNone;
        }
        std::uint32_t v = vertices_.heads[point];
        while (v != kNone && vertices_.vertices[v].patch != cell.patch) {
            v = vertices_.vertices[v].next;
        }
        return v == kNone ? kNone : vertices_.vertices[v].value;
    }

    // Between the corners of a cell that the light asked for, and the middle of quads; nothing where one of
    // them lies deep in a solid.
    std::optional<Rgb> interpolate(const Cell& cell, const GridPoint& at) {
        const std::array<GridPoint, 4> corners = cornersOf(cell);
        std::array<Rgb, 4> light{};
        for (unsigned k = 0; k < cell.cornerCount; ++k) {
            const std::uint32_t value = valueOf(cell, corners[k]);
            if (value == kNone || states_[value] != State::known) {
                return std::nullopt;
            }
            light[k] = valueAt(value);
        }
        const base::Vec2d place = placeIn(cell, at);
        const Rgb between = interpolateIn(cell, light, place);
        if (cell.cornerCount == 3) {
            return between;
        }
        const std::uint32_t middle = valueOf(cell, middleOf(corners[0], corners[2]));
        if (middle == kNone || states_[middle] != State::known) {
            return between;
        }
        // A tent on top, as high as the middle is above the corners.
        const auto inside =
            static_cast<float>(1.0 - 2.0 * std::max(std::abs(place.x - 0.5), std::abs(place.y - 0.5)));
        return between + inside * (valueAt(middle) - 0.25f * (light[0] + light[1] + light[2] + light[3]));
    }

    const PatchTopology& topology_;
    std::span<const Leaf> leaves_;
    std::span<const LeafLight* const> lights_;
    double creaseAngle_;
    std::vector<Cell> coarse_;
    std::vector<Cell> cells_;  ///< their sources are coarse ones
    PointTable points_;
    MeshVertices vertices_;
    MeshValues values_;
    /// Of each value, cells' middles behind.
    std::vector<State> states_;
    std::vector<Rgb> sums_;
    std::vector<std::uint32_t> counts_;
};

void buildSide(const PatchTopology& topology, std::span<const Leaf> leaves,
               std::span<const LeafLight* const> lights, const MeshOptions& options, scene::LitMesh& mesh,
               DisplayMeshes& out) {
    checkTiling(leaves);
    GatheredSide side(topology, leaves, lights, options.creaseAngle);
    side.make();
    RefineBuffers buffers;
    const RefinedCells& refined = refineForDisplay(
        topology, side.cells(), side.vertices(),
        {options.curvatureAngle, options.rimRise, options.leastAngle, options.mostCellsForShape}, buffers);
    MeshVertices fine;
    MeshValues fineValues;
    const bool isRefined = !refined.cells.empty();
    if (isRefined) {
        collectVertices(topology, refined, options.creaseAngle, fine);
        fineValues = carryValues({side.cells(), side.vertices(), side.values()},
                                 planCarrying(refined.cells, fine), fine.pointOfValue.size());
    }
    const std::array<bool, 2> texcoords{options.texcoords[0] && topology.hasTexcoords(0),
                                        options.texcoords[1] && topology.hasTexcoords(1)};
    const std::vector<Cell>& shown = isRefined ? refined.cells : side.cells();
    std::vector<std::uint32_t> valueOf;
    std::vector<std::uint32_t> firstTriangle =
        triangulate(topology, shown, isRefined ? fine : side.vertices(),
                    isRefined ? fineValues : side.values(), texcoords, mesh, valueOf);
    out.tables.push_back(makeTable(shown, topology.surface().patchCount(), std::move(firstTriangle)));
}

}  // namespace

DisplayMeshes buildGatheredMeshes(const PatchTopology& topology, std::uint32_t object, std::uint32_t material,
                                  std::span<const Leaf> leaves, std::span<const LeafLight* const> lights,
                                  const MeshOptions& options) {
    FLUXWALK_CHECK_EQ(leaves.size(), lights.size());
    std::vector<std::uint32_t> order(leaves.size());
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(),
              [&](std::uint32_t a, std::uint32_t b) { return comesBefore(leaves[a], leaves[b]); });
    DisplayMeshes out;
    for (const bool back : {false, true}) {
        std::vector<Leaf> side;
        std::vector<const LeafLight*> sideLights;
        for (const std::uint32_t i : order) {
            if (leaves[i].back == back) {
                side.push_back(leaves[i]);
                sideLights.push_back(lights[i]);
            }
        }
        if (side.empty()) {
            continue;
        }
        const auto mesh = std::make_shared<scene::LitMesh>();
        mesh->object = object;
        mesh->material = material;
        mesh->back = back;
        buildSide(topology, side, sideLights, options, *mesh, out);
        shrink(*mesh);
        out.meshes.push_back(mesh);
    }
    return out;
}

}  // namespace fluxwalk::display
