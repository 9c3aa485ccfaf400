// Value noise of five octaves, on a hash of fractions.
fn lattice(cell: vec2<f32>) -> f32 {
    var p = fract(cell.xyx * 0.1031);
    p += dot(p, p.yzx + 33.33);
    return fract((p.x + p.y) * p.z);
}

fn octave(p: vec2<f32>) -> f32 {
    let cell = floor(p);
    let f = fract(p);
    let u = smoothstep(vec2(0.0), vec2(1.0), f);
    let low = mix(lattice(cell), lattice(cell + vec2(1.0, 0.0)), u.x);
    let high = mix(lattice(cell + vec2(0.0, 1.0)), lattice(cell + 1.0), u.x);
    return mix(low, high, u.y);
}

fn fract_noise(p: vec2<f32>) -> f32 {
    var sum = 0.0;
    var size = 0.5;
    var at = p;
    for (var i = 0; i < 5; i += 1) {
        sum += size * octave(at);
        at = at * 2.0 + vec2<f32>(1.25, 0.5);
        size *= 0.5;
    }
    return sum;
}
