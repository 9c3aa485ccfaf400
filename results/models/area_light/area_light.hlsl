// The specular highlight of a spherical light on GGX, height-correlated masking, F = 1. Needs the
// function of `lobe.hlsl`, which is included here.
#include "lobe.hlsl"

// What a light of unit irradiance reflects towards `v`: multiply by the irradiance that the light has on
// a surface facing it, radiance times pi radius_over_distance^2, and by the Fresnel term of your choice.
// Unit vectors; `l` towards the light's centre; perceptual roughness. Fitted for radius_over_distance from
// .01 to .48, roughness from .1, n.v from .1 and n.l from .05: inputs are clamped to these.
float SphereLightGGX(float3 n, float3 v, float3 l, float radius_over_distance, float roughness)
{
    float n_dot_v = clamp(dot(n, v), 0.1, 1.0);
    float n_dot_l = clamp(dot(n, l), 0.05, 1.0);
    float r_dot_l = saturate(2.0 * dot(n, v) * dot(n, l) - dot(v, l));
    float size = clamp(radius_over_distance, 0.01, 0.48);
    roughness = max(roughness, 0.1);
    float alpha = roughness * roughness;
    float lobe = sphere_light_lobe(size, roughness, n_dot_v, n_dot_l, r_dot_l);
    // The light sets below n.l = .05; a half of it is below the horizon at 0.
    float above = saturate(dot(n, l) / 0.05);
    return above * lobe / (3.14159265 * (4.0 * alpha * alpha + size * size) * n_dot_v);
}
