// Luminance of a diffuse surface, L = (reflectance * E + M) / pi, brought to the screen by tone.glsl, or what
// else is shown of it, as colours by false_color.glsl.

in vec3 pointIrradiance;
in vec2 reflectanceCoordinate;
in vec2 emissionCoordinate;

uniform vec4 reflectance;  // rgb, and alpha
uniform vec3 emission;     // lm/m2, zero on a side that does not emit
uniform float alphaCutoff;  // below it is a hole; negative for none
uniform int shown;         // 0 picture, 1 illuminance, 2 luminance
uniform sampler2D reflectanceTexture;
uniform sampler2D emissionTexture;

out vec4 color;

const float kPi = 3.14159265358979;
const vec3 kPhotometric = vec3(0.2126, 0.7152, 0.0722);

void main() {
    vec4 surface = reflectance * texture(reflectanceTexture, reflectanceCoordinate);
    if (surface.a < alphaCutoff) {
        discard;
    }
    vec3 emitted = emission * texture(emissionTexture, emissionCoordinate).rgb;
    vec3 luminance = (surface.rgb * max(pointIrradiance, 0.0) + emitted) / kPi;
    if (shown == 0) {
        color = vec4(toDisplay(luminance), surface.a);
    } else {
        color = vec4(falseColor(dot(kPhotometric, shown == 1 ? max(pointIrradiance, 0.0) : luminance)), 1.0);
    }
}
