#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>

#include "viewer/gl/functions.h"

/// GL objects that free themselves. Each holds the functions of its context, which must outlive it.
namespace fluxwalk::gl {

/// One name from a glGen*() function; movable, owned by one.
template <auto Generate, auto Delete>
class Object {
  public:
    explicit Object(const Functions& gl) : gl_(&gl) { (gl.*Generate)(1, &id_); }
    ~Object() {
        if (id_ != 0) {
            (gl_->*Delete)(1, &id_);
        }
    }
    Object(Object&& other) noexcept : gl_(other.gl_), id_(std::exchange(other.id_, 0)) {}
    Object& operator=(Object&& other) noexcept {
        std::swap(gl_, other.gl_);
        std::swap(id_, other.id_);
        return *this;
    }

    GLuint id() const { return id_; }

  private:
    const Functions* gl_;
    GLuint id_ = 0;
};

using Buffer = Object<&Functions::GenBuffers, &Functions::DeleteBuffers>;
using VertexArray = Object<&Functions::GenVertexArrays, &Functions::DeleteVertexArrays>;
using Texture = Object<&Functions::GenTextures, &Functions::DeleteTextures>;
using Framebuffer = Object<&Functions::GenFramebuffers, &Functions::DeleteFramebuffers>;
using Renderbuffer = Object<&Functions::GenRenderbuffers, &Functions::DeleteRenderbuffers>;

/// Binds `buffer` to `target` and fills it.
template <class T>
void fillBuffer(const Functions& gl, GLenum target, const Buffer& buffer, std::span<const T> data,
                GLenum usage) {
    gl.BindBuffer(target, buffer.id());
    gl.BufferData(target, static_cast<GLsizeiptr>(data.size_bytes()), data.data(), usage);
}

/// A linked vertex and fragment shader. A source that does not compile is a bug and says why.
class Program {
  public:
    Program(const Functions& gl, const char* name, std::string_view vertexSource,
            std::string_view fragmentSource);
    ~Program();
    Program(const Program&) = delete;
    Program& operator=(const Program&) = delete;

    void use() const;
    /// Location of a uniform that must exist.
    GLint uniform(const char* name) const;
    /// The same of one that only some variants of a program have: -1, which GL ignores, in the others.
    GLint uniformIfThere(const char* name) const;

  private:
    const Functions& gl_;
    std::string name_;
    GLuint id_;
};

}  // namespace fluxwalk::gl
