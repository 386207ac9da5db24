// From luminance to the screen: exposure, tone curve, sRGB encoding, dithering. viewer/render/tone.cpp is the
// same in C++; a test compares them. CURVE: 0 linear, 1 filmic, 2 Reinhard, 3 hue.

uniform float exposure;  // per cd/m2
#if GLOW
uniform sampler2D glow;   // blurred luminance, cd/m2
uniform float glowPart;   // of the light that comes to the eye by way of it
uniform vec2 glowScale;   // from pixels to the picture
#endif

// A rational curve through (0, 0) with slope 0.6, (0.18, 0.18), (1, 0.782) and (8, 0.99), tending to 1.
vec3 filmic(vec3 x) {
    return x * (3.68 * x + 0.6) / (x * (3.68 * x + 0.79) + 1.0);
}

// Reinhard et al. 2002, eq. 4, on luminance: keeps the hue; four times white becomes white.
vec3 reinhard(vec3 x) {
    float y = dot(x, vec3(0.2126, 0.7152, 0.0722));
    return x * (1.0 + y / 16.0) / (1.0 + y);
}

// The filmic curve on the brightest channel, the others in proportion: the hue stays. What shines takes on white,
// by the eighth power of the curve, as film and eyes do; mixing with grey leaves the hue too.
vec3 keepHue(vec3 x) {
    float peak = max(max(x.r, x.g), max(x.b, 1e-12));
    float curved = filmic(vec3(peak)).r;
    float square = curved * curved;
    float white = square * square * square * square;
    return curved * mix(x / peak, vec3(1.0), white);
}

vec3 encodeSrgb(vec3 x) {
    return mix(12.92 * x, 1.055 * pow(max(x, 0.0031308), vec3(1.0 / 2.4)) - 0.055,
               greaterThan(x, vec3(0.0031308)));
}

// Between -0.5 and 0.5, fixed to the pixel: smooth gradients get no bands, still pictures no flicker. Jimenez 2014,
// interleaved gradient noise: neighbours differ much, so that the eye sees only their mean.
float ditherNoise(vec2 pixel) {
    return fract(52.9829189 * fract(dot(pixel, vec2(0.06711056, 0.00583715)))) - 0.5;
}

vec3 encodeForScreen(vec3 display) {
    return encodeSrgb(clamp(display, 0.0, 1.0)) + ditherNoise(gl_FragCoord.xy) / 255.0;
}

vec3 toDisplay(vec3 luminance) {
#if GLOW
    luminance = mix(luminance, texture(glow, gl_FragCoord.xy * glowScale).rgb, glowPart);
#endif
    vec3 x = exposure * luminance;
#if CURVE == 1
    x = filmic(x);
#elif CURVE == 2
    x = reinhard(x);
#elif CURVE == 3
    x = keepHue(x);
#endif
    return encodeForScreen(x);
}
