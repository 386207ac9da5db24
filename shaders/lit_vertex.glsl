// A side of an object with its solved irradiance. SURFACE: 0 of one colour, 1 with textures, 2 also with holes.

layout(location = 0) in vec3 position;    // metres
layout(location = 1) in vec3 irradiance;  // lux, each channel
#if SURFACE > 0
layout(location = 2) in vec2 texcoord0;
layout(location = 3) in vec2 texcoord1;

// Affine maps of the texture coordinates, and which set they start from.
uniform mat3 reflectanceTransform;
uniform mat3 emissionTransform;
uniform int reflectanceSet;
uniform int emissionSet;

out vec2 reflectanceCoordinate;
out vec2 emissionCoordinate;
#endif

uniform mat4 clipFromWorld;

out vec3 pointIrradiance;

void main() {
    pointIrradiance = irradiance;
#if SURFACE > 0
    vec2 forReflectance = reflectanceSet == 0 ? texcoord0 : texcoord1;
    vec2 forEmission = emissionSet == 0 ? texcoord0 : texcoord1;
    reflectanceCoordinate = (reflectanceTransform * vec3(forReflectance, 1.0)).xy;
    emissionCoordinate = (emissionTransform * vec3(forEmission, 1.0)).xy;
#endif
    gl_Position = clipFromWorld * vec4(position, 1.0);
}
