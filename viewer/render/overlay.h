#pragma once

#include <memory>
#include <vector>

#include "core/base/bounds.h"
#include "core/scene/lit_mesh.h"
#include "viewer/gl/objects.h"
#include "viewer/render/color_map.h"

namespace fluxwalk::render {

/// A lit mesh with a colour for each of its triangles, and lines along some of its edges.
struct FaceColors {
    std::shared_ptr<const scene::LitMesh> mesh;
    std::vector<Color8> colors;        ///< by triangle; empty where only lines are drawn
    std::vector<std::uint32_t> edges;  ///< two vertices each
};

/// From where an overlay is seen.
struct OverlayView {
    glm::mat4 clipFromWorld{1.0f};
    base::Vec3 eye{0.0f};
};

/// What is drawn instead of lit surfaces or over them, with the depth of what is drawn already.
class Overlay {
  public:
    explicit Overlay(const gl::Functions& gl);

    void setFaces(const std::vector<FaceColors>& faces);
    void setBoxes(const std::vector<base::Box>& boxes);

    bool hasFaces() const { return faces_.count > 0; }

    /// Opaque; `relief` 0 to 1 darkens faces that are seen from the side.
    void drawFaces(const OverlayView& view, float relief) const;
    void drawEdges(const OverlayView& view, bool isOverFaces) const;
    /// Boxes, what is hidden of them faintly.
    void drawBoxes(const OverlayView& view) const;

  private:
    /// Vertices in a row, each with two vectors.
    struct Vertices {
        explicit Vertices(const gl::Functions& gl) : array(gl), buffer(gl) {}
        gl::VertexArray array;
        gl::Buffer buffer;
        GLsizei count = 0;
    };
    struct Vertex {
        base::Vec3 position;
        base::Vec3 second;
    };

    void send(Vertices& vertices, const std::vector<Vertex>& data) const;
    void drawLines(const Vertices& vertices, const OverlayView& view, const glm::vec4& color) const;

    const gl::Functions& gl_;
    gl::Program faceProgram_;
    gl::Program lineProgram_;
    Vertices faces_;
    Vertices edges_;
    Vertices boxes_;
};

}  // namespace fluxwalk::render
