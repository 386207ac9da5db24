#include "core/solve/refine.h"

#include <algorithm>
#include <cmath>

#include "core/base/photometry.h"
#include "core/hierarchy/local_frame.h"
#include "core/solve/assess_link.h"
#include "core/transport/coefficients.h"

namespace fluxwalk::solve {

namespace {

using hierarchy::Hierarchy;
using hierarchy::Link;
using hierarchy::NodeKind;
using hierarchy::Shape;
using transport::Coefficient;
using transport::Query;

/// Pairs whose coefficients are computed between two looks at the clock.
constexpr std::size_t kGrain = 64;

enum class Verdict : std::uint8_t { drop, accept, splitA, splitB, splitSelf };

struct Decision {
    Verdict verdict = Verdict::drop;
    Link link;
};

bool isBehind(const Shape& plane, const Shape& other, float tolerance) {
    if (!plane.isPlanar || plane.cornerCount == 0) {
        return false;
    }
    const base::Vec3& n = plane.axis;
    const float offset = glm::dot(n, plane.corners[0]);
    if (!other.isPlanar || other.cornerCount == 0) {
        return glm::dot(n, other.center) + other.radius <= offset + tolerance;
    }
    for (std::uint32_t i = 0; i < other.cornerCount; ++i) {
        if (glm::dot(n, other.corners[i]) > offset + tolerance) {
            return false;
        }
    }
    return true;
}

// Whether no normal of `from` has a direction to `to` in its half-space (ALGORITHMS 1.4, facing test).
bool facesAway(const Shape& from, const Shape& to) {
    const base::Vec3 d = to.center - from.center;
    const float distance = glm::length(d);
    const float reach = from.radius + to.radius;
    if (distance <= reach) {
        return false;
    }
    const double between = base::NormalCone::angleBetween(Vec3d(from.axis), glm::normalize(Vec3d(d)));
    const double delta = std::asin(std::min(1.0, static_cast<double>(reach / distance)));
    return between - static_cast<double>(from.halfAngle) - delta >= 0.5 * base::kPi;
}

class Refinement {
  public:
    Refinement(Problem& problem, double threshold)
        : problem_(problem),
          hierarchy_(problem.hierarchy),
          service_(problem.hierarchy, problem.rays),
          threshold_(static_cast<float>(threshold)),
          minArea_(problem.minArea()),
          sceneArea_(static_cast<float>(problem.hierarchy.totalArea())),
          tolerance_(1e-6f * static_cast<float>(problem.scene->bounds().diagonal())) {}

    // Pairs that start the first refinement.
    std::vector<Query> fromRoot() const {
        const NodeId root = hierarchy_.root();
        return root == NodeId::none ? std::vector<Query>{} : std::vector<Query>{{root, root}};
    }

    // Takes the links whose error has become too large out of the store and returns what they split into.
    std::vector<Query> fromStandingLinks() {
        std::vector<Link>& links = problem_.links.links;
        std::vector<Verdict> verdicts(links.size());
        problem_.executor.forRange(links.size(), 4096, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                verdicts[i] = judge(links[i]);
            }
        });
        std::vector<Decision> opened;
        std::size_t kept = 0;
        for (std::size_t i = 0; i < links.size(); ++i) {
            if (verdicts[i] == Verdict::accept) {
                links[kept++] = links[i];
            } else {
                opened.push_back({verdicts[i], links[i]});
            }
        }
        links.resize(kept);
        return openPairs(opened);
    }

    // One wave: coefficients of all pairs, then accept, drop or split.
    std::vector<Query> runWave(const std::vector<Query>& pairs) {
        std::vector<Decision> decisions(pairs.size());
        std::vector<Counters> counts((pairs.size() + kGrain - 1) / kGrain);
        problem_.executor.forRange(pairs.size(), kGrain, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                decisions[i] = decide(pairs[i], counts[begin / kGrain]);
            }
        });
        Counters& total = problem_.statistics.counters;
        for (const Counters& c : counts) {
            total.rays += c.rays;
            total.kernelEvaluations += c.kernelEvaluations;
            total.certificates += c.certificates;
        }
        ++total.waves;
        std::vector<Decision> opened;
        for (const Decision& d : decisions) {
            if (d.verdict == Verdict::accept) {
                problem_.links.links.push_back(d.link);
            } else if (d.verdict != Verdict::drop) {
                opened.push_back(d);
            }
        }
        return openPairs(opened);
    }

    void acceptAll() { threshold_ = INFINITY; }

  private:
    bool isSplittable(NodeId id) const { return hierarchy_.canSplit(id, minArea_); }

    bool isSource(NodeId id) const {
        return hierarchy_.kind(id) == NodeKind::light || hierarchy_.kind(id) == NodeKind::sky;
    }

    Verdict chooseSplit(const Link& link, bool preferA) const {
        const bool canA = isSplittable(link.a);
        const bool canB = isSplittable(link.b);
        if (!canA && !canB) {
            return Verdict::accept;
        }
        return (preferA && canA) || !canB ? Verdict::splitA : Verdict::splitB;
    }

    // How a concave element that sees itself goes on.
    Verdict judgeSelf(NodeId id) const {
        const hierarchy::ElementName name = hierarchy_.name(id);
        if (hierarchy_.surfaceOf(id).exactKernel(name.back) || !isSplittable(id)) {
            return Verdict::accept;
        }
        const Shape& shape = hierarchy_.shape(id);
        const hierarchy::Light& light = hierarchy_.light(id);
        const OracleKind oracle = problem_.options.oracle;
        const float range = oracle == OracleKind::strict ? light.range() : 0.0f;
        const float error =
            transport::assessSelf(oracle, {.area = shape.exposedArea(),
                                           .halfAngle = shape.halfAngle,
                                           .radiosity = base::channelMean(light.radiosity) + range,
                                           .sceneArea = sceneArea_});
        return error <= threshold_ ? Verdict::accept : Verdict::splitSelf;
    }

    // From what the link keeps alone, so that a new pair and a standing link are judged alike.
    Verdict judge(const Link& link) const {
        if (link.a == link.b) {
            return judgeSelf(link.a);
        }
        if (isCluster(link.a) || isCluster(link.b)) {
            if (!problem_.takesClusterLinks()) {
                return splitCluster(link.a, link.b);
            }
            if (isMinorPair(link.a, link.b)) {
                return Verdict::accept;
            }
            // Points prove nothing.
            const bool isStrict = problem_.options.oracle == OracleKind::strict;
            if (isStrict || !areApart(link.a, link.b) || link.coupling <= 0.0f) {
                return splitCluster(link.a, link.b);
            }
        }
        const transport::LinkAssessment assessment = assessLink(problem_, link, threshold_);
        return assessment.error <= threshold_ ? Verdict::accept : chooseSplit(link, assessment.splitA);
    }

    Decision decide(const Query& pair, Counters& counters) const {
        const NodeKind kindA = hierarchy_.kind(pair.a);
        const NodeKind kindB = hierarchy_.kind(pair.b);
        Decision d;
        d.link.a = pair.a;
        d.link.b = pair.b;
        if (pair.a == pair.b) {
            return decideSelf(pair, counters);
        }
        if (kindA == NodeKind::cluster || kindB == NodeKind::cluster) {
            return decideClusters(pair, counters);
        }
        if (kindA != NodeKind::element) {
            return d;  // two light sources without area
        }
        const Shape& shapeA = hierarchy_.shape(pair.a);
        const Shape& shapeB = hierarchy_.shape(pair.b);
        if (shapeA.exposedCells == 0 || (kindB == NodeKind::element && shapeB.exposedCells == 0)) {
            return d;
        }
        if (kindB == NodeKind::element &&
            (isBehind(shapeA, shapeB, tolerance_) || isBehind(shapeB, shapeA, tolerance_) ||
             facesAway(shapeA, shapeB) || facesAway(shapeB, shapeA))) {
            return d;
        }
        Coefficient c;
        service_.compute(std::span(&pair, 1), std::span(&c, 1));
        count(c, counters);
        // A strict oracle is not content that no sample saw another.
        if (c.isBlocked || (c.coupling <= 0.0f && problem_.options.oracle != OracleKind::strict)) {
            return d;
        }
        if (const unsigned before = c.rays; service_.settleContact(pair, c)) {
            counters.rays += c.rays - before;
        }
        setCoefficient(d.link, c);
        d.verdict = judge(d.link);
        return d;
    }

    // A concave element sees itself: kept as a link where that matters little, or where its kernel is one
    // constant; otherwise split into its parts.
    Decision decideSelf(const Query& pair, Counters& counters) const {
        Decision d;
        d.link.a = pair.a;
        d.link.b = pair.a;
        if (hierarchy_.kind(pair.a) == NodeKind::cluster) {
            d.verdict = Verdict::splitSelf;
            return d;
        }
        if (hierarchy_.kind(pair.a) != NodeKind::element) {
            return d;
        }
        const hierarchy::ElementName name = hierarchy_.name(pair.a);
        if (!hierarchy_.surfaceOf(pair.a).canSeeItself(name.patch, name.back) ||
            hierarchy_.shape(pair.a).exposedCells == 0) {
            return d;
        }
        d.verdict = judgeSelf(pair.a);
        if (d.verdict == Verdict::accept) {
            // Also where no sample saw another one: more light may ask for its parts.
            Coefficient c;
            service_.compute(std::span(&pair, 1), std::span(&c, 1));
            count(c, counters);
            setCoefficient(d.link, c);
        }
        return d;
    }

    bool isCluster(NodeId id) const { return hierarchy_.kind(id) == NodeKind::cluster; }

    Verdict splitCluster(NodeId a, NodeId b) const {
        const bool isA = isCluster(a) && isCluster(b)
                             ? hierarchy_.shape(a).radius >= hierarchy_.shape(b).radius
                             : isCluster(a);
        return isA ? Verdict::splitA : Verdict::splitB;
    }

    // Whether all that a pair could exchange, were nothing lost on the way, is below the threshold.
    bool isMinorPair(NodeId a, NodeId b) const {
        const auto radiosity = [this](NodeId id) {
            const hierarchy::Light& light = hierarchy_.light(id);
            return base::channelMean(light.radiosity) + light.range();
        };
        const float area = std::min(hierarchy_.shape(a).exposedArea(), hierarchy_.shape(b).exposedArea());
        return area * std::max(radiosity(a), radiosity(b)) <= threshold_ * sceneArea_;
    }

    // Whether points stand for a cluster in its exchange with another node: clusters must be apart by their
    // spheres, an element, whose factor is exact, by its box.
    bool areApart(NodeId a, NodeId b) const {
        const Shape& shapeA = hierarchy_.shape(a);
        const Shape& shapeB = hierarchy_.shape(b);
        if (shapeA.cornerCount == 0 && shapeB.cornerCount == 0) {
            return glm::distance(shapeA.center, shapeB.center) > shapeA.radius + shapeB.radius;
        }
        const Shape& cluster = shapeA.cornerCount == 0 ? shapeA : shapeB;
        const Shape& element = shapeA.cornerCount == 0 ? shapeB : shapeA;
        hierarchy::Extent box{element.center - element.radius, element.center + element.radius};
        if (element.isPlanar) {
            box = {element.corners[0], element.corners[0]};
            for (std::uint32_t i = 1; i < element.cornerCount; ++i) {
                box.lower = glm::min(box.lower, element.corners[i]);
                box.upper = glm::max(box.upper, element.corners[i]);
            }
        }
        const base::Vec3 nearest = glm::clamp(cluster.center, box.lower, box.upper);
        return glm::distance(nearest, cluster.center) > cluster.radius;
    }

    Decision decideClusters(const Query& pair, Counters& counters) const {
        Decision d;
        d.link.a = pair.a;
        d.link.b = pair.b;
        const Shape& a = hierarchy_.shape(pair.a);
        const Shape& b = hierarchy_.shape(pair.b);
        if (a.area > 0.0f && b.area > 0.0f &&
            (facesAway(a, b) || facesAway(b, a) || isBehind(a, b, tolerance_) ||
             isBehind(b, a, tolerance_))) {
            return d;
        }
        // Light sources without area stay with single patches, and nothing is shared through a closed wall.
        const bool areSurfaces = a.area > 0.0f && b.area > 0.0f;
        const bool isMinor = areSurfaces && isMinorPair(pair.a, pair.b);
        const bool areInRooms = hierarchy_.isInOneRoom(pair.a) && hierarchy_.isInOneRoom(pair.b);
        if (!problem_.takesClusterLinks() || !areSurfaces || !areInRooms ||
            (!isMinor && !areApart(pair.a, pair.b))) {
            d.verdict = splitCluster(pair.a, pair.b);
            return d;
        }
        if (a.exposedArea() <= 0.0f || b.exposedArea() <= 0.0f) {
            return d;
        }
        Coefficient c;
        service_.compute(std::span(&pair, 1), std::span(&c, 1));
        count(c, counters);
        if (c.isBlocked) {
            return d;
        }
        setCoefficient(d.link, c);
        d.verdict = judge(d.link);
        return d;
    }

    static void count(const Coefficient& c, Counters& counters) {
        counters.rays += c.rays;
        counters.kernelEvaluations += c.evaluations;
        counters.certificates += c.isOpen || c.isBlocked ? 1 : 0;
    }

    base::Vec2 inRegion(NodeId id, const base::Vec2& gradient) const {
        const bool isBack = hierarchy_.kind(id) == NodeKind::element && hierarchy_.name(id).back;
        return isBack ? hierarchy::mirrorGradient(hierarchy_.shape(id).cornerCount, gradient) : gradient;
    }

    void setCoefficient(Link& link, const Coefficient& c) const {
        link.coupling = c.coupling;
        link.setVisibility(c.visibility, c.isOpen);
        link.gradientA = hierarchy::GradientCode::encode(inRegion(link.a, c.gradientA));
        link.gradientB = hierarchy::GradientCode::encode(inRegion(link.b, c.gradientB));
        link.spreadA = hierarchy::UncertaintyCode::encode(c.spreadA);
        link.spreadB = hierarchy::UncertaintyCode::encode(c.spreadB);
    }

    // Splits the nodes that need children and returns the pairs that replace the opened ones, in their order.
    std::vector<Query> openPairs(const std::vector<Decision>& opened) {
        std::vector<NodeId> leaves;
        const auto want = [&](NodeId id) {
            if (hierarchy_.isLeaf(id) && hierarchy_.kind(id) == NodeKind::element) {
                leaves.push_back(id);
            }
        };
        for (const Decision& d : opened) {
            want(d.verdict == Verdict::splitB ? d.link.b : d.link.a);
        }
        std::sort(leaves.begin(), leaves.end());
        leaves.erase(std::unique(leaves.begin(), leaves.end()), leaves.end());
        problem_.hierarchy.split(leaves, problem_.executor);

        std::vector<Query> next;
        next.reserve(opened.size() * 4);
        for (const Decision& d : opened) {
            const NodeId a = d.link.a;
            const NodeId b = d.link.b;
            const bool open = d.link.isOpen();
            if (d.verdict == Verdict::splitSelf) {
                const unsigned n = hierarchy_.childCount(a);
                for (unsigned i = 0; i < n; ++i) {
                    for (unsigned j = i; j < n; ++j) {
                        next.push_back(ordered(hierarchy_.child(a, i), hierarchy_.child(a, j), open));
                    }
                }
                continue;
            }
            const NodeId from = d.verdict == Verdict::splitA ? a : b;
            const NodeId other = d.verdict == Verdict::splitA ? b : a;
            for (unsigned i = 0; i < hierarchy_.childCount(from); ++i) {
                next.push_back(ordered(hierarchy_.child(from, i), other, open));
            }
        }
        return next;
    }

    // Sources without area stand second; otherwise the order of the keys makes the pair independent of how it
    // was reached.
    Query ordered(NodeId a, NodeId b, bool open) const {
        const bool sourceA = isSource(a);
        const bool sourceB = isSource(b);
        if (sourceA != sourceB) {
            return sourceA ? Query{b, a, open} : Query{a, b, open};
        }
        return hierarchy_.key(a) <= hierarchy_.key(b) ? Query{a, b, open} : Query{b, a, open};
    }

    Problem& problem_;
    const Hierarchy& hierarchy_;
    transport::CoefficientService service_;
    float threshold_;
    double minArea_;
    float sceneArea_;
    float tolerance_;
};

}  // namespace

bool refineLinks(Problem& problem, double threshold, const std::function<bool()>& shouldStop) {
    const StageTimer timer(problem.statistics.times.refine);
    problem.hierarchy.pullClusters();
    Refinement refinement(problem, threshold);
    const bool isFirst = problem.links.links.empty();
    std::vector<Query> pairs = isFirst ? refinement.fromRoot() : refinement.fromStandingLinks();
    const bool changed = !pairs.empty();
    while (!pairs.empty()) {
        if (shouldStop && shouldStop()) {
            refinement.acceptAll();
        }
        pairs = refinement.runWave(pairs);
    }
    const Hierarchy& h = problem.hierarchy;
    std::vector<Link>& links = problem.links.links;
    const auto withClusters = std::stable_partition(links.begin(), links.end(), [&h](const Link& link) {
        return h.kind(link.a) == NodeKind::cluster || h.kind(link.b) == NodeKind::cluster;
    });
    problem.links.clusterLinks = static_cast<std::size_t>(withClusters - links.begin());
    problem.links.index(problem.hierarchy.nodeCount());
    Counters& counters = problem.statistics.counters;
    counters.nodes = problem.hierarchy.nodeCount();
    counters.leaves = problem.hierarchy.leafCount();
    counters.links = problem.links.links.size();
    counters.bytesNodes = counters.nodes * Hierarchy::bytesPerNode();
    counters.bytesLinks = problem.links.bytes();
    return changed;
}

}  // namespace fluxwalk::solve
