#pragma once

#include <array>
#include <atomic>
#include <vector>

#include "core/image/make_once.h"
#include "core/transport/element_part.h"
#include "core/transport/element_points.h"

namespace fluxwalk::image {

using base::NodeId;
using base::Rgb;
using base::Vec3d;

/// A part of an element (transport/element_part.h) as a source.
struct SourcePart {
    transport::ElementPoints points;
    surface::Region region;
};

/// Radiosity of the quarters of an element's quarters in lm/m2: that of quarter j of quarter i at 4 i + j.
inline constexpr std::size_t kCells = 16;
using CellLight = std::array<Rgb, kCells>;

/// What kernels see of the elements that light comes from and of their parts: made when first asked for, 1 kB
/// each, for any number of threads.
class SourcePoints {
  public:
    explicit SourcePoints(const hierarchy::Hierarchy& hierarchy);
    ~SourcePoints();
    SourcePoints(const SourcePoints&) = delete;
    SourcePoints& operator=(const SourcePoints&) = delete;

    const transport::ElementPoints& of(NodeId element);
    /// `part` is not the whole.
    const SourcePart& of(NodeId element, transport::Path part);
    /// Bytes of all parts, 5 kB for four.
    std::size_t partBytes() const { return partBytes_.load(std::memory_order_relaxed); }
    /// While nobody else is at work here, and no sources that were found with these are left.
    void forgetParts();

    /// `make` returns it as a std::unique_ptr the first time.
    template <class Make>
    const CellLight& light(NodeId element, const Make& make) {
        return findOrMake(light_[base::index(element)], make);
    }

  private:
    struct Quarters;

    const hierarchy::Hierarchy& hierarchy_;
    std::vector<std::atomic<const transport::ElementPoints*>> points_;
    std::vector<std::atomic<Quarters*>> quarters_;
    std::atomic<std::size_t> partBytes_{0};
    std::vector<std::atomic<CellLight*>> light_;
};

/// Form factors of an element's source at eight points, unoccluded, as if all of it were exposed.
base::Lanes computeFactors(const base::Lanes3& x, const base::Lanes3& normal,
                           const transport::ElementPoints& source);

}  // namespace fluxwalk::image
