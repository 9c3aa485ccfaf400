// Products, determinants, transposes.
const TINT = mat3x3<f32>(0.5, 0.25, 0.125, 0.75, 1.5, 0.0, 0.25, 0.5, 2.0);

fn turn(angle: f32) -> mat3x3<f32> {
    let c = cos(angle);
    let s = sin(angle);
    return mat3x3<f32>(vec3(c, s, 0.0), vec3(-s, c, 0.0), vec3(0.0, 0.0, 1.0));
}

fn matrices(v: vec3<f32>, angle: f32) -> vec4<f32> {
    let m = turn(angle) * TINT;
    let along = m * v;
    let against = v * m;
    let wide = mat2x3<f32>(v, along);
    let square = transpose(wide) * wide;
    var grown = mat4x4<f32>(vec4(along, 1.0), vec4(v, 0.5), vec4(0.0, 1.0, 2.0, v.x), vec4(1.0));
    grown[1][2] += 0.25;
    grown[2] = grown[2] * 2.0 - grown[0];
    return vec4<f32>(
        dot(along, against),
        determinant(m - 0.5 * TINT),
        determinant(square),
        determinant(grown),
    );
}
