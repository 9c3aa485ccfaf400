// Value noise of five octaves, on an integer hash.
uint scrambled(uint n) {
    uint state = n * 747796405u + 2891336453u;
    state = ((state >> ((state >> 28) + 4u)) ^ state) * 277803737u;
    return (state >> 22) ^ state;
}

float lattice(ivec2 cell) {
    uint n = scrambled(uint(cell.x) + scrambled(uint(cell.y)));
    return float(n & 0xffffu) / 65535.0;
}

float octave(vec2 p) {
    ivec2 cell = ivec2(floor(p));
    vec2 f = fract(p);
    vec2 u = f * f * (3.0 - 2.0 * f);
    float low = mix(lattice(cell), lattice(cell + ivec2(1, 0)), u.x);
    float high = mix(lattice(cell + ivec2(0, 1)), lattice(cell + ivec2(1)), u.x);
    return mix(low, high, u.y);
}

float hashed_noise(vec2 p) {
    float sum = 0.0, size = 0.5;
    const mat2 turn = mat2(1.6, 1.2, -1.2, 1.6);
    for (int i = 0; i < 5; ++i) {
        sum += size * octave(p);
        p = turn * p;
        size *= 0.5;
    }
    return sum;
}
