1struct f_outputs {
    a: f32,
    b: f32,
    c: f32,
    d: f32,
    e: f32,
}
fn f(x: f32) -> f32 {
    return select(1.0, sqrt(x), 0.0 < x);
}
