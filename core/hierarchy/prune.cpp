#include <algorithm>

#include "core/base/check.h"
#include "core/hierarchy/hierarchy.h"

namespace fluxwalk::hierarchy {

namespace {

template <class T>
void compact(std::vector<T>& values, const std::vector<NodeId>& places, std::size_t kept) {
    for (std::size_t i = 0; i < places.size(); ++i) {
        if (places[i] != NodeId::none) {
            values[base::index(places[i])] = values[i];
        }
    }
    values.resize(kept);
}

}  // namespace

std::vector<NodeId> Hierarchy::prune(const std::vector<std::uint8_t>& isNeeded) {
    FLUXWALK_CHECK(isNeeded.size() == nodeCount());
    // Children follow their parents, so one pass from the back sees children first.
    std::vector<std::uint8_t> isUsed = isNeeded;
    for (std::size_t i = nodeCount(); i-- > 0;) {
        const bool isBelow = parent_[i] != NodeId::none && kind_[i] == NodeKind::element;
        if (isBelow && isUsed[i] != 0) {
            isUsed[index(parent_[i])] = 1;
        }
    }
    std::vector<NodeId> places(nodeCount(), NodeId::none);
    std::vector<NodeId> bared;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < nodeCount(); ++i) {
        const NodeId above = parent_[i];
        const bool isPart = above != NodeId::none && kind_[index(above)] == NodeKind::element;
        // A block of children stays as long as one of them is used.
        const bool stays = !isPart || firstChild_[index(above)] != NodeId::none;
        if (stays) {
            places[i] = NodeId{static_cast<std::uint32_t>(kept++)};
        }
        if (kind_[i] != NodeKind::element || firstChild_[i] == NodeId::none) {
            continue;
        }
        const std::size_t first = index(firstChild_[i]);
        const bool hasUsed = std::any_of(isUsed.begin() + static_cast<std::ptrdiff_t>(first),
                                         isUsed.begin() + static_cast<std::ptrdiff_t>(first + 4),
                                         [](std::uint8_t used) { return used != 0; });
        if (!stays || !hasUsed) {
            firstChild_[i] = NodeId::none;
            leafCount_ -= 3;
            if (stays) {
                bared.push_back(NodeId{static_cast<std::uint32_t>(i)});
            }
        }
    }
    // What is hidden is known by their own places again.
    for (const NodeId id : bared) {
        Shape& shape = shape_[index(id)];
        if (mayHide_[index(id)] != 0) {
            shape.exposed = static_cast<float>(shape.exposedPlaces) / Shape::kPlaces;
            refreshExposure(parent(id));
        }
    }
    for (std::size_t i = 0; i < nodeCount(); ++i) {
        if (places[i] != NodeId::none) {
            const auto moved = [&places](NodeId id) {
                return id == NodeId::none ? id : places[base::index(id)];
            };
            parent_[i] = moved(parent_[i]);
            firstChild_[i] = moved(firstChild_[i]);
        }
    }
    compact(parent_, places, kept);
    compact(firstChild_, places, kept);
    compact(kind_, places, kept);
    compact(object_, places, kept);
    compact(patchSide_, places, kept);
    compact(path_, places, kept);
    compact(shape_, places, kept);
    compact(light_, places, kept);
    compact(mayHide_, places, kept);
    return places;
}

}  // namespace fluxwalk::hierarchy
