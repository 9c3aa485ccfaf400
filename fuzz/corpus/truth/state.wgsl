0// Variables that functions share.
var<private> calls: i32 = 2;
var<private> seed: vec2<f32> = vec2<f32>(0.5, 0.25);
const STEP = 0.125;

fn next() -> f32 {
    calls += 1;
    seed = vec2<f32>(seed.y, fract(seed.x * 1.5 + STEP * f32(calls)));
    return seed.x;
}

fn state(x: f32) -> vec2<f32> {
    seed.x += x;
    var sum = 0.0;
    for (var i = 0; i < 4; i++) { sum += next(); }
    if (x > 0.5) { sum -= next(); }
    return vec2<f32>(sum, seed.y + seed.x);
}
