// Components that are read and written one by one.
fn components(v: vec4<f32>) -> vec4<f32> {
    var a = v.wzyx;
    for (var i = 0; i < 3; i++) {
        a[i + 1] += a[i] * 0.5;
    }
    let first = v.rg;
    a = vec4<f32>(a.yx, first.yx + a.zz);
    a.z *= 3.0;
    var m = mat2x2<f32>(a.xy, a.zw);
    m[1] = m[0].yx;
    m[0].y = v[3];
    return vec4<f32>(m[0], m[1]) + a.xxyy;
}
