#include <array>
#include <cstdio>
#include <string_view>

#include <EGL/egl.h>
#include <EGL/eglext.h>

#include "viewer/gl/context.h"

namespace fluxwalk::gl {
namespace {

[[noreturn]] void fail(const char* what) {
    std::array<char, 16> code{};
    std::snprintf(code.data(), code.size(), "0x%04x", static_cast<unsigned>(eglGetError()));
    throw ContextUnavailable(std::string("EGL: ") + what + " (error " + code.data() + ")");
}

bool hasClientExtension(std::string_view name) {
    const char* extensions = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
    return extensions != nullptr && std::string_view(extensions).find(name) != std::string_view::npos;
}

EGLDisplay openDisplay() {
    if (hasClientExtension("EGL_MESA_platform_surfaceless")) {
        const auto getPlatformDisplay =
            reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(eglGetProcAddress("eglGetPlatformDisplayEXT"));
        if (getPlatformDisplay != nullptr) {
            EGLDisplay display =
                getPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
            if (display != EGL_NO_DISPLAY && eglInitialize(display, nullptr, nullptr) == EGL_TRUE) {
                return display;
            }
        }
    }
    EGLDisplay display = eglGetDisplay(EGL_DEFAULT_DISPLAY);
    if (display == EGL_NO_DISPLAY || eglInitialize(display, nullptr, nullptr) != EGL_TRUE) {
        fail("no display can be opened");
    }
    return display;
}

class EglContext final : public Context {
  public:
    EglContext() : display_(openDisplay()) {
        try {
            create();
            makeCurrent();
            load(&eglGetProcAddress);
        } catch (...) {
            release();
            throw;
        }
    }
    ~EglContext() override { release(); }

    std::string_view kind() const override { return "EGL"; }

    void makeCurrent() override {
        if (eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) != EGL_TRUE) {
            fail("the context cannot be used without a surface");
        }
    }

  private:
    void create() {
        if (eglBindAPI(EGL_OPENGL_API) != EGL_TRUE) {
            fail("desktop OpenGL is not offered");
        }
        const std::array<EGLint, 5> wanted{EGL_SURFACE_TYPE, EGL_PBUFFER_BIT, EGL_RENDERABLE_TYPE,
                                           EGL_OPENGL_BIT, EGL_NONE};
        EGLConfig config = nullptr;
        EGLint count = 0;
        if (eglChooseConfig(display_, wanted.data(), &config, 1, &count) != EGL_TRUE || count == 0) {
            fail("no framebuffer configuration for OpenGL");
        }
        const std::array<EGLint, 7> attributes{EGL_CONTEXT_MAJOR_VERSION,
                                               3,
                                               EGL_CONTEXT_MINOR_VERSION,
                                               3,
                                               EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                               EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                               EGL_NONE};
        context_ = eglCreateContext(display_, config, EGL_NO_CONTEXT, attributes.data());
        if (context_ == EGL_NO_CONTEXT) {
            fail("an OpenGL 3.3 core context is refused");
        }
    }

    /// The display stays initialised: it is one object for the whole process and others may hold it.
    void release() {
        if (context_ != EGL_NO_CONTEXT) {
            eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
            eglDestroyContext(display_, context_);
        }
    }

    EGLDisplay display_;
    EGLContext context_ = EGL_NO_CONTEXT;
};

}  // namespace

std::unique_ptr<Context> makeEglContext() {
    return std::make_unique<EglContext>();
}

}  // namespace fluxwalk::gl
