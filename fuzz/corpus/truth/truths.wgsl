0// Truth values.
fn truths(v: vec3<f32>, w: vec3<f32>) -> vec3<f32> {
    let below = v < w;
    let chosen = select(v, w, below);
    let some = any(below) && !all(v <= w);
    let exactly = (v.x > 0.5) != (w.x > 0.5) || (below.y && v.z >= w.z);
    var sum = 0.0;
    if (some) { sum += 1.0; }
    if (exactly) { sum += chosen.x; }
    if (below.x & below.y | below.z) { sum -= w.y; }
    return vec3<f32>(sum, chosen.y + f32(some), chosen.z * f32(below.x));
}
