#pragma once

#include "core/surface/control_cage.h"
#include "core/surface/polygon_mesh.h"

namespace fluxwalk::io {

/// Triangles of a control mesh, as files store them.
struct CageTriangles {
    surface::TriangleSoup soup;
    /// FB_ngon_encoding: triangles in a row with the same first vertex are a fan and make one polygon.
    bool areFans = false;
};

/// Puts a control mesh together: vertices at bitwise the same place become one (files repeat them where
/// normals or texture coordinates differ), triangles become polygons again: by their encoding, or, in the
/// scheme of Catmull and Clark, by pairs that make a planar, convex quad (neighbours in the list first, then
/// those with the longest common edge). Polygons that collapse to a line are left out.
surface::ControlCage assembleCage(const std::vector<CageTriangles>& parts, surface::SubdivisionScheme scheme);

/// Makes edges infinitely sharp whose faces' normals differ by more than `degrees`.
void sharpenEdges(surface::ControlCage& cage, double degrees);

}  // namespace fluxwalk::io
