#include "viewer/render/overlay.h"

#include <cstddef>
#include <string>

#include "viewer/gl/shaders.h"

namespace fluxwalk::render {
namespace {

// Blue is what lit rooms have least of; coloured faces take a light veil.
constexpr glm::vec4 kEdgeColor{0.05f, 0.55f, 0.95f, 0.6f};
constexpr glm::vec4 kEdgeColorOverFaces{1.0f, 1.0f, 1.0f, 0.38f};
constexpr glm::vec4 kBoxColor{0.98f, 0.72f, 0.25f, 0.9f};
constexpr glm::vec4 kHiddenBoxColor{0.98f, 0.72f, 0.25f, 0.12f};

std::string withVersion(std::string_view source) {
    return std::string(gl::shaders::kVersion) + std::string(source);
}

}  // namespace

Overlay::Overlay(const gl::Functions& gl)
    : gl_(gl),
      faceProgram_(gl, "face", withVersion(gl::shaders::kFaceVertex),
                   withVersion(gl::shaders::kFaceFragment)),
      lineProgram_(gl, "line", withVersion(gl::shaders::kLineVertex),
                   withVersion(gl::shaders::kLineFragment)),
      faces_(gl),
      edges_(gl),
      boxes_(gl) {}

void Overlay::send(Vertices& vertices, const std::vector<Vertex>& data) const {
    vertices.count = static_cast<GLsizei>(data.size());
    gl_.BindVertexArray(vertices.array.id());
    gl::fillBuffer<Vertex>(gl_, GL_ARRAY_BUFFER, vertices.buffer, data, GL_STATIC_DRAW);
    for (const GLuint location : {0u, 1u}) {
        const std::size_t offset = location == 0 ? offsetof(Vertex, position) : offsetof(Vertex, second);
        gl_.EnableVertexAttribArray(location);
        gl_.VertexAttribPointer(location, 3, GL_FLOAT, GL_FALSE, sizeof(Vertex),
                                reinterpret_cast<const void*>(offset));
    }
    gl_.BindVertexArray(0);
}

void Overlay::setFaces(const std::vector<FaceColors>& faces) {
    std::vector<Vertex> triangles;
    std::vector<Vertex> lines;
    for (const FaceColors& face : faces) {
        const scene::LitMesh& mesh = *face.mesh;
        for (std::size_t t = 0; t < face.colors.size(); ++t) {
            const Color8& c = face.colors[t];
            const base::Vec3 color = base::Vec3(c[0], c[1], c[2]) / 255.0f;
            for (std::size_t k = 0; k < 3; ++k) {
                triangles.push_back({mesh.positions[mesh.triangles[3 * t + k]], color});
            }
        }
        for (const std::uint32_t vertex : face.edges) {
            lines.push_back({mesh.positions[vertex], mesh.normals[vertex]});
        }
    }
    send(faces_, triangles);
    send(edges_, lines);
}

void Overlay::setBoxes(const std::vector<base::Box>& boxes) {
    std::vector<Vertex> lines;
    for (const base::Box& box : boxes) {
        const auto corner = [&](unsigned i) {
            return base::Vec3((i & 1u) != 0 ? box.upper.x : box.lower.x,
                              (i & 2u) != 0 ? box.upper.y : box.lower.y,
                              (i & 4u) != 0 ? box.upper.z : box.lower.z);
        };
        for (unsigned i = 0; i < 8; ++i) {
            for (const unsigned axis : {1u, 2u, 4u}) {
                if ((i & axis) == 0) {
                    lines.push_back({corner(i), base::Vec3(0.0f)});
                    lines.push_back({corner(i | axis), base::Vec3(0.0f)});
                }
            }
        }
    }
    send(boxes_, lines);
}

void Overlay::drawFaces(const OverlayView& view, float relief) const {
    faceProgram_.use();
    gl_.UniformMatrix4fv(faceProgram_.uniform("clipFromWorld"), 1, GL_FALSE, &view.clipFromWorld[0][0]);
    gl_.Uniform3f(faceProgram_.uniform("eye"), view.eye.x, view.eye.y, view.eye.z);
    gl_.Uniform1f(faceProgram_.uniform("relief"), relief);
    gl_.BindVertexArray(faces_.array.id());
    gl_.DrawArrays(GL_TRIANGLES, 0, faces_.count);
}

void Overlay::drawLines(const Vertices& vertices, const OverlayView& view, const glm::vec4& color) const {
    gl_.Enable(GL_BLEND);
    gl_.BlendEquation(GL_FUNC_ADD);
    gl_.BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    gl_.DepthMask(GL_FALSE);
    lineProgram_.use();
    gl_.UniformMatrix4fv(lineProgram_.uniform("clipFromWorld"), 1, GL_FALSE, &view.clipFromWorld[0][0]);
    gl_.Uniform3f(lineProgram_.uniform("eye"), view.eye.x, view.eye.y, view.eye.z);
    gl_.Uniform4f(lineProgram_.uniform("lineColor"), color.r, color.g, color.b, color.a);
    gl_.BindVertexArray(vertices.array.id());
    gl_.DrawArrays(GL_LINES, 0, vertices.count);
    gl_.DepthMask(GL_TRUE);
    gl_.Disable(GL_BLEND);
}

void Overlay::drawEdges(const OverlayView& view, bool isOverFaces) const {
    drawLines(edges_, view, isOverFaces ? kEdgeColorOverFaces : kEdgeColor);
}

void Overlay::drawBoxes(const OverlayView& view) const {
    drawLines(boxes_, view, kBoxColor);
    gl_.DepthFunc(GL_GREATER);
    drawLines(boxes_, view, kHiddenBoxColor);
    gl_.DepthFunc(GL_LESS);
}

}  // namespace fluxwalk::render
