// Luminance of a diffuse surface, L = (reflectance * E + M) / pi, brought to the screen by tone.glsl.

in vec3 pointIrradiance;
in vec2 reflectanceCoordinate;
in vec2 emissionCoordinate;

uniform vec4 reflectance;  // rgb, and alpha
uniform vec3 emission;     // lm/m2, zero on a side that does not emit
uniform float alphaCutoff;  // below it is a hole; negative for none
uniform sampler2D reflectanceTexture;
uniform sampler2D emissionTexture;

out vec4 color;

const float kPi = 3.14159265358979;

void main() {
    vec4 surface = reflectance * texture(reflectanceTexture, reflectanceCoordinate);
    if (surface.a < alphaCutoff) {
        discard;
    }
    vec3 emitted = emission * texture(emissionTexture, emissionCoordinate).rgb;
    vec3 luminance = (surface.rgb * max(pointIrradiance, 0.0) + emitted) / kPi;
    color = vec4(toDisplay(luminance), surface.a);
}
