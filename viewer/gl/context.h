#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "core/base/error.h"
#include "viewer/gl/functions.h"

namespace fluxwalk::gl {

/// This machine cannot give the context that was asked for. what() is one line that names the reason.
class ContextUnavailable : public base::UsageError {
  public:
    using base::UsageError::UsageError;
};

/// An OpenGL 3.3 core context, current on the thread that made it. GL objects must be gone before it goes.
class Context {
  public:
    virtual ~Context() = default;
    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;

    /// "EGL", "OSMesa" or "window".
    virtual std::string_view kind() const = 0;
    virtual void makeCurrent() = 0;

    const Functions& functions() const { return functions_; }
    /// GL_RENDERER, for example "llvmpipe (LLVM 15.0.6, 256 bits)".
    const std::string& renderer() const { return renderer_; }
    /// Whether pixels are made by the processor: then every sample and every needless frame counts.
    bool isSoftware() const;

  protected:
    Context() = default;
    /// To be called once the context is current; throws ContextUnavailable where GL 3.3 is incomplete.
    void load(FindFunction find);

  private:
    Functions functions_;
    std::string renderer_;
};

/// Which headless context to make. `automatic` is EGL, or OSMesa where EGL cannot be had.
enum class HeadlessKind { automatic, egl, osmesa };

/// Makes a context without window and display, current on this thread. Throws ContextUnavailable.
std::unique_ptr<Context> makeHeadlessContext(HeadlessKind kind);

/// EGL on Mesa's surfaceless platform, else on EGL's default display. Throws ContextUnavailable.
std::unique_ptr<Context> makeEglContext();
/// Mesa's off-screen renderer, loaded when asked for. Throws ContextUnavailable.
std::unique_ptr<Context> makeOsmesaContext();

}  // namespace fluxwalk::gl
