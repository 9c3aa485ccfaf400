// What is written to a parameter.
fn lobes(n_dot_l: f32, roughness: f32, specular: ptr<function, vec2<f32>>) -> f32 {
    let alpha = roughness * roughness;
    *specular = vec2<f32>(alpha, 1.0);
    (*specular).y /= n_dot_l + alpha;
    (*specular)[0] *= n_dot_l;
    return n_dot_l * (1.0 - alpha);
}

fn all_lobes(n_dot_l: f32, roughness: f32) -> vec3<f32> {
    var specular: vec2<f32>;
    let diffuse = lobes(n_dot_l, roughness, &specular);
    return vec3<f32>(diffuse, specular);
}
