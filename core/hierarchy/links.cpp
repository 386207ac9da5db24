#include "core/hierarchy/links.h"

namespace fluxwalk::hierarchy {

void LinkStore::index(std::size_t nodeCount) {
    first_.assign(nodeCount + 1, 0);
    for (const Link& link : links) {
        ++first_[base::index(link.a) + 1];
        if (link.b != link.a) {
            ++first_[base::index(link.b) + 1];
        }
    }
    for (std::size_t i = 0; i < nodeCount; ++i) {
        first_[i + 1] += first_[i];
    }
    ends_.resize(first_.back());
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    for (std::uint32_t l = 0; l < links.size(); ++l) {
        ends_[next[base::index(links[l].a)]++] = l;
        if (links[l].b != links[l].a) {
            ends_[next[base::index(links[l].b)]++] = l;
        }
    }
}

std::size_t LinkStore::bytes() const {
    return links.size() * sizeof(Link) + (first_.size() + ends_.size()) * sizeof(std::uint32_t);
}

}  // namespace fluxwalk::hierarchy
