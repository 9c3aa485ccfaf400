// The exponential function by its power series.
fn series(x: f32) -> f32 {
    var sum = 1.0;
    var term = 1.0;
    for (var k = 1; k <= 12; k++) {
        term *= x / f32(k);
        sum += term;
    }
    return sum;
}
