// A choice by number.
fn cases(x: f32, y: f32) -> f32 {
    var sum = 0.0;
    for (var i = 0; i < 6; i++) {
        switch i {
            case 0, 4: { sum += x; }
            default: { sum *= 1.25; }
            case 1: {
                if (x < y) { break; }
                sum += 2.0 * y;
            }
            case 3: { continue; }
        }
        sum += 0.125;
    }
    return sum;
}
