// Directions of a ray at a surface.
fn bounce(d: vec3<f32>, n: vec3<f32>) -> vec4<f32> {
    let incident = normalize(d);
    let normal = faceForward(normalize(n), incident, n);
    let mirrored = reflect(incident, normal);
    let bent = refract(incident, normal, 1.25);
    let side = cross(mirrored, bent);
    return vec4<f32>(dot(mirrored, bent), length(side), distance(mirrored, bent), side.x + bent.z);
}
