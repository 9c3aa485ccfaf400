1// What is written to a parameter.
float lobes(float n_dot_l, float roughness, out vec2 specular) {
    float alpha = roughness * roughness;
    specular = vec2(alpha, 1.0);
    specular.y /= n_dot_l + alpha;
    specular[0] *= n_dot_l;
    return n_dot_l * (1.0 - alpha);
}

vec3 all_lobes(float n_dot_l, float roughness) {
    vec2 specular;
    float diffuse = lobes(n_dot_l, roughness, specular);
    return vec3(diffuse, specular);
}
