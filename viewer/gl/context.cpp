#include "viewer/gl/context.h"

namespace fluxwalk::gl {

void Context::load(FindFunction find) {
    const std::vector<std::string> missing = loadFunctions(functions_, find);
    if (!missing.empty()) {
        throw ContextUnavailable(std::string(kind()) + ": OpenGL 3.3 lacks " + missing.front() +
                                 (missing.size() > 1 ? " and others" : ""));
    }
    const GLubyte* name = functions_.GetString(GL_RENDERER);
    renderer_ = name != nullptr ? reinterpret_cast<const char*>(name) : "unknown";
}

bool Context::isSoftware() const {
    for (const char* name : {"llvmpipe", "softpipe", "swrast", "SWR"}) {
        if (renderer_.find(name) != std::string::npos) {
            return true;
        }
    }
    return false;
}

std::unique_ptr<Context> makeHeadlessContext(HeadlessKind kind) {
    switch (kind) {
        case HeadlessKind::egl:
            return makeEglContext();
        case HeadlessKind::osmesa:
            return makeOsmesaContext();
        case HeadlessKind::automatic:
            break;
    }
    std::string egl;
    try {
        return makeEglContext();
    } catch (const ContextUnavailable& error) {
        egl = error.what();
    }
    try {
        return makeOsmesaContext();
    } catch (const ContextUnavailable& error) {
        throw ContextUnavailable("no headless OpenGL on this machine (" + egl + "; " + error.what() + ")");
    }
}

}  // namespace fluxwalk::gl
