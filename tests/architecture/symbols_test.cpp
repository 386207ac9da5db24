#include <array>
#include <cctype>
#include <cstdio>
#include <memory>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

// The library must be of use where there is no display: it may not need a symbol of a graphics or window
// library.
namespace fluxwalk::architecture {
namespace {

/// Whether a symbol, as nm prints it, belongs to OpenGL, EGL, GLX, OSMesa, GLFW or Dear ImGui.
bool isGraphicsSymbol(std::string_view symbol) {
    for (const std::string_view prefix : {"gl", "egl", "glX"}) {
        if (symbol.starts_with(prefix) && symbol.size() > prefix.size() &&
            std::isupper(static_cast<unsigned char>(symbol[prefix.size()])) != 0) {
            return true;
        }
    }
    return symbol.starts_with("glfw") || symbol.starts_with("OSMesa") ||
           symbol.find("ImGui") != std::string_view::npos || symbol.find("ImDraw") != std::string_view::npos;
}

std::vector<std::string> undefinedSymbols(const std::string& library) {
    const std::string command = std::string(FLUXWALK_NM) + " --undefined-only '" + library + "'";
    const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
    std::vector<std::string> symbols;
    if (!pipe) {
        return symbols;
    }
    std::array<char, 8192> buffer{};
    while (std::fgets(buffer.data(), static_cast<int>(buffer.size()), pipe.get()) != nullptr) {
        std::istringstream line(buffer.data());
        std::string kind;
        std::string symbol;
        if (line >> kind >> symbol) {
            symbols.push_back(symbol);
        }
    }
    return symbols;
}

TEST(Symbols, GraphicsSymbolsAreRecognised) {
    for (const char* symbol : {"glClear", "eglGetDisplay", "glXMakeCurrent", "glfwInit", "OSMesaMakeCurrent",
                               "_ZN5ImGui5BeginEPKcPbi", "_ZN10ImDrawList7AddLineERK6ImVec2S2_jf"}) {
        EXPECT_TRUE(isGraphicsSymbol(symbol)) << symbol;
    }
    for (const char* symbol : {"_ZN3glm3dotE", "global", "rtcNewDevice", "memcpy", "_ZNSt6vectorIfE"}) {
        EXPECT_FALSE(isGraphicsSymbol(symbol)) << symbol;
    }
}

TEST(Symbols, CoreNeedsNoGraphicsLibrary) {
    const std::vector<std::string> symbols = undefinedSymbols(FLUXWALK_CORE_LIBRARY);
    // Embree is needed, so nm has been understood.
    ASSERT_NE(std::find(symbols.begin(), symbols.end(), "rtcNewDevice"), symbols.end());
    for (const std::string& symbol : symbols) {
        EXPECT_FALSE(isGraphicsSymbol(symbol)) << symbol;
    }
}

}  // namespace
}  // namespace fluxwalk::architecture
