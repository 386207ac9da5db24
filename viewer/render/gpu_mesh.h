#pragma once

#include <array>
#include <memory>
#include <vector>

#include "core/base/bounds.h"
#include "core/scene/lit_mesh.h"
#include "viewer/gl/objects.h"

namespace fluxwalk::render {

/// A run of triangles that lie together: what is left out as a whole where it is not seen.
struct Chunk {
    base::Box bounds;
    std::uint32_t firstIndex = 0;
    std::uint32_t indexCount = 0;
};

/// A lit side on the GPU: 24 bytes a vertex, 32 or 40 with texture coordinates, and 12 a triangle. Floats,
/// since packing to halves would cost the window's thread more than it saves.
class GpuMesh {
  public:
    GpuMesh(const gl::Functions& gl, std::shared_ptr<const scene::LitMesh> source);

    /// Shows another state of the same side: sends only the blocks of its arrays that differ. Returns the
    /// bytes sent.
    std::size_t update(std::shared_ptr<const scene::LitMesh> source);

    const scene::LitMesh& source() const { return *source_; }
    const base::Box& bounds() const { return bounds_; }
    /// In the order of the triangles, some thousand each.
    const std::vector<Chunk>& chunks() const { return chunks_; }

    /// To be called before draw().
    void bind() const;
    void draw(const Chunk& chunk) const;

  private:
    void makeChunks();
    std::size_t sendAttributes(const scene::LitMesh& before);

    const gl::Functions& gl_;
    std::shared_ptr<const scene::LitMesh> source_;
    base::Box bounds_;
    std::vector<Chunk> chunks_;
    gl::VertexArray array_;
    gl::Buffer positions_;
    gl::Buffer irradiance_;
    gl::Buffer indices_;
    std::array<gl::Buffer, 2> texcoords_;
};

}  // namespace fluxwalk::render
