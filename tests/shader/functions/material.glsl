// Structures in structures, and arrays in them.
struct Lobe {
    float weight;
    vec3 tint;
};

struct Material {
    Lobe lobes[2];
    float roughness;
};

struct Shaded {
    vec3 color;
    float alpha;
};

Material made(float roughness, vec3 tint) {
    Material m = Material(Lobe[2](Lobe(0.25, tint), Lobe(0.75, vec3(1.0))), roughness);
    m.lobes[1].tint.y = roughness;
    m.lobes[0].weight += 0.5 * tint.z;
    return m;
}

Shaded material(float roughness, vec3 tint) {
    Material m = made(roughness, tint);
    Material copy = m;
    Shaded shaded = Shaded(vec3(0.0), 0.0);
    for (int i = 0; i < 2; i++) {
        shaded.color += m.lobes[i].weight * m.lobes[i].tint;
        m.lobes[0].weight = 0.125;
    }
    shaded.alpha = copy.lobes[0].weight + m.roughness;
    return shaded;
}
