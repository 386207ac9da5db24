// What lies behind the scene: its uniform sky above the horizon, else a quiet dark grey that is no light.

in vec3 direction;

uniform vec3 skyLuminance;  // cd/m2, zero for none and where light is not what is shown

out vec4 color;

void main() {
    float height = normalize(direction).y;
    vec3 nothing = encodeForScreen(mix(vec3(0.0075), vec3(0.022), smoothstep(-0.6, 0.6, height)));
    float hasSky = step(1e-30, skyLuminance.r + skyLuminance.g + skyLuminance.b);
    color = vec4(mix(nothing, toDisplay(skyLuminance), hasSky * smoothstep(-0.004, 0.004, height)), 1.0);
}
