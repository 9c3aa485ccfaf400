// Functions that the language has.
struct Values {
    rounded: vec4<f32>,
    parts: vec4<f32>,
    powers: vec4<f32>,
    angles: vec4<f32>,
    blends: vec4<f32>,
}

fn builtins(x: f32, y: f32) -> Values {
    var v: Values;
    v.rounded = vec4<f32>(floor(x), ceil(x), trunc(x), round(x));
    let parts = modf(x);
    v.parts = vec4<f32>(parts.fract, parts.whole, fract(x), x % 0.75);
    v.powers = vec4<f32>(exp2(x) + exp(y), log2(y) * log(y + 1.0), pow(y, x), inverseSqrt(y) + sqrt(y));
    v.angles = vec4<f32>(
        sin(x) * cos(y) + tan(y * 0.5),
        atan2(x, y) + asin(x * 0.25) + acos(y * 0.25) + atan(x),
        radians(x) + degrees(y) * 0.01,
        sinh(x) + cosh(y) + tanh(x) + asinh(x) + acosh(y + 1.0) + atanh(x * 0.25),
    );
    v.blends = vec4<f32>(
        smoothstep(-1.0, 2.0, x) + step(y, x) + sign(x),
        mix(x, y, 0.3) + clamp(x, -0.5, 0.5) + saturate(y),
        min(x, y) * max(x, y) - abs(x),
        fma(x, y, 0.5) + ldexp(x, 3) + length(vec2(x, y)),
    );
    return v;
}
