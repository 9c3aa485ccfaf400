// A choice by a number that depends on an input.
fn chosen(x: f32, y: f32) -> f32 {
    switch i32(floor(x)) {
        case -1: { return y; }
        case 0: { return y * y; }
        case 2: { break; }
        default: { return 1.0 - y; }
    }
    return x * y;
}
