0// Structures in structures, and arrays in them.
struct Lobe {
    weight: f32,
    tint: vec3<f32>,
}

struct Material {
    lobes: array<Lobe, 2>,
    roughness: f32,
}

struct Shaded {
    color: vec3<f32>,
    alpha: f32,
}

fn made(roughness: f32, tint: vec3<f32>) -> Material {
    var m = Material(array<Lobe, 2>(Lobe(0.25, tint), Lobe(0.75, vec3(1.0))), roughness);
    m.lobes[1].tint.y = roughness;
    m.lobes[0].weight += 0.5 * tint.z;
    return m;
}

fn material(roughness: f32, tint: vec3<f32>) -> Shaded {
    var m = made(roughness, tint);
    let copy = m;
    var shaded: Shaded;
    for (var i = 0; i < 2; i++) {
        shaded.color += m.lobes[i].weight * m.lobes[i].tint;
        m.lobes[0].weight = 0.125;
    }
    shaded.alpha = copy.lobes[0].weight + m.roughness;
    return shaded;
}
