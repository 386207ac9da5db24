// A still, as far as it is made, over a picture of what it will show. Places are those of glow_vertex.glsl.

in vec2 place;

uniform sampler2D still;  // luminance in cd/m2, rows from the top; alpha 1 where it is made
uniform sampler2D under;  // luminance in cd/m2
uniform vec2 reach;       // between two taps, in parts of the still
uniform int taps;         // in each direction, so that a still that is shown smaller keeps smooth edges

out vec4 color;

void main() {
    vec2 first = vec2(place.x, 1.0 - place.y) - 0.5 * float(taps - 1) * reach;
    vec4 sum = vec4(0.0);
    for (int y = 0; y < taps; ++y) {
        for (int x = 0; x < taps; ++x) {
            sum += texture(still, first + vec2(x, y) * reach);
        }
    }
    sum /= float(taps * taps);
    color = vec4(toDisplay(sum.rgb + (1.0 - sum.a) * texture(under, place).rgb), 1.0);
}
