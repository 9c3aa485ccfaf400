// Numbers in two parts; bits of floats.
fn taken_apart(x: f32, y: f32) -> vec4<f32> {
    let both = frexp(x);
    let signs = modf(vec2<f32>(x, -y));
    let whole = signs.whole;
    return vec4<f32>(both.fract, f32(both.exp), signs.fract.y * whole.x, whole.y);
}
