#include "viewer/gl/functions.h"

namespace fluxwalk::gl {

std::vector<std::string> loadFunctions(Functions& functions, FindFunction find) {
    std::vector<std::string> missing;
    const auto load = [&](auto& function, const char* name) {
        function = reinterpret_cast<std::remove_reference_t<decltype(function)>>(find(name));
        if (function == nullptr) {
            missing.emplace_back(name);
        }
    };
#define FLUXWALK_GL_LOAD(SUFFIX, Suffix) load(functions.Suffix, "gl" #Suffix);
    FLUXWALK_GL_FUNCTIONS(FLUXWALK_GL_LOAD)
#undef FLUXWALK_GL_LOAD
    return missing;
}

}  // namespace fluxwalk::gl
