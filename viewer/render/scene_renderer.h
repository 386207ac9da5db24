#pragma once

#include <optional>
#include <unordered_map>
#include <vector>

#include "core/scene/lighting.h"
#include "viewer/render/color_map.h"
#include "viewer/render/false_color.h"
#include "viewer/render/glow.h"
#include "viewer/render/lit_pass.h"
#include "viewer/render/overlay.h"

namespace fluxwalk::render {

/// What is shown of the surfaces; the first numbers are those of the shader.
enum class Shown : std::uint8_t {
    picture = 0,
    illuminance = 1,
    luminance = 2,
    level,  ///< of the elements, as colours of the overlay's faces, as all below
    residual,
    objects,
    linkErrors
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
    bool glow = false;          ///< around what shines, in the picture

    bool operator==(const DrawSettings&) const = default;
};

/// Draws the lit sides of one scene.
class SceneRenderer {
  public:
    SceneRenderer(const gl::Functions& gl, std::shared_ptr<const scene::Scene> scene);

    /// The meshes to draw from now on, and the lights that they are lit by. Those that are already on the GPU
    /// (same pointer) stay there; of others of the same side only what differs is sent. Returns how many
    /// meshes had to be sent, in part or whole.
    std::size_t setMeshes(const scene::LitMeshes& meshes, const scene::Lighting& lighting = {});
    std::size_t triangleCount() const { return triangleCount_; }
    /// Of the last picture: those that were not left out as out of sight.
    std::size_t drawnTriangles() const { return pass_.drawnTriangles(); }
    const base::Box& bounds() const { return bounds_; }

    /// Whether textures stay sharp where they are seen at a grazing angle, as at first; without, a processor
    /// draws twice as fast.
    void setSharpTextures(bool areSharp) { pass_.textures().setSharp(areSharp); }

    /// Exposure for what a camera sees (light_meter.h). Draws a small picture; the bound target stays bound.
    double meterExposure(const scene::Camera& camera, double aspect);
    /// The range in which values are shown: that of the settings, or the one found for the present meshes.
    ValueRange rangeOf(const DrawSettings& settings);
    const ColorMap& colorMap() const { return colorMap_; }

    /// What is drawn where the settings ask for faces, element edges or cluster boxes; until it has faces,
    /// lit surfaces are drawn.
    Overlay& overlay() { return overlay_; }

    /// Draws into the bound target, over all of it. Where the settings have no exposure, it is metered.
    void draw(const scene::Camera& camera, double aspect, const DrawSettings& settings);
    /// Draws linear luminance in cd/m2 into the bound target, which has floats.
    void drawLight(const scene::Camera& camera, double aspect);

  private:
    LitView viewOf(const scene::Camera& camera, double aspect, Output output) const;
    LitView viewOf(const scene::Camera& camera, double aspect, const DrawSettings& settings);
    void addGlow(LitView& view);
    void begin() const;
    void drawSurfaces(const LitView& view);
    const MeshLuminance& luminance();

    const gl::Functions& gl_;
    std::shared_ptr<const scene::Scene> scene_;
    LitPass pass_;
    ColorMap colorMap_;
    Overlay overlay_;
    std::optional<Glow> glow_;
    std::unique_ptr<gl::RenderTarget> meterTarget_;
    std::unordered_map<const scene::LitMesh*, GpuMesh> meshes_;
    /// In the order given, so that pictures do not depend on addresses.
    std::vector<const GpuMesh*> opaque_;
    std::vector<const GpuMesh*> blended_;
    /// Of the present meshes, once somebody asks.
    std::optional<MeshLuminance> luminance_;
    base::Box bounds_;
    std::size_t triangleCount_ = 0;
};

}  // namespace fluxwalk::render
