// Variables that functions share.
int calls = 2;
vec2 seed = vec2(0.5, 0.25);
const float STEP = 0.125;

float next() {
    calls++;
    seed = vec2(seed.y, fract(seed.x * 1.5 + STEP * float(calls)));
    return seed.x;
}

vec2 state(float x) {
    seed.x += x;
    float sum = 0.0;
    for (int i = 0; i < 4; i++) sum += next();
    if (x > 0.5) sum -= next();
    return vec2(sum, seed.y + seed.x);
}
