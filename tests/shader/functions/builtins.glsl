// Functions that the language has.
struct Values {
    vec4 rounded;
    vec4 parts;
    vec4 powers;
    vec4 angles;
    vec4 blends;
};

Values builtins(float x, float y) {
    Values v;
    v.rounded = vec4(floor(x), ceil(x), trunc(x), roundEven(x));
    float whole = trunc(x);
    float fraction = x - whole;
    v.parts = vec4(fraction, whole, fract(x), x - 0.75 * trunc(x / 0.75));
    v.powers = vec4(exp2(x) + exp(y), log2(y) * log(y + 1.0), pow(y, x), inversesqrt(y) + sqrt(y));
    v.angles = vec4(
        sin(x) * cos(y) + tan(y * 0.5),
        atan(x, y) + asin(x * 0.25) + acos(y * 0.25) + atan(x),
        radians(x) + degrees(y) * 0.01,
        sinh(x) + cosh(y) + tanh(x) + asinh(x) + acosh(y + 1.0) + atanh(x * 0.25)
    );
    v.blends = vec4(
        smoothstep(-1.0, 2.0, x) + step(y, x) + sign(x),
        mix(x, y, 0.3) + clamp(x, -0.5, 0.5) + clamp(y, 0.0, 1.0),
        min(x, y) * max(x, y) - abs(x),
        fma(x, y, 0.5) + ldexp(x, 3) + length(vec2(x, y))
    );
    return v;
}
