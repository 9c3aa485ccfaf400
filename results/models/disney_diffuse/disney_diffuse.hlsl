// Disney's diffuse lobe under an environment of nine spherical-harmonic coefficients, as a rotated
// zonal-harmonic lobe. Needs the function of `parameters.hlsl`, which is included here.
#include "parameters.hlsl"

// The integral of a lobe, zonal harmonics `zh` of the bands 0 to 2 about `axis`, and of lighting.
// Order and signs of `sh` are those of D3DXSHEvalDirection: Y1 is -.4886 y, .4886 z, -.4886 x.
float3 SHZHProductIntegral(float3 axis, float3 zh, float3 sh[9])
{
    // sqrt(4 pi/(2 l + 1)) times the constants of each band.
    float3 c = zh * float3(1.0, 1.0, 0.5);
    float3 band1 = -axis.y * sh[1] + axis.z * sh[2] - axis.x * sh[3];
    float3 band2 = 3.4641016 * (axis.x * axis.y * sh[4] - axis.y * axis.z * sh[5] - axis.x * axis.z * sh[7])
                 + (3.0 * axis.z * axis.z - 1.0) * sh[6]
                 + 1.7320508 * (axis.x * axis.x - axis.y * axis.y) * sh[8];
    return c.x * sh[0] + c.y * band1 + c.z * band2;
}

// The light that a white surface reflects, 1/pi of the BRDF included: multiply by the base colour.
// `n` and `v` are unit vectors, `roughness` is perceptual.
float3 DisneyDiffuseSH(float3 n, float3 v, float roughness, float3 sh[9])
{
    float4 lobe = disney_zh(saturate(dot(n, v)), roughness);
    float3 axis = normalize(lerp(n, v, lobe.w));
    return SHZHProductIntegral(axis, lobe.xyz, sh);
}
