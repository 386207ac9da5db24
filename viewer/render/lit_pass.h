#pragma once

#include <map>
#include <memory>
#include <vector>

#include "core/scene/lighting.h"
#include "viewer/gl/pixel_size.h"
#include "viewer/render/false_color.h"
#include "viewer/render/gpu_mesh.h"
#include "viewer/render/textures.h"
#include "viewer/render/tone.h"

namespace fluxwalk::render {

/// What is drawn of the light; the numbers are those of the shaders.
enum class Output : std::uint8_t {
    screen = 0,  ///< sRGB
    values = 1,  ///< false colours, sRGB
    light = 2,   ///< linear luminance, cd/m2
    meter = 3    ///< luminance of what reflects and of what emits, cd/m2, in red and green
};

/// A blurred picture of the light that is mixed into what the eye sees (glow.h).
struct GlowLayer {
    GLuint texture = 0;  ///< linear luminance, cd/m2; 0 for none
    float part = 0.0f;   ///< of the light, 0 to 1
};

/// How lit surfaces are seen.
struct LitView {
    glm::mat4 clipFromWorld{1.0f};
    base::Vec3d eye{0.0};
    base::Vec3d forward{0.0, 0.0, -1.0};
    gl::PixelSize size;
    Output output = Output::screen;
    double exposure = 1.0;  ///< per cd/m2
    ToneCurve curve = ToneCurve::filmic;
    GlowLayer glow{};
    /// For values: illuminance, else luminance.
    bool isIlluminance = false;
    ValueScale scale = ValueScale::logarithmic;
    ValueRange range{};
    double isolineStep = 0.0;      ///< 0 for no lines
    base::Rgb skyLuminance{0.0f};  ///< behind everything, cd/m2
};

/// Draws lit sides, what lies behind them, and what one sees through; with shaders made for what each needs.
class LitPass {
  public:
    LitPass(const gl::Functions& gl, std::shared_ptr<const scene::Scene> scene);
    ~LitPass();

    Textures& textures() { return textures_; }
    /// How the lights are turned that the meshes were lit by; as they are by default.
    void setLighting(const scene::Lighting& lighting) { lighting_ = lighting; }
    const scene::Lighting& lighting() const { return lighting_; }

    /// Chunks that are seen of the opaque sides, near ones first, so that hidden ones cost little.
    void drawOpaque(const LitView& view, const std::vector<const GpuMesh*>& meshes);
    void drawBackground(const LitView& view);
    /// Far ones first.
    void drawBlended(const LitView& view, const std::vector<const GpuMesh*>& meshes);
    /// Triangles of the chunks that were seen last.
    std::size_t drawnTriangles() const { return drawnTriangles_; }

  private:
    struct Shader;
    struct Piece {
        double distance = 0.0;
        const GpuMesh* mesh = nullptr;
        const Chunk* chunk = nullptr;
    };

    const Shader& surfaceShader(const LitView& view, const scene::Material& material);
    const Shader& shaderFor(unsigned surface, const LitView& view);
    void setView(const Shader& shader, const LitView& view) const;
    void setMaterial(const Shader& shader, const GpuMesh& mesh);
    void findPieces(const LitView& view, const std::vector<const GpuMesh*>& meshes);
    void drawPieces(const LitView& view);
    void sendColorMap() const;

    const gl::Functions& gl_;
    std::shared_ptr<const scene::Scene> scene_;
    scene::Lighting lighting_;
    Textures textures_;
    gl::Texture colorMap_;
    gl::VertexArray noVertices_;
    /// By all that they were made for; made when first needed.
    std::map<unsigned, std::unique_ptr<Shader>> shaders_;
    std::vector<Piece> pieces_;
    std::size_t drawnTriangles_ = 0;
};

}  // namespace fluxwalk::render
