// Value noise of five octaves, on a hash of fractions.
float lattice(vec2 cell) {
    vec3 p = fract(vec3(cell.xyx) * .1031);
    p += dot(p, p.yzx + 33.33);
    return fract((p.x + p.y) * p.z);
}

float octave(in vec2 p) {
    vec2 cell = floor(p), f = fract(p);
    vec2 u = smoothstep(0.0, 1.0, f);
    return mix(mix(lattice(cell), lattice(cell + vec2(1, 0)), u.x),
               mix(lattice(cell + vec2(0, 1)), lattice(cell + 1.0), u.x), u.y);
}

float fract_noise(vec2 p) {
    float sum = 0., size = .5;
    for (int i = 0; i < 5; i++, size *= .5) {
        sum += size * octave(p);
        p = p * 2. + vec2(1.25, 0.5);
    }
    return sum;
}
