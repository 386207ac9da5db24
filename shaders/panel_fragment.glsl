in vec2 coordinate;
in vec4 tint;

uniform sampler2D glyphs;

out vec4 color;

void main() {
    color = tint * texture(glyphs, coordinate);
}
