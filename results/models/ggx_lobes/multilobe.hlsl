// Reflections of an environment in a GGX surface as eight lookups, spherical Gaussians side by side
// in the plane of normal and view (Pesce and Iwanicki, "Approximate Models for Physically Based
// Rendering", SIGGRAPH 2015 course notes, §7.6), with formulas in place of their tables.
//
// alpha = roughness^2, height-correlated Smith, F = 1: multiply by the Fresnel term of your choice.
// roughness from .03, below which a surface is a mirror.

static const float TAU = 6.2831853;
static const int LOBES = 8;

// The environment in a direction, convolved with exp(-lambda (1 - dot)), normalised: a lookup of a
// prefiltered cubemap at the level that has this lambda. Define it, or ENVIRONMENT_DEFINED and your
// own before.
#ifndef ENVIRONMENT_DEFINED
TextureCube environmentMap;
SamplerState environmentSampler;
// lambda = 2^(FINEST - 2 level): a texel half as fine at each level has a lobe twice as wide.
static const float FINEST = 14.0;
float3 SampleEnvironment(float3 direction, float lambda)
{
    float level = max(0.5 * (FINEST - log2(lambda)), 0.0);
    return environmentMap.SampleLevel(environmentSampler, direction, level).rgb;
}
#endif

struct LobeParameters
{
    float cosTheta; // of the middle of the lobes, from the normal
    float spread;   // from the middle to the first lobe, in radians
    float lambda;   // bandwidth of each lobe
    float height;   // amplitude of the middle over lambda
};

LobeParameters GetLobeParameters(float nDotV, float roughness)
{
    float alpha = roughness * roughness;
    float middle = (alpha - 1.0) * (0.5 * nDotV + 1.304) + 1.303;
    float width = 3.04 - 2.6 * max(max(roughness, 0.6), abs(0.82 - 1.95 * nDotV));
    float bent = (roughness - 1.15 * nDotV) * saturate(roughness + 0.32 * nDotV);
    float nearness = nDotV + bent;
    float bandwidth = nDotV + (16.3 * nearness - 14.2) * (nearness - 0.667 * saturate(bent + 0.79));
    float bow = nDotV * (roughness + nDotV * (1.9 - 2.0 * nDotV)) - 0.54
        + 0.71 * saturate(8.0 * roughness - 6.7);
    float height = bow * (1.266 - 2.37 * saturate(3.6 * roughness - 1.97)) - 5.69;
    LobeParameters lobes;
    lobes.cosTheta = lerp(nDotV, 1.0, saturate(middle));
    lobes.spread = alpha * width;
    lobes.lambda = exp2(bandwidth) / (alpha * alpha);
    lobes.height = exp2(height);
    return lobes;
}

// The environment as the eight lobes weigh it; shares sum up their weights, and integral is that of all
// lobes of unit environments, for one unit of shares.
float3 GatherLobes(float3 n, float3 v, float roughness, out float shares, out float integral)
{
    float nDotV = saturate(dot(n, v));
    // Across the normal from the view. Where v is n, the lobes are about n: any tangent will do.
    float3 across = nDotV * n - v;
    across *= rsqrt(max(dot(across, across), 1e-12));

    LobeParameters lobes = GetLobeParameters(nDotV, max(roughness, 0.03));
    // No further than the middle is from the normal, or radial marks show.
    float theta = acos(min(lobes.cosTheta, 1.0));
    float spread = min(lobes.spread, theta);

    // From the lobe furthest from the normal, each a step nearer: a rotation.
    float sine, cosine, stepSine, stepCosine;
    sincos(theta + spread, sine, cosine);
    sincos(2.0 * spread / (LOBES - 1), stepSine, stepCosine);
    // The integral of a Gaussian of amplitude height * lambda.
    integral = TAU * lobes.height * (1.0 - exp(-2.0 * lobes.lambda));

    float3 sum = 0.0;
    shares = 0.0;
    for (int lobe = 0; lobe < LOBES; ++lobe)
    {
        float place = 2.0 * lobe / (LOBES - 1) - 1.0;
        float offset = (lobe + 1 - 0.5 * (LOBES + 1)) * place;
        float share = exp(-spread / 3.0 * offset * offset);
        sum += share * SampleEnvironment(cosine * n + sine * across, lobes.lambda);
        shares += share;
        float next = sine * stepCosine - cosine * stepSine;
        cosine = cosine * stepCosine + sine * stepSine;
        sine = next;
    }
    return sum;
}

// What is reflected with F = 1, the amplitude of least error: Gaussians have no tails, so the light of
// those is missing.
float3 SpecularBrdfApprox(float3 worldPosition, float3 worldNormal, float3 cameraPosition,
                          float roughness)
{
    float shares, integral;
    float3 v = normalize(cameraPosition - worldPosition);
    float3 sum = GatherLobes(normalize(worldNormal), v, roughness, shares, integral);
    return integral * sum;
}

// The mean of the environment, to be multiplied by the directional albedo, f0 * scale + bias: no light
// is lost. In place of the one lookup of a prefiltered environment.
float3 ReflectedEnvironment(float3 n, float3 v, float roughness)
{
    float shares, integral;
    float3 sum = GatherLobes(n, v, roughness, shares, integral);
    return sum / shares;
}

#ifdef COMPILED_ALONE
float4 main(float3 position : POSITION, float3 normal : NORMAL) : SV_Target
{
    return float4(SpecularBrdfApprox(position, normal, float3(0.0, 0.0, 5.0), 0.4), 1.0);
}
#endif
