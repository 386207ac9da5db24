#include "viewer/render/gpu_mesh.h"

#include <algorithm>
#include <cstring>

#include "core/base/check.h"

namespace fluxwalk::render {
namespace {

/// Small enough that a view along a wall leaves much of it out, large enough that calls do not count.
constexpr std::size_t kTrianglesOfChunk = 4096;
/// Bytes that are compared and sent together.
constexpr std::size_t kBlock = std::size_t{64} << 10;

/// Makes a buffer hold `values` where it held `before`. Returns the bytes sent.
template <class T>
std::size_t sendChanged(const gl::Functions& gl, GLenum target, const gl::Buffer& buffer,
                        const std::vector<T>& before, const std::vector<T>& values) {
    const std::size_t bytes = values.size() * sizeof(T);
    if (before.size() != values.size()) {
        gl::fillBuffer<T>(gl, target, buffer, values, GL_DYNAMIC_DRAW);
        return bytes;
    }
    const auto* old = reinterpret_cast<const char*>(before.data());
    const auto* now = reinterpret_cast<const char*>(values.data());
    const auto isChanged = [&](std::size_t at) {
        return std::memcmp(old + at, now + at, std::min(kBlock, bytes - at)) != 0;
    };
    std::size_t sent = 0;
    gl.BindBuffer(target, buffer.id());
    for (std::size_t at = 0; at < bytes; at += kBlock) {
        if (isChanged(at)) {
            const std::size_t length = std::min(kBlock, bytes - at);
            gl.BufferSubData(target, static_cast<GLintptr>(at), static_cast<GLsizeiptr>(length), now + at);
            sent += length;
        }
    }
    return sent;
}

template <class T>
bool isSame(const std::vector<T>& a, const std::vector<T>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

/// Where `values` is empty the shader reads zeros.
template <class Vector>
void describeAttribute(const gl::Functions& gl, GLuint location, const gl::Buffer& buffer,
                       const std::vector<Vector>& values) {
    if (values.empty()) {
        gl.DisableVertexAttribArray(location);
        return;
    }
    gl.BindBuffer(GL_ARRAY_BUFFER, buffer.id());
    gl.EnableVertexAttribArray(location);
    gl.VertexAttribPointer(location, static_cast<GLint>(Vector::length()), GL_FLOAT, GL_FALSE, 0, nullptr);
}

}  // namespace

GpuMesh::GpuMesh(const gl::Functions& gl, std::shared_ptr<const scene::LitMesh> source)
    : gl_(gl),
      source_(std::move(source)),
      array_(gl),
      positions_(gl),
      irradiance_(gl),
      indices_(gl),
      texcoords_{gl::Buffer(gl), gl::Buffer(gl)} {
    sendAttributes({});
    makeChunks();
}

std::size_t GpuMesh::update(std::shared_ptr<const scene::LitMesh> source) {
    const std::shared_ptr<const scene::LitMesh> before = std::exchange(source_, std::move(source));
    const std::size_t sent = sendAttributes(*before);
    if (!isSame(before->triangles, source_->triangles) || !isSame(before->positions, source_->positions)) {
        makeChunks();
    }
    return sent;
}

std::size_t GpuMesh::sendAttributes(const scene::LitMesh& before) {
    const scene::LitMesh& mesh = *source_;
    FLUXWALK_CHECK_EQ(mesh.irradiance.size(), mesh.positions.size());
    gl_.BindVertexArray(array_.id());
    std::size_t sent = sendChanged(gl_, GL_ARRAY_BUFFER, positions_, before.positions, mesh.positions) +
                       sendChanged(gl_, GL_ARRAY_BUFFER, irradiance_, before.irradiance, mesh.irradiance) +
                       sendChanged(gl_, GL_ELEMENT_ARRAY_BUFFER, indices_, before.triangles, mesh.triangles);
    describeAttribute(gl_, 0, positions_, mesh.positions);
    describeAttribute(gl_, 1, irradiance_, mesh.irradiance);
    for (std::size_t set = 0; set < texcoords_.size(); ++set) {
        sent +=
            sendChanged(gl_, GL_ARRAY_BUFFER, texcoords_[set], before.texcoords[set], mesh.texcoords[set]);
        describeAttribute(gl_, static_cast<GLuint>(2 + set), texcoords_[set], mesh.texcoords[set]);
    }
    gl_.BindVertexArray(0);
    return sent;
}

void GpuMesh::makeChunks() {
    const std::vector<std::uint32_t>& indices = source_->triangles;
    chunks_.clear();
    bounds_ = {};
    for (std::size_t first = 0; first < indices.size(); first += 3 * kTrianglesOfChunk) {
        const std::size_t end = std::min(first + 3 * kTrianglesOfChunk, indices.size());
        base::Vec3 lower = source_->positions[indices[first]];
        base::Vec3 upper = lower;
        for (std::size_t i = first; i < end; ++i) {
            const base::Vec3& position = source_->positions[indices[i]];
            lower = glm::min(lower, position);
            upper = glm::max(upper, position);
        }
        Chunk chunk;
        chunk.bounds.extend(base::Vec3d(lower));
        chunk.bounds.extend(base::Vec3d(upper));
        chunk.firstIndex = static_cast<std::uint32_t>(first);
        chunk.indexCount = static_cast<std::uint32_t>(end - first);
        bounds_.extend(chunk.bounds);
        chunks_.push_back(chunk);
    }
}

void GpuMesh::bind() const {
    gl_.BindVertexArray(array_.id());
}

void GpuMesh::draw(const Chunk& chunk) const {
    gl_.DrawElements(GL_TRIANGLES, static_cast<GLsizei>(chunk.indexCount), GL_UNSIGNED_INT,
                     reinterpret_cast<const void*>(std::uintptr_t{4} * chunk.firstIndex));
}

}  // namespace fluxwalk::render
