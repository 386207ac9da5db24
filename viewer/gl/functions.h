#pragma once

// glcorearb.h must come before anything that includes GL/gl.h, which would hide the types of GL 1.0 and 1.1.
#include <string>
#include <vector>

#include <GL/glcorearb.h>

/// What the viewer needs of OpenGL 3.3 core, and no more.
namespace fluxwalk::gl {

/// Every GL function in use: X(SUFFIX, Suffix) for PFNGL<SUFFIX>PROC and gl<Suffix>.
#define FLUXWALK_GL_FUNCTIONS(X)                                      \
    X(ACTIVETEXTURE, ActiveTexture)                                   \
    X(ATTACHSHADER, AttachShader)                                     \
    X(BINDBUFFER, BindBuffer)                                         \
    X(BINDFRAMEBUFFER, BindFramebuffer)                               \
    X(BINDRENDERBUFFER, BindRenderbuffer)                             \
    X(BINDTEXTURE, BindTexture)                                       \
    X(BINDVERTEXARRAY, BindVertexArray)                               \
    X(BLENDEQUATION, BlendEquation)                                   \
    X(BLENDFUNCSEPARATE, BlendFuncSeparate)                           \
    X(BLITFRAMEBUFFER, BlitFramebuffer)                               \
    X(BUFFERDATA, BufferData)                                         \
    X(BUFFERSUBDATA, BufferSubData)                                   \
    X(CHECKFRAMEBUFFERSTATUS, CheckFramebufferStatus)                 \
    X(CLEAR, Clear)                                                   \
    X(CLEARCOLOR, ClearColor)                                         \
    X(COMPILESHADER, CompileShader)                                   \
    X(CREATEPROGRAM, CreateProgram)                                   \
    X(CREATESHADER, CreateShader)                                     \
    X(CULLFACE, CullFace)                                             \
    X(DELETEBUFFERS, DeleteBuffers)                                   \
    X(DELETEFRAMEBUFFERS, DeleteFramebuffers)                         \
    X(DELETEPROGRAM, DeleteProgram)                                   \
    X(DELETERENDERBUFFERS, DeleteRenderbuffers)                       \
    X(DELETESHADER, DeleteShader)                                     \
    X(DELETETEXTURES, DeleteTextures)                                 \
    X(DELETEVERTEXARRAYS, DeleteVertexArrays)                         \
    X(DEPTHFUNC, DepthFunc)                                           \
    X(DEPTHMASK, DepthMask)                                           \
    X(DETACHSHADER, DetachShader)                                     \
    X(DISABLE, Disable)                                               \
    X(DISABLEVERTEXATTRIBARRAY, DisableVertexAttribArray)             \
    X(DRAWARRAYS, DrawArrays)                                         \
    X(DRAWELEMENTS, DrawElements)                                     \
    X(DRAWELEMENTSBASEVERTEX, DrawElementsBaseVertex)                 \
    X(ENABLE, Enable)                                                 \
    X(ENABLEVERTEXATTRIBARRAY, EnableVertexAttribArray)               \
    X(FINISH, Finish)                                                 \
    X(FRAMEBUFFERRENDERBUFFER, FramebufferRenderbuffer)               \
    X(FRAMEBUFFERTEXTURE2D, FramebufferTexture2D)                     \
    X(GENBUFFERS, GenBuffers)                                         \
    X(GENFRAMEBUFFERS, GenFramebuffers)                               \
    X(GENRENDERBUFFERS, GenRenderbuffers)                             \
    X(GENTEXTURES, GenTextures)                                       \
    X(GENVERTEXARRAYS, GenVertexArrays)                               \
    X(GENERATEMIPMAP, GenerateMipmap)                                 \
    X(GETERROR, GetError)                                             \
    X(GETFLOATV, GetFloatv)                                           \
    X(GETINTEGERV, GetIntegerv)                                       \
    X(GETPROGRAMINFOLOG, GetProgramInfoLog)                           \
    X(GETPROGRAMIV, GetProgramiv)                                     \
    X(GETSHADERINFOLOG, GetShaderInfoLog)                             \
    X(GETSHADERIV, GetShaderiv)                                       \
    X(GETSTRING, GetString)                                           \
    X(GETSTRINGI, GetStringi)                                         \
    X(GETTEXIMAGE, GetTexImage)                                       \
    X(GETUNIFORMLOCATION, GetUniformLocation)                         \
    X(LINKPROGRAM, LinkProgram)                                       \
    X(PIXELSTOREI, PixelStorei)                                       \
    X(READPIXELS, ReadPixels)                                         \
    X(RENDERBUFFERSTORAGEMULTISAMPLE, RenderbufferStorageMultisample) \
    X(SCISSOR, Scissor)                                               \
    X(SHADERSOURCE, ShaderSource)                                     \
    X(TEXIMAGE2D, TexImage2D)                                         \
    X(TEXPARAMETERF, TexParameterf)                                   \
    X(TEXPARAMETERI, TexParameteri)                                   \
    X(TEXSUBIMAGE2D, TexSubImage2D)                                   \
    X(UNIFORM1F, Uniform1f)                                           \
    X(UNIFORM1I, Uniform1i)                                           \
    X(UNIFORM2F, Uniform2f)                                           \
    X(UNIFORM3F, Uniform3f)                                           \
    X(UNIFORM4F, Uniform4f)                                           \
    X(UNIFORMMATRIX3FV, UniformMatrix3fv)                             \
    X(UNIFORMMATRIX4FV, UniformMatrix4fv)                             \
    X(USEPROGRAM, UseProgram)                                         \
    X(VERTEXATTRIBPOINTER, VertexAttribPointer)                       \
    X(VIEWPORT, Viewport)

// NOLINTBEGIN(readability-identifier-naming): the names of the GL registry
/// The functions of one context, named as in the GL registry. Valid while that context lives.
struct Functions {
#define FLUXWALK_GL_DECLARE(SUFFIX, Suffix) PFNGL##SUFFIX##PROC Suffix = nullptr;
    FLUXWALK_GL_FUNCTIONS(FLUXWALK_GL_DECLARE)
#undef FLUXWALK_GL_DECLARE
};
// NOLINTEND(readability-identifier-naming)

/// How a context finds a function by name; returns null for unknown ones.
using FindFunction = void (*(*)(const char* name))();

/// Fills `functions` through `find` and returns the names that it does not know.
std::vector<std::string> loadFunctions(Functions& functions, FindFunction find);

}  // namespace fluxwalk::gl
