#include "viewer/render/scene_renderer.h"

#include <algorithm>
#include <string>

#include "core/base/check.h"
#include "core/base/photometry.h"
#include "viewer/gl/shaders.h"
#include "viewer/render/camera.h"

namespace fluxwalk::render {
namespace {

constexpr GLint kReflectanceUnit = 0;
constexpr GLint kEmissionUnit = 1;
constexpr GLint kColorMapUnit = 2;
/// Shape without light.
constexpr float kRelief = 0.55f;

std::string join(std::initializer_list<std::string_view> parts) {
    std::string source(gl::shaders::kVersion);
    for (const std::string_view part : parts) {
        source += part;
    }
    return source;
}

}  // namespace

SceneRenderer::LitUniforms::LitUniforms(const gl::Program& program)
    : clipFromWorld(program.uniform("clipFromWorld")),
      reflectanceTransform(program.uniform("reflectanceTransform")),
      emissionTransform(program.uniform("emissionTransform")),
      reflectanceSet(program.uniform("reflectanceSet")),
      emissionSet(program.uniform("emissionSet")),
      reflectance(program.uniform("reflectance")),
      emission(program.uniform("emission")),
      alphaCutoff(program.uniform("alphaCutoff")),
      reflectanceTexture(program.uniform("reflectanceTexture")),
      emissionTexture(program.uniform("emissionTexture")),
      shown(program.uniform("shown")),
      colorMap(program.uniform("colorMap")),
      valueScale(program.uniform("valueScale")),
      valueRange(program.uniform("valueRange")),
      isolineStep(program.uniform("isolineStep")) {}

SceneRenderer::SceneRenderer(const gl::Functions& gl, std::shared_ptr<const scene::Scene> scene)
    : gl_(gl),
      scene_(std::move(scene)),
      lit_(gl, "lit", join({gl::shaders::kLitVertex}),
           join({gl::shaders::kTone, gl::shaders::kFalseColor, gl::shaders::kLitFragment})),
      litUniforms_(lit_),
      litTone_(lit_),
      background_(gl, "background", join({gl::shaders::kBackgroundVertex}),
                  join({gl::shaders::kTone, gl::shaders::kBackgroundFragment})),
      backgroundTone_(background_),
      noVertices_(gl),
      textures_(gl, scene_),
      colorMapTexture_(gl),
      overlay_(gl) {
    sendColorMap();
}

void SceneRenderer::sendColorMap() const {
    gl_.ActiveTexture(GL_TEXTURE0);
    gl_.BindTexture(GL_TEXTURE_2D, colorMapTexture_.id());
    gl_.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
    gl_.TexImage2D(GL_TEXTURE_2D, 0, GL_RGB8, static_cast<GLsizei>(ColorMap::kSize), 1, 0, GL_RGB,
                   GL_UNSIGNED_BYTE, colorMap_.colors().data());
    gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
}

std::size_t SceneRenderer::setMeshes(const scene::LitMeshes& meshes, const scene::Lighting& lighting) {
    std::size_t sent = 0;
    if (!(lighting == lighting_)) {
        // How bright a mesh is depends on them too.
        meshes_.clear();
        lighting_ = lighting;
    }
    std::unordered_map<const scene::LitMesh*, GpuMesh> kept;
    opaque_.clear();
    blended_.clear();
    luminance_ = {};
    bounds_ = {};
    triangleCount_ = 0;
    for (const auto& mesh : meshes) {
        FLUXWALK_CHECK_LT(mesh->material, scene_->materials.size());
        scene::Material material = scene_->materials[mesh->material];
        material.emission *= lighting_.ofMaterial(mesh->material);
        auto node = meshes_.extract(mesh.get());
        if (node.empty()) {
            const MeshLuminance luminance =
                luminanceOf(*mesh, material, textures_.mean(material.reflectanceTexture),
                            textures_.mean(material.emissionTexture));
            kept.try_emplace(mesh.get(), gl_, mesh, luminance);
            ++sent;
        } else {
            kept.insert(std::move(node));
        }
        const GpuMesh& gpu = kept.at(mesh.get());
        (material.alphaMode == scene::AlphaMode::blend ? blended_ : opaque_).push_back(&gpu);
        luminance_.reflecting.add(gpu.luminance().reflecting);
        luminance_.emitting.add(gpu.luminance().emitting);
        luminance_.illuminance.add(gpu.luminance().illuminance);
        bounds_.extend(gpu.bounds());
        triangleCount_ += mesh->triangles.size() / 3;
    }
    meshes_ = std::move(kept);
    return sent;
}

double SceneRenderer::automaticExposure() const {
    return render::automaticExposure(luminance_.reflecting, luminance_.emitting);
}

ValueRange SceneRenderer::rangeOf(const DrawSettings& settings) const {
    if (settings.range) {
        return *settings.range;
    }
    if (settings.shown == Shown::luminance && !luminance_.reflecting.isEmpty()) {
        return chooseRange(luminance_.reflecting, settings.scale);
    }
    return chooseRange(settings.shown == Shown::luminance ? luminance_.emitting : luminance_.illuminance,
                       settings.scale);
}

void SceneRenderer::setValues(const DrawSettings& settings) const {
    const ValueRange range = rangeOf(settings);
    gl_.ActiveTexture(GL_TEXTURE0 + kColorMapUnit);
    gl_.BindTexture(GL_TEXTURE_2D, colorMapTexture_.id());
    const Shown shown = showsFaces(settings.shown) ? Shown::picture : settings.shown;
    gl_.Uniform1i(litUniforms_.shown, static_cast<GLint>(shown));
    gl_.Uniform1i(litUniforms_.colorMap, kColorMapUnit);
    gl_.Uniform1i(litUniforms_.valueScale, static_cast<GLint>(settings.scale));
    gl_.Uniform2f(litUniforms_.valueRange, static_cast<GLfloat>(range.least),
                  static_cast<GLfloat>(range.most));
    gl_.Uniform1f(litUniforms_.isolineStep,
                  settings.isolines ? static_cast<GLfloat>(roundStep(range)) : 0.0f);
}

void SceneRenderer::setTone(const ToneUniforms& uniforms, const DrawSettings& settings) const {
    const double exposure = settings.exposure ? *settings.exposure : automaticExposure();
    gl_.Uniform1f(uniforms.exposure, static_cast<GLfloat>(exposure));
    gl_.Uniform1i(uniforms.curve, static_cast<GLint>(settings.curve));
}

void SceneRenderer::draw(const scene::Camera& camera, double aspect, const DrawSettings& settings) {
    const glm::mat4 matrix = clipFromWorld(camera, aspect, clipRangeFor(camera, bounds_));
    gl_.Disable(GL_SCISSOR_TEST);
    gl_.Disable(GL_BLEND);
    gl_.Enable(GL_DEPTH_TEST);
    gl_.DepthMask(GL_TRUE);
    gl_.DepthFunc(GL_LESS);
    gl_.Enable(GL_CULL_FACE);
    gl_.CullFace(GL_BACK);
    gl_.Clear(GL_DEPTH_BUFFER_BIT);
    drawBackground(camera, matrix, settings);
    const OverlayView view{matrix, base::Vec3(camera.position)};
    if (showsFaces(settings.shown) && overlay_.hasFaces()) {
        overlay_.drawFaces(view, settings.shown == Shown::objects ? kRelief : 0.0f);
    } else {
        drawLit(camera, matrix, settings);
    }
    if (settings.elementEdges) {
        overlay_.drawEdges(view, settings.shown != Shown::picture);
    }
    if (settings.clusterBoxes) {
        overlay_.drawBoxes(view);
    }
    gl_.BindVertexArray(0);
}

void SceneRenderer::drawLit(const scene::Camera& camera, const glm::mat4& clipFromWorld,
                            const DrawSettings& settings) {
    lit_.use();
    setTone(litTone_, settings);
    setValues(settings);
    gl_.UniformMatrix4fv(litUniforms_.clipFromWorld, 1, GL_FALSE, &clipFromWorld[0][0]);
    gl_.Uniform1i(litUniforms_.reflectanceTexture, kReflectanceUnit);
    gl_.Uniform1i(litUniforms_.emissionTexture, kEmissionUnit);
    for (const GpuMesh* mesh : opaque_) {
        drawMesh(*mesh);
    }
    drawBlended(camera);
}

void SceneRenderer::drawBackground(const scene::Camera& camera, const glm::mat4& clipFromWorld,
                                   const DrawSettings& settings) const {
    const glm::mat4 worldFromClip = glm::inverse(clipFromWorld);
    const base::Rgb sky = settings.shown == Shown::picture
                              ? scene_->sky * lighting_.sky * static_cast<float>(1.0 / base::kPi)
                              : base::Rgb(0.0f);
    background_.use();
    setTone(backgroundTone_, settings);
    gl_.UniformMatrix4fv(background_.uniform("worldFromClip"), 1, GL_FALSE, &worldFromClip[0][0]);
    gl_.Uniform3f(background_.uniform("eye"), static_cast<GLfloat>(camera.position.x),
                  static_cast<GLfloat>(camera.position.y), static_cast<GLfloat>(camera.position.z));
    gl_.Uniform3f(background_.uniform("skyLuminance"), sky.r, sky.g, sky.b);
    gl_.Disable(GL_DEPTH_TEST);
    gl_.BindVertexArray(noVertices_.id());
    gl_.DrawArrays(GL_TRIANGLES, 0, 3);
    gl_.Enable(GL_DEPTH_TEST);
}

void SceneRenderer::drawMesh(const GpuMesh& mesh) {
    const scene::Material& material = scene_->materials[mesh.source().material];
    const base::Rgb emission =
        emissionOfSide(mesh.source(), material) * lighting_.ofMaterial(mesh.source().material);
    const glm::mat3 forReflectance = texcoordTransform(material.reflectanceTexture);
    const glm::mat3 forEmission = texcoordTransform(material.emissionTexture);
    const bool hasHoles = material.alphaMode == scene::AlphaMode::mask;
    const bool isOpaque = material.alphaMode == scene::AlphaMode::opaque;
    textures_.bind(kReflectanceUnit, material.reflectanceTexture);
    textures_.bind(kEmissionUnit, material.emissionTexture);
    gl_.Uniform4f(litUniforms_.reflectance, material.reflectance.r, material.reflectance.g,
                  material.reflectance.b, isOpaque ? 1.0f : material.alpha);
    gl_.Uniform3f(litUniforms_.emission, emission.r, emission.g, emission.b);
    gl_.Uniform1f(litUniforms_.alphaCutoff, hasHoles ? material.alphaCutoff : -1.0f);
    gl_.UniformMatrix3fv(litUniforms_.reflectanceTransform, 1, GL_FALSE, &forReflectance[0][0]);
    gl_.UniformMatrix3fv(litUniforms_.emissionTransform, 1, GL_FALSE, &forEmission[0][0]);
    gl_.Uniform1i(litUniforms_.reflectanceSet, material.reflectanceTexture.texcoordSet);
    gl_.Uniform1i(litUniforms_.emissionSet, material.emissionTexture.texcoordSet);
    mesh.draw(gl_);
}

void SceneRenderer::drawBlended(const scene::Camera& camera) {
    if (blended_.empty()) {
        return;
    }
    const auto distance = [&](const GpuMesh* mesh) {
        return glm::dot(mesh->bounds().center() - camera.position, camera.forward);
    };
    std::vector<const GpuMesh*> farToNear = blended_;
    std::stable_sort(farToNear.begin(), farToNear.end(),
                     [&](const GpuMesh* a, const GpuMesh* b) { return distance(a) > distance(b); });
    gl_.Enable(GL_BLEND);
    gl_.BlendEquation(GL_FUNC_ADD);
    gl_.BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    gl_.DepthMask(GL_FALSE);
    for (const GpuMesh* mesh : farToNear) {
        drawMesh(*mesh);
    }
    gl_.DepthMask(GL_TRUE);
    gl_.Disable(GL_BLEND);
}

}  // namespace fluxwalk::render
