// Tables of constants.
const POISSON = array<vec2<f32>, 4>(
    vec2<f32>(-0.94, -0.4), vec2<f32>(0.945, -0.77), vec2<f32>(-0.095, -0.93), vec2<f32>(0.345, 0.29)
);
const WEIGHTS = array(0.1, 0.2, 0.3, 0.4);

fn table(p: vec2<f32>) -> f32 {
    var sum = 0.0;
    var powers: array<f32, 5>;
    powers[0] = 1.0;
    for (var i = 0; i < 4; i++) {
        let d = p - POISSON[i];
        sum += WEIGHTS[3 - i] * exp(-dot(d, d));
        powers[i + 1] = powers[i] * p.x;
    }
    return sum + powers[4] - powers[1];
}
