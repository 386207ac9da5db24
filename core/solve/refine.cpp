#include "core/solve/refine.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "core/base/photometry.h"
#include "core/hierarchy/local_frame.h"
#include "core/solve/assess_link.h"
#include "core/solve/cluster_pairs.h"
#include "core/solve/facing.h"
#include "core/solve/link_order.h"
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
/// Pairs of a wave that are decided between two looks at who calls.
constexpr std::size_t kStretch = 2048;

class Refinement {
  public:
    Refinement(Problem& problem, double threshold)
        : problem_(problem),
          hierarchy_(problem.hierarchy),
          service_(problem.hierarchy, problem.rays, problem.options.clusterModel,
                   problem.options.visibilityRays),
          threshold_(static_cast<float>(threshold)),
          minArea_(problem.minArea()),
          sceneArea_(static_cast<float>(problem.hierarchy.totalArea())),
          tolerance_(1e-6f * static_cast<float>(problem.scene->bounds().diagonal())) {}

    // What starts the first refinement, and any that begins anew: the root sees itself.
    void beginAtRoot() {
        if (hierarchy_.root() != NodeId::none) {
            Decision d;
            d.link.a = d.link.b = hierarchy_.root();
            d.verdict = Verdict::splitSelf;
            problem_.pending.push_back(d);
        }
    }

    // Takes the links whose error has become too large out of the store.
    void beginAtStandingLinks() {
        std::vector<Link>& links = problem_.links.links;
        std::vector<Decision> decisions(links.size());
        problem_.executor.forRange(links.size(), 4096, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                decisions[i].link = links[i];
                judge(decisions[i]);
            }
        });
        links.clear();
        sortIn(decisions);
    }

    enum class Wave : std::uint8_t {
        done,
        calledAway,
        noRoom  ///< the budget has none for any part of it
    };

    // One wave: splits what is most in need of it and decides on what comes of that. What was not reached
    // when called away is pending again.
    Wave runWave(const Budget& budget, const std::function<bool(std::span<const Decision>)>& isCalledAway) {
        const std::vector<Decision> opened =
            takeNext(problem_.pending, hierarchy_, budget, problem_.links.links.size());
        if (opened.empty()) {
            return Wave::noRoom;
        }
        const std::vector<Query> pairs = openPairs(problem_.hierarchy, problem_.executor, opened);
        std::size_t next = 0;
        for (std::size_t pair = 0; next < opened.size();) {
            const std::span<const Decision> rest = std::span(opened).subspan(next);
            if (isCalledAway && isCalledAway(rest)) {
                problem_.pending.insert(problem_.pending.end(), rest.begin(), rest.end());
                return Wave::calledAway;
            }
            const std::size_t first = pair;
            for (; next < opened.size() && pair - first < kStretch; ++next) {
                pair += countParts(hierarchy_, opened[next]);
                note(opened[next]);
            }
            decideAll(std::span(pairs).subspan(first, pair - first));
        }
        ++problem_.statistics.counters.waves;
        return Wave::done;
    }

    // From here on every link stands that can.
    void acceptAll() {
        threshold_ = INFINITY;
        std::vector<Decision> pending = std::exchange(problem_.pending, {});
        std::vector<Query> unknown;
        for (const Decision& d : pending) {
            if (!d.canStand()) {
                problem_.pending.push_back(d);
                continue;
            }
            if (d.isComputed) {
                noteStanding(d.error);
                problem_.links.links.push_back(d.link);
            } else {
                unknown.push_back({d.link.a, d.link.b, d.link.isOpen()});
            }
        }
        decideAll(unknown);
        ++problem_.statistics.counters.waves;
    }

    // The largest error in lux of a link that stands without being fine enough, 0 for none.
    float largestError() const { return largestError_; }

  private:
    // Coefficients of all pairs, then accept, drop or keep for the next wave.
    void decideAll(std::span<const Query> pairs) {
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
        sortIn(decisions);
    }

    void sortIn(const std::vector<Decision>& decisions) {
        for (const Decision& d : decisions) {
            if (d.verdict == Verdict::accept) {
                problem_.links.links.push_back(d.link);
                if (threshold_ == INFINITY) {
                    noteStanding(d.error);
                }
            } else if (d.verdict != Verdict::drop) {
                problem_.pending.push_back(d);
            } else {
                note(d);
            }
        }
    }

    void note(const Decision& d) {
        if (problem_.keepsKnown && d.isComputed && !isCluster(d.link.a) && !isCluster(d.link.b)) {
            problem_.known.note(d.link);
        }
    }

    void noteStanding(float error) { largestError_ = std::max(largestError_, error); }

    bool isSplittable(NodeId id) const { return hierarchy_.canSplit(id, minArea_); }

    Verdict chooseSplit(const Link& link, bool preferA) const {
        const bool canA = isSplittable(link.a);
        const bool canB = isSplittable(link.b);
        if (!canA && !canB) {
            return Verdict::accept;
        }
        return (preferA && canA) || !canB ? Verdict::splitA : Verdict::splitB;
    }

    // How a concave element that sees itself goes on.
    void judgeSelf(Decision& d) const {
        const NodeId id = d.link.a;
        const hierarchy::ElementName name = hierarchy_.name(id);
        if (hierarchy_.surfaceOf(id).exactKernel(name.back) || !isSplittable(id)) {
            d.verdict = Verdict::accept;
            d.error = 0.0f;
            return;
        }
        const Shape& shape = hierarchy_.shape(id);
        const hierarchy::Light& light = hierarchy_.light(id);
        const OracleKind oracle = problem_.options.oracle;
        const float range = oracle == OracleKind::strict ? light.range() : 0.0f;
        d.error =
            limitError(transport::assessSelf(oracle, {.area = shape.exposedArea(),
                                                      .halfAngle = shape.halfAngle,
                                                      .radiosity = base::channelMean(light.radiosity) + range,
                                                      .sceneArea = sceneArea_}));
        d.verdict = d.error <= threshold_ ? Verdict::accept : Verdict::splitSelf;
    }

    // Sampled errors may be infinite where elements touch, and still their link may stand.
    static float limitError(float error) { return std::min(error, std::numeric_limits<float>::max()); }

    // From what the link keeps alone, so that a new pair and a standing link are judged alike.
    void judge(Decision& d) const {
        const Link& link = d.link;
        d.isComputed = true;
        if (link.a == link.b) {
            judgeSelf(d);
            return;
        }
        if (isCluster(link.a) || isCluster(link.b)) {
            if (!problem_.takesClusterLinks()) {
                d.verdict = splitCluster(link.a, link.b);
                return;
            }
            d.error = boundOf(link.a, link.b);
            if (isMinorPair(link.a, link.b)) {
                d.verdict = Verdict::accept;
                return;
            }
            // Points prove nothing.
            const bool isStrict = problem_.options.oracle == OracleKind::strict;
            if (isStrict || !areApart(hierarchy_, link.a, link.b) || link.coupling <= 0.0f) {
                d.verdict = splitCluster(link.a, link.b);
                return;
            }
        }
        const transport::LinkAssessment assessment = assessLink(problem_, link, threshold_);
        d.error = limitError(assessment.error);
        d.verdict = d.error <= threshold_ ? Verdict::accept : chooseSplit(link, assessment.splitA);
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
        if (recall(d)) {
            return d;
        }
        Coefficient c;
        service_.compute(std::span(&pair, 1), std::span(&c, 1));
        count(c, counters);
        // A strict oracle is not content that no sample saw another.
        if (c.isBlocked || (c.coupling <= 0.0f && problem_.options.oracle != OracleKind::strict)) {
            d.isComputed = true;
            return d;
        }
        // Also where the pair will be split: it must be judged as its standing link would be.
        if (const unsigned before = c.rays; service_.settleContact(pair, c)) {
            counters.rays += c.rays - before;
        }
        setCoefficient(d.link, c);
        judge(d);
        return d;
    }

    // Whether the pair's coefficient is known from before; then it is decided on.
    bool recall(Decision& d) const {
        // A strict oracle keeps pairs that no sample saw: these look like dropped ones.
        if (problem_.options.oracle == OracleKind::strict) {
            return false;
        }
        const std::optional<Link> known = problem_.known.find(d.link.a, d.link.b);
        if (!known) {
            return false;
        }
        d.isComputed = true;
        if (known->coupling > 0.0f || known->visibilityBits != 0) {
            d.link = *known;
            judge(d);
        }
        return true;
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
        judgeSelf(d);
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

    float boundOf(NodeId a, NodeId b) const { return boundExchange(hierarchy_, a, b); }
    bool isMinorPair(NodeId a, NodeId b) const { return boundOf(a, b) <= threshold_; }

    // Light sources without area stay with single patches, and nothing is shared through a closed wall or by
    // the two sides of a lamp.
    bool mayLinkClusters(NodeId a, NodeId b) const {
        if ((isCluster(a) && hierarchy_.isPartlyEmitting(a)) ||
            (isCluster(b) && hierarchy_.isPartlyEmitting(b))) {
            return false;
        }
        return problem_.takesClusterLinks() && hierarchy_.shape(a).area > 0.0f &&
               hierarchy_.shape(b).area > 0.0f && hierarchy_.isInOneRoom(a) && hierarchy_.isInOneRoom(b);
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
        const bool mayLink = mayLinkClusters(pair.a, pair.b);
        if (!mayLink || (!isMinorPair(pair.a, pair.b) && !areApart(hierarchy_, pair.a, pair.b))) {
            d.verdict = splitCluster(pair.a, pair.b);
            d.error = mayLink ? boundOf(pair.a, pair.b) : INFINITY;
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
        judge(d);
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

    Problem& problem_;
    const Hierarchy& hierarchy_;
    transport::CoefficientService service_;
    float threshold_;
    double minArea_;
    float sceneArea_;
    float tolerance_;
    float largestError_ = 0.0f;
};

}  // namespace

Refined refineLinks(Problem& problem, double threshold, const Budget& budget,
                    const std::function<bool()>& shouldStop,
                    const std::function<bool(std::span<const Decision>)>& isCalledAway) {
    const StageTimer timer(problem.statistics.times.refine);
    Refinement refinement(problem, threshold);
    problem.links.clusterLinks = 0;
    if (problem.pending.empty()) {
        problem.hierarchy.pullClusters();
        if (problem.links.links.empty()) {
            refinement.beginAtRoot();
        } else {
            refinement.beginAtStandingLinks();
        }
    }
    Refined refined;
    refined.hasChanged = !problem.pending.empty();
    bool isEnding = false;
    while (!problem.pending.empty()) {
        if (isEnding || (shouldStop && shouldStop())) {
            refinement.acceptAll();
        }
        if (problem.pending.empty()) {
            break;
        }
        // Pairs that cannot stand are opened to the end.
        const auto wave = refinement.runWave(budget, isEnding ? nullptr : isCalledAway);
        if (wave == Refinement::Wave::noRoom) {
            refined.limit = budget.nearest(problem.hierarchy.nodeCount(), problem.linkCount());
            refinement.acceptAll();
        }
        isEnding = isEnding || wave == Refinement::Wave::calledAway;
    }
    problem.statistics.largestError = std::max(threshold, static_cast<double>(refinement.largestError()));
    orderLinks(problem);
    countLinks(problem);
    return refined;
}

}  // namespace fluxwalk::solve
