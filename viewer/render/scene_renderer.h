#pragma once

#include <optional>
#include <unordered_map>
#include <vector>

#include "core/scene/lighting.h"
#include "viewer/render/color_map.h"
#include "viewer/render/false_color.h"
#include "viewer/render/gpu_mesh.h"
#include "viewer/render/overlay.h"
#include "viewer/render/textures.h"
#include "viewer/render/tone.h"

namespace fluxwalk::render {

/// What is shown of the surfaces; the first numbers are those of the shader.
enum class Shown : std::uint8_t {
    picture = 0,
    illuminance = 1,
    luminance = 2,
    level,  ///< of the elements, as colours of the overlay's faces, as all below
    residual,
    objects
};

/// Whether faces of the overlay are shown instead of the light.
constexpr bool showsFaces(Shown shown) {
    return shown >= Shown::level;
}

/// How a scene is shown.
struct DrawSettings {
    std::optional<double> exposure{};  ///< per cd/m2; nothing for the automatic one
    ToneCurve curve = ToneCurve::filmic;
    Shown shown = Shown::picture;
    /// For what is shown as colours. Without a range, the one that chooseRange() finds.
    ValueScale scale = ValueScale::logarithmic;
    std::optional<ValueRange> range{};
    bool isolines = true;
    bool elementEdges = false;
    bool clusterBoxes = false;
    unsigned clusterDepth = 5;  ///< below the root, of the boxes

    bool operator==(const DrawSettings&) const = default;
};

/// Draws the lit sides of one scene.
class SceneRenderer {
  public:
    SceneRenderer(const gl::Functions& gl, std::shared_ptr<const scene::Scene> scene);

    /// The meshes to draw from now on, and the lights that they are lit by. Those that are already on the GPU
    /// (same pointer) stay there. Returns how many were sent.
    std::size_t setMeshes(const scene::LitMeshes& meshes, const scene::Lighting& lighting = {});
    std::size_t triangleCount() const { return triangleCount_; }
    const base::Box& bounds() const { return bounds_; }

    /// Exposure for the present meshes (see automaticExposure).
    double automaticExposure() const;
    /// The range in which values are shown: that of the settings, or the one found for the present meshes.
    ValueRange rangeOf(const DrawSettings& settings) const;
    const ColorMap& colorMap() const { return colorMap_; }

    /// What is drawn where the settings ask for faces, element edges or cluster boxes; until it has faces,
    /// lit surfaces are drawn.
    Overlay& overlay() { return overlay_; }

    /// Draws into the bound target, over all of it.
    void draw(const scene::Camera& camera, double aspect, const DrawSettings& settings);

  private:
    /// The uniforms of a program that applies tone.glsl.
    struct ToneUniforms {
        explicit ToneUniforms(const gl::Program& program)
            : exposure(program.uniform("exposure")), curve(program.uniform("toneCurve")) {}
        GLint exposure;
        GLint curve;
    };
    struct LitUniforms {
        explicit LitUniforms(const gl::Program& program);
        GLint clipFromWorld, reflectanceTransform, emissionTransform, reflectanceSet, emissionSet,
            reflectance, emission, alphaCutoff, reflectanceTexture, emissionTexture, shown, colorMap,
            valueScale, valueRange, isolineStep;
    };

    void sendColorMap() const;
    void setValues(const DrawSettings& settings) const;
    void setTone(const ToneUniforms& uniforms, const DrawSettings& settings) const;
    void drawBackground(const scene::Camera& camera, const glm::mat4& clipFromWorld,
                        const DrawSettings& settings) const;
    void drawLit(const scene::Camera& camera, const glm::mat4& clipFromWorld, const DrawSettings& settings);
    void drawMesh(const GpuMesh& mesh);
    void drawBlended(const scene::Camera& camera);

    const gl::Functions& gl_;
    std::shared_ptr<const scene::Scene> scene_;
    scene::Lighting lighting_;
    gl::Program lit_;
    LitUniforms litUniforms_;
    ToneUniforms litTone_;
    gl::Program background_;
    ToneUniforms backgroundTone_;
    gl::VertexArray noVertices_;
    Textures textures_;
    ColorMap colorMap_;
    gl::Texture colorMapTexture_;
    Overlay overlay_;
    std::unordered_map<const scene::LitMesh*, GpuMesh> meshes_;
    /// In the order given, so that pictures do not depend on addresses.
    std::vector<const GpuMesh*> opaque_;
    std::vector<const GpuMesh*> blended_;
    MeshLuminance luminance_;
    base::Box bounds_;
    std::size_t triangleCount_ = 0;
};

}  // namespace fluxwalk::render
