// Lines on surfaces or in space, a little nearer to the eye than what they lie on.

layout(location = 0) in vec3 position;  // metres
layout(location = 1) in vec3 normal;    // of the surface, towards the side that the line is on; 0 in space

uniform mat4 clipFromWorld;
uniform vec3 eye;

out float facing;

void main() {
    vec3 toEye = eye - position;
    facing = normal == vec3(0.0) ? 1.0 : dot(normal, toEye);
    gl_Position = clipFromWorld * vec4(position + 0.0015 * toEye, 1.0);
}
