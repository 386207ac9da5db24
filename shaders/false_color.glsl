// Values as colours, with lines of equal value at round numbers. viewer/render/false_color.cpp is the same in
// C++; a test compares them.

uniform sampler2D colorMap;  // 256 x 1
uniform int valueScale;      // 0 logarithmic, 1 linear
uniform vec2 valueRange;
uniform float isolineStep;  // of a linear scale; 0 for no lines, logarithmic: any other for lines

const float kInverseLog10 = 0.4342944819;

// Part of a line, 0 to 1, at a distance from its middle; both in a unit that grows by `change` a pixel. Flat
// fields have no line, nor have edges of objects, where values jump.
float lineAt(float distance, float change) {
    float line = 1.0 - smoothstep(0.4 * change, 1.2 * change, distance);
    return change > 1e-6 ? line * (1.0 - smoothstep(0.06, 0.12, change)) : 0.0;
}

float placeOf(float value) {
    float place = valueScale == 1
                      ? (value - valueRange.x) / (valueRange.y - valueRange.x)
                      : log(max(value, 1e-30) / valueRange.x) / log(valueRange.y / valueRange.x);
    return clamp(place, 0.0, 1.0);
}

// Part of the line at the nearest round number, and that number.
vec2 isolineAt(float value) {
    if (valueScale == 1) {
        float steps = value / isolineStep;
        float nearest = floor(steps + 0.5);
        return vec2(lineAt(abs(steps - nearest), fwidth(steps)), nearest * isolineStep);
    }
    float decades = kInverseLog10 * log(max(value, 1e-30));
    float part = fract(decades);
    float round = part < 0.150515 ? 0.0 : part < 0.5 ? 0.30103 : part < 0.849485 ? 0.69897 : 1.0;
    return vec2(lineAt(abs(part - round), fwidth(decades)), pow(10.0, floor(decades) + round));
}

vec3 falseColor(float value) {
    vec3 shade = texelFetch(colorMap, ivec2(int(placeOf(value) * 255.0 + 0.5), 0), 0).rgb;
    if (isolineStep <= 0.0) {
        return shade;
    }
    // Light lines on the dark half of the colours, dark ones on the light half.
    vec2 line = isolineAt(value);
    return mix(shade, vec3(step(placeOf(line.y), 0.5)), 0.6 * line.x);
}
