// Luminance of a diffuse surface, L = (reflectance * E + M) / pi. OUTPUT: 0 brought to the screen by tone.glsl,
// 1 values as colours by false_color.glsl, 2 the luminance itself, 3 for the light meter: luminance of what
// reflects, luminance of what emits. SURFACE as in lit_vertex.glsl; only what has holes discards, since that
// keeps the GPU from testing depth before it shades.

in vec3 pointIrradiance;

uniform vec4 reflectance;  // rgb, and alpha
uniform vec3 emission;     // lm/m2, zero on a side that does not emit
#if SURFACE > 0
in vec2 reflectanceCoordinate;
in vec2 emissionCoordinate;
uniform sampler2D reflectanceTexture;
uniform sampler2D emissionTexture;
#endif
#if SURFACE > 1
uniform float alphaCutoff;  // below it is a hole
#endif
#if OUTPUT == 1
uniform int shown;  // 1 illuminance, 2 luminance
#endif

out vec4 color;

const float kInversePi = 0.318309886183791;
const vec3 kPhotometric = vec3(0.2126, 0.7152, 0.0722);

void main() {
    vec4 surface = reflectance;
    vec3 emitted = emission;
#if SURFACE > 0
    surface *= texture(reflectanceTexture, reflectanceCoordinate);
    emitted *= texture(emissionTexture, emissionCoordinate).rgb;
#endif
#if SURFACE > 1
    if (surface.a < alphaCutoff) {
        discard;
    }
#endif
    vec3 irradiance = max(pointIrradiance, 0.0);
    vec3 luminance = (surface.rgb * irradiance + emitted) * kInversePi;
#if OUTPUT == 0
    color = vec4(toDisplay(luminance), surface.a);
#elif OUTPUT == 1
    color = vec4(falseColor(dot(kPhotometric, shown == 1 ? irradiance : luminance)), 1.0);
#elif OUTPUT == 2
    color = vec4(luminance, surface.a);
#else
    float emits = step(1e-30, dot(kPhotometric, emitted));
    color = vec4(dot(kPhotometric, luminance) * vec2(1.0 - emits, emits), 0.0, surface.a);
#endif
}
