#include "viewer/render/lit_pass.h"

#include <algorithm>
#include <string>

#include "viewer/gl/shaders.h"
#include "viewer/render/color_map.h"
#include "viewer/render/exposure.h"
#include "viewer/render/frustum.h"

namespace fluxwalk::render {
namespace {

constexpr GLint kReflectanceUnit = 0;
constexpr GLint kEmissionUnit = 1;
constexpr GLint kColorMapUnit = 2;
constexpr GLint kGlowUnit = 3;

/// What a shader must be able to do; the first numbers are those of SURFACE in the shaders.
enum class Surface : std::uint8_t { plain = 0, textured = 1, withHoles = 2, background = 3 };

Surface surfaceOf(const scene::Material& material) {
    if (material.alphaMode == scene::AlphaMode::mask) {
        return Surface::withHoles;
    }
    const bool hasTexture = material.reflectanceTexture.image >= 0 || material.emissionTexture.image >= 0;
    return hasTexture ? Surface::textured : Surface::plain;
}

/// What a shader is made for.
struct Variant {
    Surface surface = Surface::plain;
    Output output = Output::screen;
    ToneCurve curve = ToneCurve::linear;
    bool glows = false;

    unsigned number() const {
        const unsigned look = 4 * static_cast<unsigned>(output) + static_cast<unsigned>(curve);
        return 2 * (16 * static_cast<unsigned>(surface) + look) + (glows ? 1 : 0);
    }
};

struct Sources {
    std::string vertex;
    std::string fragment;
};

Sources sourcesFor(const Variant& variant) {
    std::string head(gl::shaders::kVersion);
    const auto define = [&](const char* name, int value) {
        head += std::string("#define ") + name + " " + std::to_string(value) + "\n";
    };
    define("SURFACE", static_cast<int>(variant.surface));
    define("OUTPUT", static_cast<int>(variant.output));
    define("CURVE", static_cast<int>(variant.curve));
    define("GLOW", variant.glows ? 1 : 0);
    const auto join = [&](std::initializer_list<std::string_view> parts) {
        std::string source = head;
        for (const std::string_view part : parts) {
            source += part;
        }
        return source;
    };
    const bool isBackground = variant.surface == Surface::background;
    const bool isForScreen =
        variant.output == Output::screen || (isBackground && variant.output == Output::values);
    const std::string_view values = variant.output == Output::values ? gl::shaders::kFalseColor : "";
    const std::string_view tone = isForScreen ? gl::shaders::kTone : "";
    return isBackground
               ? Sources{join({gl::shaders::kBackgroundVertex}),
                         join({tone, gl::shaders::kBackgroundFragment})}
               : Sources{join({gl::shaders::kLitVertex}), join({tone, values, gl::shaders::kLitFragment})};
}

}  // namespace

/// A program and where its uniforms are, of which it has those that it needs.
struct LitPass::Shader {
    Shader(const gl::Functions& gl, const char* name, const Sources& sources)
        : program(gl, name, sources.vertex, sources.fragment) {}

    gl::Program program;
    GLint clipFromWorld = program.uniformIfThere("clipFromWorld");
    GLint reflectanceTransform = program.uniformIfThere("reflectanceTransform");
    GLint emissionTransform = program.uniformIfThere("emissionTransform");
    GLint reflectanceSet = program.uniformIfThere("reflectanceSet");
    GLint emissionSet = program.uniformIfThere("emissionSet");
    GLint reflectance = program.uniformIfThere("reflectance");
    GLint emission = program.uniformIfThere("emission");
    GLint alphaCutoff = program.uniformIfThere("alphaCutoff");
    GLint reflectanceTexture = program.uniformIfThere("reflectanceTexture");
    GLint emissionTexture = program.uniformIfThere("emissionTexture");
    GLint shown = program.uniformIfThere("shown");
    GLint colorMap = program.uniformIfThere("colorMap");
    GLint valueScale = program.uniformIfThere("valueScale");
    GLint valueRange = program.uniformIfThere("valueRange");
    GLint isolineStep = program.uniformIfThere("isolineStep");
    GLint exposure = program.uniformIfThere("exposure");
    GLint glow = program.uniformIfThere("glow");
    GLint glowPart = program.uniformIfThere("glowPart");
    GLint glowScale = program.uniformIfThere("glowScale");
};

LitPass::LitPass(const gl::Functions& gl, std::shared_ptr<const scene::Scene> scene)
    : gl_(gl), scene_(std::move(scene)), textures_(gl, scene_), colorMap_(gl), noVertices_(gl) {
    sendColorMap();
}

LitPass::~LitPass() = default;

void LitPass::sendColorMap() const {
    const ColorMap map;
    gl_.ActiveTexture(GL_TEXTURE0);
    gl_.BindTexture(GL_TEXTURE_2D, colorMap_.id());
    gl_.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
    gl_.TexImage2D(GL_TEXTURE_2D, 0, GL_RGB8, static_cast<GLsizei>(ColorMap::kSize), 1, 0, GL_RGB,
                   GL_UNSIGNED_BYTE, map.colors().data());
    gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
}

const LitPass::Shader& LitPass::surfaceShader(const LitView& view, const scene::Material& material) {
    return shaderFor(static_cast<unsigned>(surfaceOf(material)), view);
}

const LitPass::Shader& LitPass::shaderFor(unsigned surface, const LitView& view) {
    Variant variant{static_cast<Surface>(surface), view.output};
    if (view.output == Output::screen) {
        variant.curve = view.curve;
        variant.glows = view.glow.texture != 0;
    }
    std::unique_ptr<Shader>& shader = shaders_[variant.number()];
    if (shader == nullptr) {
        const bool isBackground = variant.surface == Surface::background;
        shader = std::make_unique<Shader>(gl_, isBackground ? "background" : "lit", sourcesFor(variant));
    }
    return *shader;
}

void LitPass::setView(const Shader& shader, const LitView& view) const {
    shader.program.use();
    gl_.UniformMatrix4fv(shader.clipFromWorld, 1, GL_FALSE, &view.clipFromWorld[0][0]);
    gl_.Uniform1i(shader.reflectanceTexture, kReflectanceUnit);
    gl_.Uniform1i(shader.emissionTexture, kEmissionUnit);
    gl_.Uniform1f(shader.exposure, static_cast<GLfloat>(view.exposure));
    gl_.Uniform1i(shader.shown, view.isIlluminance ? 1 : 2);
    gl_.Uniform1i(shader.valueScale, static_cast<GLint>(view.scale));
    gl_.Uniform2f(shader.valueRange, static_cast<GLfloat>(view.range.least),
                  static_cast<GLfloat>(view.range.most));
    gl_.Uniform1f(shader.isolineStep, static_cast<GLfloat>(view.isolineStep));
    if (shader.colorMap >= 0) {
        gl_.Uniform1i(shader.colorMap, kColorMapUnit);
        gl_.ActiveTexture(GL_TEXTURE0 + kColorMapUnit);
        gl_.BindTexture(GL_TEXTURE_2D, colorMap_.id());
    }
    if (shader.glow >= 0) {
        gl_.Uniform1i(shader.glow, kGlowUnit);
        gl_.Uniform1f(shader.glowPart, view.glow.part);
        gl_.Uniform2f(shader.glowScale, 1.0f / static_cast<GLfloat>(view.size.width),
                      1.0f / static_cast<GLfloat>(view.size.height));
        gl_.ActiveTexture(GL_TEXTURE0 + kGlowUnit);
        gl_.BindTexture(GL_TEXTURE_2D, view.glow.texture);
    }
}

void LitPass::setMaterial(const Shader& shader, const GpuMesh& mesh) {
    const scene::Material& material = scene_->materials[mesh.source().material];
    const base::Rgb emission =
        emissionOfSide(mesh.source(), material) * lighting_.ofMaterial(mesh.source().material);
    const bool isOpaque = material.alphaMode == scene::AlphaMode::opaque;
    gl_.Uniform4f(shader.reflectance, material.reflectance.r, material.reflectance.g, material.reflectance.b,
                  isOpaque ? 1.0f : material.alpha);
    gl_.Uniform3f(shader.emission, emission.r, emission.g, emission.b);
    gl_.Uniform1f(shader.alphaCutoff, material.alphaCutoff);
    if (shader.reflectanceTexture < 0) {
        return;
    }
    const glm::mat3 forReflectance = texcoordTransform(material.reflectanceTexture);
    const glm::mat3 forEmission = texcoordTransform(material.emissionTexture);
    textures_.bind(kReflectanceUnit, material.reflectanceTexture);
    textures_.bind(kEmissionUnit, material.emissionTexture);
    gl_.UniformMatrix3fv(shader.reflectanceTransform, 1, GL_FALSE, &forReflectance[0][0]);
    gl_.UniformMatrix3fv(shader.emissionTransform, 1, GL_FALSE, &forEmission[0][0]);
    gl_.Uniform1i(shader.reflectanceSet, material.reflectanceTexture.texcoordSet);
    gl_.Uniform1i(shader.emissionSet, material.emissionTexture.texcoordSet);
}

void LitPass::findPieces(const LitView& view, const std::vector<const GpuMesh*>& meshes) {
    const Frustum frustum(view.clipFromWorld);
    pieces_.clear();
    for (const GpuMesh* mesh : meshes) {
        if (mesh->chunks().size() > 1 && frustum.isOutside(mesh->bounds())) {
            continue;
        }
        for (const Chunk& chunk : mesh->chunks()) {
            if (!frustum.isOutside(chunk.bounds)) {
                pieces_.push_back({distanceTo(chunk.bounds, view.eye), mesh, &chunk});
                drawnTriangles_ += chunk.indexCount / 3;
            }
        }
    }
}

void LitPass::drawPieces(const LitView& view) {
    const Shader* shader = nullptr;
    const GpuMesh* mesh = nullptr;
    for (const Piece& piece : pieces_) {
        if (piece.mesh != mesh) {
            mesh = piece.mesh;
            const Shader& wanted = surfaceShader(view, scene_->materials[mesh->source().material]);
            if (&wanted != shader) {
                shader = &wanted;
                setView(*shader, view);
            }
            setMaterial(*shader, *mesh);
            mesh->bind();
        }
        mesh->draw(*piece.chunk);
    }
}

void LitPass::drawOpaque(const LitView& view, const std::vector<const GpuMesh*>& meshes) {
    drawnTriangles_ = 0;
    findPieces(view, meshes);
    // Stable, so that pictures do not depend on more than the order given.
    std::stable_sort(pieces_.begin(), pieces_.end(),
                     [](const Piece& a, const Piece& b) { return a.distance < b.distance; });
    drawPieces(view);
}

void LitPass::drawBackground(const LitView& view) {
    const glm::mat4 worldFromClip = glm::inverse(view.clipFromWorld);
    const Shader& shader = shaderFor(static_cast<unsigned>(Surface::background), view);
    setView(shader, view);
    gl_.UniformMatrix4fv(shader.program.uniform("worldFromClip"), 1, GL_FALSE, &worldFromClip[0][0]);
    gl_.Uniform3f(shader.program.uniform("eye"), static_cast<GLfloat>(view.eye.x),
                  static_cast<GLfloat>(view.eye.y), static_cast<GLfloat>(view.eye.z));
    gl_.Uniform3f(shader.program.uniform("skyLuminance"), view.skyLuminance.r, view.skyLuminance.g,
                  view.skyLuminance.b);
    // At the far end of the depth range: only where nothing else is.
    gl_.DepthFunc(GL_LEQUAL);
    gl_.BindVertexArray(noVertices_.id());
    gl_.DrawArrays(GL_TRIANGLES, 0, 3);
    gl_.DepthFunc(GL_LESS);
}

void LitPass::drawBlended(const LitView& view, const std::vector<const GpuMesh*>& meshes) {
    findPieces(view, meshes);
    if (pieces_.empty()) {
        return;
    }
    const auto distance = [&](const Piece& piece) {
        return glm::dot(piece.mesh->bounds().center() - view.eye, view.forward);
    };
    std::stable_sort(pieces_.begin(), pieces_.end(),
                     [&](const Piece& a, const Piece& b) { return distance(a) > distance(b); });
    gl_.Enable(GL_BLEND);
    gl_.BlendEquation(GL_FUNC_ADD);
    gl_.BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    gl_.DepthMask(GL_FALSE);
    drawPieces(view);
    gl_.DepthMask(GL_TRUE);
    gl_.Disable(GL_BLEND);
}

}  // namespace fluxwalk::render
