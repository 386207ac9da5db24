// What lies behind the scene: its uniform sky above the horizon, else a quiet dark grey that is no light.
// OUTPUT as in lit_fragment.glsl, 0 to 3.

in vec3 direction;

uniform vec3 skyLuminance;  // cd/m2, zero for none and where light is not what is shown

out vec4 color;

void main() {
    float height = normalize(direction).y;
    float isSky = step(1e-30, skyLuminance.r + skyLuminance.g + skyLuminance.b) * smoothstep(-0.004, 0.004, height);
#if OUTPUT < 2
    vec3 nothing = encodeForScreen(mix(vec3(0.0075), vec3(0.022), smoothstep(-0.6, 0.6, height)));
    color = vec4(mix(nothing, toDisplay(skyLuminance), isSky), 1.0);
#elif OUTPUT == 2
    color = vec4(isSky * skyLuminance, 1.0);
#else
    color = vec4(isSky * dot(skyLuminance, vec3(0.2126, 0.7152, 0.0722)), 0.0, 0.0, 1.0);
#endif
}
