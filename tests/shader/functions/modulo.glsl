// The remainder of GLSL has the sign of the divisor.
vec4 modulo(float x, vec2 y) {
    vec2 m = mod(y, 0.75) + mod(vec2(x), y + 3.0);
    return vec4(mod(x, 0.3), mod(x, -0.3), m);
}
