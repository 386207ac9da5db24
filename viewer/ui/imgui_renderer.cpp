#include "viewer/ui/imgui_renderer.h"

#include <cstddef>
#include <cstdint>
#include <string>

#include <imgui.h>

#include "viewer/gl/shaders.h"

namespace fluxwalk::ui {
namespace {

std::string withVersion(std::string_view source) {
    return std::string(gl::shaders::kVersion) + std::string(source);
}

}  // namespace

void* textureId(GLuint texture) {
    return reinterpret_cast<void*>(static_cast<std::uintptr_t>(texture));
}

ImguiRenderer::ImguiRenderer(const gl::Functions& gl)
    : gl_(gl),
      program_(gl, "panel", withVersion(gl::shaders::kPanelVertex), withVersion(gl::shaders::kPanelFragment)),
      glyphs_(gl),
      array_(gl),
      vertices_(gl),
      indices_(gl) {
    ImGuiIO& io = ImGui::GetIO();
    io.BackendRendererName = "fluxwalk";
    io.BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;
    takeGlyphs();

    gl.BindVertexArray(array_.id());
    gl.BindBuffer(GL_ARRAY_BUFFER, vertices_.id());
    gl.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_.id());
    const auto attribute = [&](GLuint location, GLint size, GLenum type, GLboolean normalized,
                               std::size_t offset) {
        gl.EnableVertexAttribArray(location);
        gl.VertexAttribPointer(location, size, type, normalized, sizeof(ImDrawVert),
                               reinterpret_cast<const void*>(offset));
    };
    attribute(0, 2, GL_FLOAT, GL_FALSE, offsetof(ImDrawVert, pos));
    attribute(1, 2, GL_FLOAT, GL_FALSE, offsetof(ImDrawVert, uv));
    attribute(2, 4, GL_UNSIGNED_BYTE, GL_TRUE, offsetof(ImDrawVert, col));
    gl.BindVertexArray(0);
}

void ImguiRenderer::takeGlyphs() {
    unsigned char* pixels = nullptr;
    int width = 0;
    int height = 0;
    ImGui::GetIO().Fonts->GetTexDataAsRGBA32(&pixels, &width, &height);
    gl_.ActiveTexture(GL_TEXTURE0);
    gl_.BindTexture(GL_TEXTURE_2D, glyphs_.id());
    gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    gl_.PixelStorei(GL_UNPACK_ALIGNMENT, 4);
    gl_.TexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE, pixels);
    ImGui::GetIO().Fonts->SetTexID(textureId(glyphs_.id()));
}

void ImguiRenderer::draw(const ImDrawData& data) const {
    const ImVec2 scale = data.FramebufferScale;
    const auto width = static_cast<GLsizei>(data.DisplaySize.x * scale.x);
    const auto height = static_cast<GLsizei>(data.DisplaySize.y * scale.y);
    if (width <= 0 || height <= 0) {
        return;
    }
    gl_.Viewport(0, 0, width, height);
    gl_.Disable(GL_DEPTH_TEST);
    gl_.Disable(GL_CULL_FACE);
    gl_.Enable(GL_SCISSOR_TEST);
    gl_.Enable(GL_BLEND);
    gl_.BlendEquation(GL_FUNC_ADD);
    gl_.BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    program_.use();
    gl_.Uniform1i(program_.uniform("glyphs"), 0);
    const float sx = 2.0f / data.DisplaySize.x;
    const float sy = -2.0f / data.DisplaySize.y;
    gl_.Uniform4f(program_.uniform("clipFromPixels"), sx, sy, -1.0f - data.DisplayPos.x * sx,
                  1.0f - data.DisplayPos.y * sy);
    gl_.ActiveTexture(GL_TEXTURE0);
    gl_.BindVertexArray(array_.id());
    for (int i = 0; i < data.CmdListsCount; ++i) {
        const ImDrawList& list = *data.CmdLists[i];
        gl::fillBuffer<ImDrawVert>(gl_, GL_ARRAY_BUFFER, vertices_,
                                   {list.VtxBuffer.Data, static_cast<std::size_t>(list.VtxBuffer.Size)},
                                   GL_STREAM_DRAW);
        gl::fillBuffer<ImDrawIdx>(gl_, GL_ELEMENT_ARRAY_BUFFER, indices_,
                                  {list.IdxBuffer.Data, static_cast<std::size_t>(list.IdxBuffer.Size)},
                                  GL_STREAM_DRAW);
        for (const ImDrawCmd& command : list.CmdBuffer) {
            const auto left = static_cast<GLint>((command.ClipRect.x - data.DisplayPos.x) * scale.x);
            const auto top = static_cast<GLint>((command.ClipRect.y - data.DisplayPos.y) * scale.y);
            const auto right = static_cast<GLint>((command.ClipRect.z - data.DisplayPos.x) * scale.x);
            const auto bottom = static_cast<GLint>((command.ClipRect.w - data.DisplayPos.y) * scale.y);
            if (right <= left || bottom <= top) {
                continue;
            }
            gl_.BindTexture(GL_TEXTURE_2D,
                            static_cast<GLuint>(reinterpret_cast<std::uintptr_t>(command.GetTexID())));
            gl_.Scissor(left, height - bottom, right - left, bottom - top);
            gl_.DrawElementsBaseVertex(GL_TRIANGLES, static_cast<GLsizei>(command.ElemCount),
                                       GL_UNSIGNED_SHORT,
                                       reinterpret_cast<const void*>(command.IdxOffset * sizeof(ImDrawIdx)),
                                       static_cast<GLint>(command.VtxOffset));
        }
    }
    gl_.BindVertexArray(0);
    gl_.Disable(GL_SCISSOR_TEST);
    gl_.Disable(GL_BLEND);
}

}  // namespace fluxwalk::ui
