// The roughness with which to read a prefiltered cube map whose lookup is corrected for parallax: that
// of the lobe from the probe that draws on the proxy's plane what the surface's lobe draws.
#include "distance.hlsl"
#include "tilt.hlsl"
#include "untilt.hlsl"

// Perceptual `roughness` of the surface. Distances from the proxy's plane, of the shaded point and of
// the probe; cosines between the plane's normal and the directions to where the reflected ray hits it.
// Proxies must have smooth normals: the cosine of the surface jumps where they do.
float ParallaxRoughness(float roughness, float surface_distance, float surface_cosine,
                        float probe_distance, float probe_cosine)
{
    float distance = clamp(surface_distance / probe_distance, 0.25, 4.0);
    float perpendicular = lobe_plane_fitted_roughness(
        tilt_fitted_roughness(roughness, max(surface_cosine, 0.5)), distance);
    return untilt_roughness(perpendicular, max(probe_cosine, 0.5));
}
