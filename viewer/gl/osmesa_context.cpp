#include <array>

#include <dlfcn.h>

#include "viewer/gl/context.h"

// GL/osmesa.h includes GL/gl.h, and linking libOSMesa would bring a second set of gl* symbols into a program
// that has libGL's: so its four functions are declared here and looked up in a library opened for itself.
namespace fluxwalk::gl {
namespace {

constexpr const char* kLibrary = "libOSMesa.so.8";
/// Constants of GL/osmesa.h.
constexpr int kOsmesaFormat = 0x22;
constexpr int kOsmesaProfile = 0x33;
constexpr int kOsmesaCoreProfile = 0x34;
constexpr int kOsmesaMajorVersion = 0x36;
constexpr int kOsmesaMinorVersion = 0x37;

struct OsmesaContextRecord;
using Handle = OsmesaContextRecord*;
using CreateContext = Handle (*)(const int* attributes, Handle shared);
using DestroyContext = void (*)(Handle);
using MakeCurrent = GLboolean (*)(Handle, void* buffer, GLenum type, GLsizei width, GLsizei height);

class Library {
  public:
    /// Never unloaded: Mesa and LLVM leave destructors of threads and of the process behind.
    Library() : handle_(dlopen(kLibrary, RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE)) {
        if (handle_ == nullptr) {
            throw ContextUnavailable(std::string("OSMesa: ") + kLibrary +
                                     " is not installed (package libosmesa6)");
        }
    }
    ~Library() { dlclose(handle_); }
    Library(const Library&) = delete;
    Library& operator=(const Library&) = delete;

    template <class Function>
    Function find(const char* name) const {
        void* symbol = dlsym(handle_, name);
        if (symbol == nullptr) {
            throw ContextUnavailable(std::string("OSMesa: ") + kLibrary + " lacks " + name);
        }
        return reinterpret_cast<Function>(symbol);
    }

  private:
    void* handle_;
};

class OsmesaContext final : public Context {
  public:
    OsmesaContext()
        : destroy_(library_.find<DestroyContext>("OSMesaDestroyContext")),
          makeCurrent_(library_.find<MakeCurrent>("OSMesaMakeCurrent")) {
        const std::array<int, 9> attributes{kOsmesaFormat,
                                            GL_RGBA,
                                            kOsmesaProfile,
                                            kOsmesaCoreProfile,
                                            kOsmesaMajorVersion,
                                            3,
                                            kOsmesaMinorVersion,
                                            3,
                                            0};
        handle_ = library_.find<CreateContext>("OSMesaCreateContextAttribs")(attributes.data(), nullptr);
        if (handle_ == nullptr) {
            throw ContextUnavailable("OSMesa: an OpenGL 3.3 core context is refused");
        }
        try {
            makeCurrent();
            load(library_.find<FindFunction>("OSMesaGetProcAddress"));
        } catch (...) {
            destroy_(handle_);
            throw;
        }
    }
    ~OsmesaContext() override {
        makeCurrent_(nullptr, nullptr, 0, 0, 0);
        destroy_(handle_);
    }

    std::string_view kind() const override { return "OSMesa"; }

    void makeCurrent() override {
        if (makeCurrent_(handle_, pixel_.data(), GL_UNSIGNED_BYTE, 1, 1) == GL_FALSE) {
            throw ContextUnavailable("OSMesa: the context cannot be made current");
        }
    }

  private:
    Library library_;
    DestroyContext destroy_;
    MakeCurrent makeCurrent_;
    Handle handle_ = nullptr;
    /// The window that OSMesa insists on; pictures are drawn into framebuffer objects.
    std::array<std::uint8_t, 4> pixel_{};
};

}  // namespace

std::unique_ptr<Context> makeOsmesaContext() {
    return std::make_unique<OsmesaContext>();
}

}  // namespace fluxwalk::gl
