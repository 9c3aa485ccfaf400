// Directions of a ray at a surface.
vec4 bounce(const in vec3 d, in vec3 n) {
    vec3 incident = normalize(d);
    vec3 normal = faceforward(normalize(n), incident, n);
    vec3 mirrored = reflect(incident, normal), bent = refract(incident, normal, 1.25);
    vec3 side = cross(mirrored, bent);
    return vec4(dot(mirrored, bent), length(side), distance(mirrored, bent), side.x + bent.z);
}
