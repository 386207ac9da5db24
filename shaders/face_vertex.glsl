// Triangles in colours of their own.

layout(location = 0) in vec3 position;  // metres
layout(location = 1) in vec3 color;     // sRGB

uniform mat4 clipFromWorld;

out vec3 faceColor;
out vec3 facePosition;

void main() {
    faceColor = color;
    facePosition = position;
    gl_Position = clipFromWorld * vec4(position, 1.0);
}
