#include "viewer/gl/context.h"

#include <cstdlib>

#include <gtest/gtest.h>

#include "viewer/gl/render_target.h"
#include "viewer/gl/window_context.h"

namespace fluxwalk::gl {
namespace {

/// Draws one clear through every step from context to bytes.
void expectWorks(Context& context) {
    EXPECT_FALSE(context.renderer().empty());
    const Functions& gl = context.functions();
    const RenderTarget target(gl, {3, 2}, 4);
    EXPECT_EQ(target.samples(), 4);
    target.bind();
    gl.ClearColor(1.0f, 0.5f, 0.0f, 1.0f);
    gl.Clear(GL_COLOR_BUFFER_BIT);
    target.resolve();
    const std::vector<std::uint8_t> pixels = target.readRgb();
    ASSERT_EQ(pixels.size(), 18u);
    for (std::size_t i = 0; i < pixels.size(); i += 3) {
        EXPECT_EQ(pixels[i], 255);
        EXPECT_NEAR(pixels[i + 1], 128, 1);
        EXPECT_EQ(pixels[i + 2], 0);
    }
    EXPECT_EQ(gl.GetError(), static_cast<GLenum>(GL_NO_ERROR));
}

TEST(Context, EglHasAllFunctionsAndDraws) {
    const auto context = makeHeadlessContext(HeadlessKind::egl);
    EXPECT_EQ(context->kind(), "EGL");
    expectWorks(*context);
}

TEST(Context, OsmesaHasAllFunctionsAndDraws) {
    const auto context = makeHeadlessContext(HeadlessKind::osmesa);
    EXPECT_EQ(context->kind(), "OSMesa");
    EXPECT_TRUE(context->isSoftware());
    expectWorks(*context);
}

TEST(Context, AutomaticPrefersEgl) {
    EXPECT_EQ(makeHeadlessContext(HeadlessKind::automatic)->kind(), "EGL");
}

TEST(Context, OneAfterTheOtherInOneProcess) {
    for (const HeadlessKind kind : {HeadlessKind::osmesa, HeadlessKind::egl, HeadlessKind::osmesa}) {
        expectWorks(*makeHeadlessContext(kind));
    }
}

TEST(Context, WindowHasAllFunctionsAndDraws) {
    if (std::getenv("DISPLAY") == nullptr) {
        GTEST_SKIP() << "no DISPLAY";
    }
    WindowContext context("test", {64, 48}, false);
    EXPECT_EQ(context.kind(), "window");
    expectWorks(context);
}

TEST(Context, WindowWithoutDisplaySaysSo) {
    if (std::getenv("DISPLAY") != nullptr) {
        GTEST_SKIP() << "there is a DISPLAY";
    }
    try {
        const WindowContext context("test", {64, 48}, false);
        FAIL() << "a window without a display";
    } catch (const ContextUnavailable& error) {
        EXPECT_NE(std::string(error.what()).find("no display"), std::string::npos) << error.what();
    }
}

TEST(Functions, NamesWhatIsMissing) {
    Functions functions;
    const std::vector<std::string> missing = loadFunctions(functions, [](const char* name) -> void (*)() {
        if (std::string(name) == "glClear") {
            return nullptr;
        }
        return [] {};
    });
    EXPECT_EQ(missing, std::vector<std::string>{"glClear"});
    EXPECT_EQ(functions.Clear, nullptr);
    EXPECT_NE(functions.Viewport, nullptr);
}

}  // namespace
}  // namespace fluxwalk::gl
