0// Calls of calls, of which some write to what they are given.
fn square(x: f32) -> f32 { return x * x; }

fn fourth(x: f32) -> f32 { return square(square(x)); }

fn order(a: ptr<function, f32>, b: ptr<function, f32>) -> bool {
    if (*a <= *b) { return false; }
    let t = *a;
    *a = *b;
    *b = t;
    return true;
}

fn nested(x: f32, y: f32) -> vec2<f32> {
    var low = x;
    var high = fourth(y);
    let swapped = order(&low, &high);
    var third = square(x) - y;
    order(&low, &third);
    return vec2<f32>(low + 2.0 * high - third, select(fourth(third), square(low), swapped));
}
