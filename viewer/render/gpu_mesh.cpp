#include "viewer/render/gpu_mesh.h"

#include "core/base/check.h"

namespace fluxwalk::render {
namespace {

/// Sends one vertex attribute; where `values` is empty the shader reads zeros.
template <class Vector>
void sendAttribute(const gl::Functions& gl, GLuint location, const gl::Buffer& buffer,
                   const std::vector<Vector>& values) {
    if (values.empty()) {
        return;
    }
    gl::fillBuffer<Vector>(gl, GL_ARRAY_BUFFER, buffer, values, GL_STATIC_DRAW);
    gl.EnableVertexAttribArray(location);
    gl.VertexAttribPointer(location, static_cast<GLint>(Vector::length()), GL_FLOAT, GL_FALSE, 0, nullptr);
}

}  // namespace

GpuMesh::GpuMesh(const gl::Functions& gl, std::shared_ptr<const scene::LitMesh> source,
                 MeshLuminance luminance)
    : source_(std::move(source)),
      luminance_(luminance),
      array_(gl),
      positions_(gl),
      irradiance_(gl),
      indices_(gl),
      texcoords0_(gl),
      texcoords1_(gl) {
    FLUXWALK_CHECK_EQ(source_->irradiance.size(), source_->positions.size());
    for (const base::Vec3& position : source_->positions) {
        bounds_.extend(base::Vec3d(position));
    }
    gl.BindVertexArray(array_.id());
    sendAttribute(gl, 0, positions_, source_->positions);
    sendAttribute(gl, 1, irradiance_, source_->irradiance);
    sendAttribute(gl, 2, texcoords0_, source_->texcoords[0]);
    sendAttribute(gl, 3, texcoords1_, source_->texcoords[1]);
    gl::fillBuffer<std::uint32_t>(gl, GL_ELEMENT_ARRAY_BUFFER, indices_, source_->triangles, GL_STATIC_DRAW);
    gl.BindVertexArray(0);
}

void GpuMesh::draw(const gl::Functions& gl) const {
    gl.BindVertexArray(array_.id());
    gl.DrawElements(GL_TRIANGLES, static_cast<GLsizei>(source_->triangles.size()), GL_UNSIGNED_INT, nullptr);
}

}  // namespace fluxwalk::render
