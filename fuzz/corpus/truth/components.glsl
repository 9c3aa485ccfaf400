1// Components that are read and written one by one.
vec4 components(vec4 v) {
    vec4 a = v.wzyx;
    for (int i = 0; i < 3; i++) a[i + 1] += a[i] * 0.5;
    vec2 first = v.rg;
    a.xy = a.yx;
    a.zw = first.ts + a.zz;
    a.b *= 3.0;
    mat2 m = mat2(a.xy, a.zw);
    m[1] = m[0].yx;
    m[0].y = v[3];
    return vec4(m[0], m[1]) + a.xxyy;
}
