0// Several ways out.
fn early(x: f32, y: f32) -> f32 {
    if (x < 0.25) {
        if (y > 0.5) {
            return x * y;
        }
        return sqrt(x + y);
    } else if (x + y > 1.5) {
        return 2.0 - y;
    }
    var sum = x;
    if (y < 0.75) {
        sum += y * y;
    } else {
        sum -= y;
    }
    return select(sum, -sum, x < y);
}
