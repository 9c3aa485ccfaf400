// What only GLSL has.
vec3 inverses(vec2 v, float s) {
    mat2 small = inverse(mat2(1.0 + s, v.x, v.y, 3.0));
    mat3 m = inverse(mat3(2.0, v.x, s, v.y, 3.0, 0.25, s, 0.5, 4.0 + v.x));
    mat4 large = inverse(mat4(3.0, v.x, 0.0, s, v.y, 4.0, 0.5, 0.0, s, v.x, 5.0, v.y, 0.25, s, 1.0, 6.0));
    mat3 outer = outerProduct(vec3(v, s), vec3(s, v)) + matrixCompMult(m, mat3(2.0));
    return vec3((small * v).x, (m * vec3(v, 1.0)).y + outer[2].z, (large * vec4(v, s, 1.0)).w);
}
