// Mean of four places around one, each between four pixels of the source.

in vec2 place;

uniform sampler2D source;
uniform vec2 reach;  // of the four places, in parts of the picture
uniform float part;  // opacity over what is there

out vec4 color;

void main() {
    vec3 sum = texture(source, place + reach).rgb + texture(source, place - reach).rgb +
               texture(source, place + vec2(reach.x, -reach.y)).rgb +
               texture(source, place + vec2(-reach.x, reach.y)).rgb;
    color = vec4(0.25 * sum, part);
}
