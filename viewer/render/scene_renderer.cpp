#include "viewer/render/scene_renderer.h"

#include <algorithm>
#include <array>

#include "core/base/check.h"
#include "core/base/photometry.h"
#include "viewer/render/camera.h"
#include "viewer/render/light_meter.h"

namespace fluxwalk::render {
namespace {

/// Shape without light.
constexpr float kRelief = 0.55f;
/// Triangles that are looked at to find the range of values.
constexpr std::size_t kTrianglesOfRange = 1000000;

/// Puts the bound target and its viewport back.
class BoundTarget {
  public:
    explicit BoundTarget(const gl::Functions& gl) : gl_(gl) {
        gl_.GetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &framebuffer_);
        gl_.GetIntegerv(GL_VIEWPORT, viewport_.data());
    }
    ~BoundTarget() {
        gl_.BindFramebuffer(GL_FRAMEBUFFER, static_cast<GLuint>(framebuffer_));
        gl_.Viewport(viewport_[0], viewport_[1], viewport_[2], viewport_[3]);
    }
    BoundTarget(const BoundTarget&) = delete;
    BoundTarget& operator=(const BoundTarget&) = delete;

    gl::PixelSize size() const { return {viewport_[2], viewport_[3]}; }

  private:
    const gl::Functions& gl_;
    GLint framebuffer_ = 0;
    std::array<GLint, 4> viewport_{};
};

/// Meshes of the same side follow one another.
std::uint64_t sideOf(const scene::LitMesh& mesh) {
    return 2 * std::uint64_t{mesh.object} + (mesh.back ? 1 : 0);
}

}  // namespace

SceneRenderer::SceneRenderer(const gl::Functions& gl, std::shared_ptr<const scene::Scene> scene)
    : gl_(gl), scene_(std::move(scene)), pass_(gl, scene_), overlay_(gl) {}

std::size_t SceneRenderer::setMeshes(const scene::LitMeshes& meshes, const scene::Lighting& lighting) {
    pass_.setLighting(lighting);
    std::unordered_map<const scene::LitMesh*, GpuMesh> kept;
    for (const auto& mesh : meshes) {
        if (auto node = meshes_.extract(mesh.get()); !node.empty()) {
            kept.insert(std::move(node));
        }
    }
    std::unordered_multimap<std::uint64_t, const scene::LitMesh*> left;
    for (const auto& [source, mesh] : meshes_) {
        left.emplace(sideOf(*source), source);
    }
    std::size_t sent = 0;
    opaque_.clear();
    blended_.clear();
    luminance_.reset();
    bounds_ = {};
    triangleCount_ = 0;
    for (const auto& mesh : meshes) {
        FLUXWALK_CHECK_LT(mesh->material, scene_->materials.size());
        if (kept.find(mesh.get()) == kept.end()) {
            if (const auto old = left.find(sideOf(*mesh)); old != left.end()) {
                auto node = meshes_.extract(old->second);
                left.erase(old);
                sent += node.mapped().update(mesh) > 0 ? 1u : 0u;
                node.key() = mesh.get();
                kept.insert(std::move(node));
            } else {
                kept.try_emplace(mesh.get(), gl_, mesh);
                ++sent;
            }
        }
        const GpuMesh& gpu = kept.at(mesh.get());
        const bool isBlended = scene_->materials[mesh->material].alphaMode == scene::AlphaMode::blend;
        (isBlended ? blended_ : opaque_).push_back(&gpu);
        bounds_.extend(gpu.bounds());
        triangleCount_ += mesh->triangles.size() / 3;
    }
    meshes_ = std::move(kept);
    return sent;
}

const MeshLuminance& SceneRenderer::luminance() {
    if (!luminance_) {
        const std::size_t step = 1 + triangleCount_ / kTrianglesOfRange;
        luminance_.emplace();
        for (const auto* list : {&opaque_, &blended_}) {
            for (const GpuMesh* mesh : *list) {
                scene::Material material = scene_->materials[mesh->source().material];
                material.emission *= pass_.lighting().ofMaterial(mesh->source().material);
                const MeshLuminance one =
                    luminanceOf(mesh->source(), material, pass_.textures().mean(material.reflectanceTexture),
                                pass_.textures().mean(material.emissionTexture), step);
                luminance_->reflecting.add(one.reflecting);
                luminance_->emitting.add(one.emitting);
                luminance_->illuminance.add(one.illuminance);
            }
        }
    }
    return *luminance_;
}

ValueRange SceneRenderer::rangeOf(const DrawSettings& settings) {
    if (settings.range) {
        return *settings.range;
    }
    if (settings.shown == Shown::luminance && !luminance().reflecting.isEmpty()) {
        return chooseRange(luminance().reflecting, settings.scale);
    }
    return chooseRange(settings.shown == Shown::luminance ? luminance().emitting : luminance().illuminance,
                       settings.scale);
}

LitView SceneRenderer::viewOf(const scene::Camera& camera, double aspect, Output output) const {
    LitView view;
    view.clipFromWorld = clipFromWorld(camera, aspect, clipRangeFor(camera, bounds_));
    view.eye = camera.position;
    view.forward = camera.forward;
    view.output = output;
    view.skyLuminance = scene_->sky * pass_.lighting().sky * static_cast<float>(1.0 / base::kPi);
    return view;
}

LitView SceneRenderer::viewOf(const scene::Camera& camera, double aspect, const DrawSettings& settings) {
    const bool isValue = settings.shown == Shown::illuminance || settings.shown == Shown::luminance;
    LitView view = viewOf(camera, aspect, isValue ? Output::values : Output::screen);
    if (settings.shown != Shown::picture) {
        view.skyLuminance = base::Rgb(0.0f);
    }
    if (isValue) {
        view.isIlluminance = settings.shown == Shown::illuminance;
        view.scale = settings.scale;
        view.range = rangeOf(settings);
        view.isolineStep = settings.isolines ? roundStep(view.range) : 0.0;
    } else {
        view.exposure = settings.exposure ? *settings.exposure : meterExposure(camera, aspect);
    }
    view.curve = settings.curve;
    return view;
}

void SceneRenderer::begin() const {
    gl_.Disable(GL_SCISSOR_TEST);
    gl_.Disable(GL_BLEND);
    gl_.Enable(GL_DEPTH_TEST);
    gl_.DepthMask(GL_TRUE);
    gl_.DepthFunc(GL_LESS);
    gl_.Enable(GL_CULL_FACE);
    gl_.CullFace(GL_BACK);
    gl_.Clear(GL_DEPTH_BUFFER_BIT);
}

void SceneRenderer::drawSurfaces(const LitView& view) {
    begin();
    pass_.drawOpaque(view, opaque_);
    pass_.drawBackground(view);
    pass_.drawBlended(view, blended_);
}

double SceneRenderer::meterExposure(const scene::Camera& camera, double aspect) {
    const BoundTarget bound(gl_);
    const gl::PixelSize size = meterSize(aspect);
    if (meterTarget_ == nullptr || !(meterTarget_->size() == size)) {
        meterTarget_ = std::make_unique<gl::RenderTarget>(gl_, size, 1, gl::PixelFormat::full);
    }
    meterTarget_->bind();
    drawSurfaces(viewOf(camera, aspect, Output::meter));
    meterTarget_->resolve();
    gl_.BindVertexArray(0);
    return render::meterExposure(meterTarget_->readLight(), size);
}

void SceneRenderer::addGlow(LitView& view) {
    const BoundTarget bound(gl_);
    if (!glow_) {
        glow_.emplace(gl_);
    }
    LitView light = view;
    light.output = Output::light;
    glow_->begin(bound.size());
    drawSurfaces(light);
    view.glow = glow_->finish();
    view.size = bound.size();
}

void SceneRenderer::drawLight(const scene::Camera& camera, double aspect) {
    drawSurfaces(viewOf(camera, aspect, Output::light));
    gl_.BindVertexArray(0);
}

void SceneRenderer::draw(const scene::Camera& camera, double aspect, const DrawSettings& settings) {
    LitView view = viewOf(camera, aspect, settings);
    const OverlayView over{view.clipFromWorld, base::Vec3(camera.position)};
    if (showsFaces(settings.shown) && overlay_.hasFaces()) {
        begin();
        overlay_.drawFaces(over, settings.shown == Shown::objects ? kRelief : 0.0f);
        pass_.drawBackground(view);
    } else {
        if (settings.glow && settings.shown == Shown::picture) {
            addGlow(view);
        }
        drawSurfaces(view);
    }
    if (settings.elementEdges) {
        overlay_.drawEdges(over, settings.shown != Shown::picture);
    }
    if (settings.clusterBoxes) {
        overlay_.drawBoxes(over);
    }
    gl_.BindVertexArray(0);
}

}  // namespace fluxwalk::render
