// Tables of constants.
const vec2 POISSON[4] = vec2[](
    vec2(-0.94, -0.4), vec2(0.945, -0.77), vec2(-0.095, -0.93), vec2(0.345, 0.29)
);
const float WEIGHTS[] = float[](0.1, 0.2, 0.3, 0.4);

float table(vec2 p) {
    float sum = 0.0;
    float powers[5];
    powers[0] = 1.0;
    for (int i = 0; i < 4; i++) {
        vec2 d = p - POISSON[i];
        sum += WEIGHTS[3 - i] * exp(-dot(d, d));
        powers[i + 1] = powers[i] * p.x;
    }
    return sum + powers[4] - powers[1];
}
