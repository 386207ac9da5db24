#include "viewer/gl/objects.h"

#include <array>
#include <string_view>

#include "core/base/check.h"

namespace fluxwalk::gl {
namespace {

GLuint compile(const Functions& gl, const std::string& name, GLenum stage, std::string_view source) {
    const GLuint shader = gl.CreateShader(stage);
    const char* text = source.data();
    const auto length = static_cast<GLint>(source.size());
    gl.ShaderSource(shader, 1, &text, &length);
    gl.CompileShader(shader);
    GLint compiled = GL_FALSE;
    gl.GetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
    if (compiled == GL_FALSE) {
        std::array<char, 2048> log{};
        gl.GetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), nullptr, log.data());
        FLUXWALK_CHECK_EQ("shader " + name + ": " + log.data(), "");
    }
    return shader;
}

}  // namespace

Program::Program(const Functions& gl, const char* name, std::string_view vertexSource,
                 std::string_view fragmentSource)
    : gl_(gl), name_(name), id_(gl.CreateProgram()) {
    const GLuint vertex = compile(gl, name_, GL_VERTEX_SHADER, vertexSource);
    const GLuint fragment = compile(gl, name_, GL_FRAGMENT_SHADER, fragmentSource);
    gl.AttachShader(id_, vertex);
    gl.AttachShader(id_, fragment);
    gl.LinkProgram(id_);
    gl.DetachShader(id_, vertex);
    gl.DetachShader(id_, fragment);
    gl.DeleteShader(vertex);
    gl.DeleteShader(fragment);
    GLint linked = GL_FALSE;
    gl.GetProgramiv(id_, GL_LINK_STATUS, &linked);
    if (linked == GL_FALSE) {
        std::array<char, 2048> log{};
        gl.GetProgramInfoLog(id_, static_cast<GLsizei>(log.size()), nullptr, log.data());
        FLUXWALK_CHECK_EQ("program " + name_ + ": " + log.data(), "");
    }
}

Program::~Program() {
    gl_.DeleteProgram(id_);
}

void Program::use() const {
    gl_.UseProgram(id_);
}

GLint Program::uniformIfThere(const char* name) const {
    return gl_.GetUniformLocation(id_, name);
}

GLint Program::uniform(const char* name) const {
    const GLint location = uniformIfThere(name);
    FLUXWALK_CHECK_LE(0, location);
    return location;
}

}  // namespace fluxwalk::gl
