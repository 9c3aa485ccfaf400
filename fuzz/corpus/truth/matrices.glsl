1// Products, determinants, transposes.
const mat3 TINT = mat3(0.5, 0.25, 0.125, 0.75, 1.5, 0.0, 0.25, 0.5, 2.0);

mat3 turn(float angle) {
    float c = cos(angle), s = sin(angle);
    return mat3(c, s, 0.0, -s, c, 0.0, 0.0, 0.0, 1.0);
}

vec4 matrices(vec3 v, float angle) {
    mat3 m = turn(angle) * TINT;
    vec3 along = m * v;
    vec3 against = v * m;
    mat2x3 wide = mat2x3(v, along);
    mat2 square = transpose(wide) * wide;
    mat4 grown = mat4(vec4(along, 1.0), vec4(v, 0.5), vec4(0.0, 1.0, 2.0, v.x), vec4(1.0));
    grown[1][2] += 0.25;
    grown[2] = grown[2] * 2.0 - grown[0];
    return vec4(dot(along, against), determinant(m - 0.5 * TINT), determinant(square),
                determinant(grown));
}
