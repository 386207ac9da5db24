#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/solve/row_scaling.h"
#include "tests/support/solving.h"

namespace fluxwalk::test {

/// Jacobi and sequential Gauss-Seidel over the links of a refined problem, one leaf after the other, green
/// channel, constant ends; of the solver's sweeps they share what the leaves keep (solve::limitRows), nothing
/// else.
class PlainSweeps {
  public:
    enum class Order : std::uint8_t { jacobi, gaussSeidel };

    explicit PlainSweeps(const Problem& problem) : problem_(problem), leaves_(leavesOf(problem.hierarchy)) {
        const std::vector<float> kept = solve::limitRows(problem);
        for (const NodeId leaf : leaves_) {
            const auto part = kept.empty() ? 1.0 : static_cast<double>(kept[base::index(leaf)]);
            gathers_.emplace_back();
            for (NodeId id = leaf; isElement(id); id = problem.hierarchy.parent(id)) {
                const double area = static_cast<double>(problem.hierarchy.shape(id).exposedArea());
                for (const std::uint32_t l : problem.links.endingAt(id)) {
                    const hierarchy::Link& link = problem.links.links[l];
                    const NodeId source = link.a == id ? link.b : link.a;
                    gathers_.back().push_back(
                        {base::index(source), part * static_cast<double>(link.transfer()) / area});
                }
            }
        }
    }

    /// Radiosities of the leaves, as the solver has them.
    std::vector<double> radiosities() const {
        std::vector<double> values;
        for (const NodeId leaf : leaves_) {
            values.push_back(static_cast<double>(problem_.hierarchy.light(leaf).radiosity.g));
        }
        return values;
    }

    std::vector<double> solve() const {
        State state(*this);
        for (int i = 0; i < 200; ++i) {
            state.sweep(Order::gaussSeidel);
        }
        return state.leafValues();
    }

    int sweepsNeeded(Order order, const std::vector<double>& exact, double accuracy) const {
        State state(*this);
        for (int i = 1; i < 1000; ++i) {
            state.sweep(order);
            if (errorOf(state.leafValues(), exact) <= accuracy) {
                return i;
            }
        }
        return 1000;
    }

    /// Power that is wrong, as a part of all.
    double errorOf(const std::vector<double>& values, const std::vector<double>& exact) const {
        double wrong = 0.0;
        double all = 0.0;
        for (std::size_t i = 0; i < leaves_.size(); ++i) {
            const double area = areaOf(leaves_[i]);
            wrong += area * std::abs(values[i] - exact[i]);
            all += area * exact[i];
        }
        return wrong / all;
    }

  private:
    struct Gather {
        std::uint32_t source = 0;
        double factor = 0.0;
    };

    /// Radiosities of all nodes, those of inner nodes being the means of their leaves.
    class State {
      public:
        explicit State(const PlainSweeps& plain)
            : plain_(plain), values_(plain.problem_.hierarchy.nodeCount()) {
            for (const NodeId leaf : plain.leaves_) {
                set(leaf, static_cast<double>(plain.problem_.hierarchy.light(leaf).emission.g));
            }
        }

        void sweep(Order order) {
            const std::vector<double> before = values_;
            const std::vector<double>& read = order == Order::jacobi ? before : values_;
            for (std::size_t i = 0; i < plain_.leaves_.size(); ++i) {
                double irradiance = 0.0;
                for (const Gather& gather : plain_.gathers_[i]) {
                    irradiance += gather.factor * read[gather.source];
                }
                const hierarchy::Light& light = plain_.problem_.hierarchy.light(plain_.leaves_[i]);
                set(plain_.leaves_[i], static_cast<double>(light.emission.g) +
                                           static_cast<double>(light.reflectance.g) * irradiance);
            }
        }

        std::vector<double> leafValues() const {
            std::vector<double> values;
            for (const NodeId leaf : plain_.leaves_) {
                values.push_back(values_[base::index(leaf)]);
            }
            return values;
        }

      private:
        void set(NodeId leaf, double value) {
            const double change = (value - values_[base::index(leaf)]) * plain_.areaOf(leaf);
            for (NodeId id = leaf; plain_.isElement(id); id = plain_.problem_.hierarchy.parent(id)) {
                values_[base::index(id)] += change / plain_.areaOf(id);
            }
        }

        const PlainSweeps& plain_;
        std::vector<double> values_;
    };

    bool isElement(NodeId id) const {
        return id != NodeId::none && problem_.hierarchy.kind(id) == hierarchy::NodeKind::element;
    }
    double areaOf(NodeId id) const { return static_cast<double>(problem_.hierarchy.shape(id).exposedArea()); }

    const Problem& problem_;
    std::vector<NodeId> leaves_;
    std::vector<std::vector<Gather>> gathers_;  ///< by leaf: its own links and those of its ancestors
};

}  // namespace fluxwalk::test
