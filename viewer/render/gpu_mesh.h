#pragma once

#include <memory>

#include "core/base/bounds.h"
#include "core/scene/lit_mesh.h"
#include "viewer/gl/objects.h"
#include "viewer/render/exposure.h"

namespace fluxwalk::render {

/// A lit side on the GPU.
class GpuMesh {
  public:
    GpuMesh(const gl::Functions& gl, std::shared_ptr<const scene::LitMesh> source, MeshLuminance luminance);

    const scene::LitMesh& source() const { return *source_; }
    const std::shared_ptr<const scene::LitMesh>& sourcePointer() const { return source_; }
    const MeshLuminance& luminance() const { return luminance_; }
    const base::Box& bounds() const { return bounds_; }
    void draw(const gl::Functions& gl) const;

  private:
    std::shared_ptr<const scene::LitMesh> source_;
    MeshLuminance luminance_;
    base::Box bounds_;
    gl::VertexArray array_;
    gl::Buffer positions_;
    gl::Buffer irradiance_;
    gl::Buffer indices_;
    gl::Buffer texcoords0_;
    gl::Buffer texcoords1_;
};

}  // namespace fluxwalk::render
