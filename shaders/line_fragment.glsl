in float facing;

uniform vec4 lineColor;  // sRGB and opacity

out vec4 color;

void main() {
    if (facing <= 0.0) {
        discard;
    }
    color = lineColor;
}
