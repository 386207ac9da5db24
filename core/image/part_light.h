#pragma once

#include <memory>

#include "core/image/leaf_sources.h"
#include "core/image/pixel_gather.h"

namespace fluxwalk::image {

/// Light within leaves: what their parts send, gathered at the parts' middles. Where a picture shows what
/// stands next to a leaf, it shows how the leaf's own light falls off towards that, which the solve has as
/// one linear function. Not for several threads at once.
class PartLight {
  public:
    /// Keeps references to both; what is found is kept in `points`.
    PartLight(const solve::Problem& problem, SourcePoints& points);

    /// Of each quarter of each quarter of a leaf. The same for any order of calls.
    const CellLight& of(NodeId leaf);

  private:
    std::unique_ptr<CellLight> gather(NodeId leaf);

    const solve::Problem& problem_;
    SourcePoints& points_;
    SourceFinder finder_;
    PixelGather gather_;
};

}  // namespace fluxwalk::image
