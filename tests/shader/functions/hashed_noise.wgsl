// Value noise of five octaves, on an integer hash.
fn scrambled(n: u32) -> u32 {
    var state = n * 747796405u + 2891336453u;
    state = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return (state >> 22u) ^ state;
}

fn lattice(cell: vec2<i32>) -> f32 {
    let n = scrambled(u32(cell.x) + scrambled(u32(cell.y)));
    return f32(n & 0xffffu) / 65535.0;
}

fn octave(p: vec2<f32>) -> f32 {
    let cell = vec2<i32>(floor(p));
    let f = fract(p);
    let u = f * f * (3.0 - 2.0 * f);
    let low = mix(lattice(cell), lattice(cell + vec2(1, 0)), u.x);
    let high = mix(lattice(cell + vec2(0, 1)), lattice(cell + vec2(1, 1)), u.x);
    return mix(low, high, u.y);
}

fn hashed_noise(p: vec2<f32>) -> f32 {
    var sum = 0.0;
    var size = 0.5;
    var at = p;
    for (var i = 0u; i < 5u; i += 1u) {
        sum += size * octave(at);
        at = mat2x2<f32>(1.6, 1.2, -1.2, 1.6) * at;
        size *= 0.5;
    }
    return sum;
}
