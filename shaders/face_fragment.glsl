in vec3 faceColor;
in vec3 facePosition;

uniform vec3 eye;
uniform float relief;  // how much faces darken that are seen from the side, 0 to 1

out vec4 color;

void main() {
    vec3 normal = normalize(cross(dFdx(facePosition), dFdy(facePosition)));
    float cosine = abs(dot(normal, normalize(eye - facePosition)));
    color = vec4(faceColor * (1.0 - relief * (1.0 - cosine)), 1.0);
}
