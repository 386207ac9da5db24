// Dear ImGui's triangles: pixels from the top left.

layout(location = 0) in vec2 position;
layout(location = 1) in vec2 texcoord;
layout(location = 2) in vec4 color;

uniform vec4 clipFromPixels;  // scale, offset

out vec2 coordinate;
out vec4 tint;

void main() {
    coordinate = texcoord;
    tint = color;
    gl_Position = vec4(position * clipFromPixels.xy + clipFromPixels.zw, 0.0, 1.0);
}
