// One triangle over the whole picture, behind everything, with the direction that each pixel looks in.

uniform mat4 worldFromClip;
uniform vec3 eye;

out vec3 direction;

void main() {
    vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
    vec4 far = worldFromClip * vec4(corner, 1.0, 1.0);
    direction = far.xyz / far.w - eye;
    gl_Position = vec4(corner, 1.0, 1.0);
}
