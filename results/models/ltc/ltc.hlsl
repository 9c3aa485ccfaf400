// Area lights on GGX by linearly transformed cosines (Heitz et al. 2016), without tables: height-correlated
// masking, alpha = roughness^2, Schlick's Fresnel term. Positions of lights are relative to the shaded
// point; lights shine to both sides. Unit vectors `n` and `v`; perceptual roughness.
#include "entries.hlsl"

// A unit vector normal to `axis`.
float3 LtcAside(float3 axis)
{
    return normalize(cross(axis, abs(axis.z) < 0.9 ? float3(0, 0, 1) : float3(1, 0, 0)));
}

// An edge's arc times the cosine of its plane's normal to z (Lambert's formula).
float LtcArc(float3 a, float3 b)
{
    float3 across = cross(a, b);
    float sine = length(across);
    return sine > 0.0 ? across.z / sine * atan2(sine, dot(a, b)) : 0.0;
}

// An edge above the horizon, and where it crosses it, to `leaves` or from `enters`.
float LtcEdge(float3 a, float3 b, inout float3 leaves, inout float3 enters)
{
    if ((a.z > 0.0) != (b.z > 0.0)) {
        float3 at = a + a.z / (a.z - b.z) * (b - a);
        at.z = 0.0;
        if (a.z > 0.0) { leaves = at; b = at; } else { enters = at; a = at; }
    } else if (a.z <= 0.0) {
        return 0.0;
    }
    return LtcArc(a, b);
}

// What the matrix and the albedo of a view do to light of radiance 1 from everywhere.
struct LtcView
{
    float3x3 inverse;
    float albedo;
};

LtcView LtcOf(float3 n, float3 v, float roughness, float f0)
{
    float n_dot_v = clamp(dot(n, v), 0.001, 1.0);
    LtcEntries of = ltc_ggx(n_dot_v, roughness);
    float3 x = v - n * dot(n, v);
    // Seen along the normal, any frame does.
    x = dot(x, x) > 1e-12 ? normalize(x) : LtcAside(n);
    float3 y = cross(n, x);
    LtcView made;
    made.inverse = float3x3(of.m11 * x + of.m13 * n, y, of.m31 * x + of.m33 * n);
    made.albedo = f0 * (of.magnitude - of.fresnel) + of.fresnel;
    return made;
}

// A quadrilateral of radiance 1; corners in turn.
float LtcQuad(LtcView view, float3 corners[4])
{
    float3 leaves = 0.0, enters = 0.0;
    float form = 0.0;
    float3 from = mul(view.inverse, corners[3]);
    for (int i = 0; i < 4; ++i) {
        float3 to = mul(view.inverse, corners[i]);
        form += LtcEdge(from, to, leaves, enters);
        from = to;
    }
    form += LtcArc(leaves, enters);
    return view.albedo * abs(form) / 6.28318531;
}

// A sphere of radiance 1, as the polygon of its outline's area.
float LtcSphere(LtcView view, float3 centre, float radius)
{
    const int CORNERS = 24;
    const float CORNER = 6.28318531 / CORNERS;
    float away = length(centre);
    float3 axis = centre / away;
    float3 x = LtcAside(axis);
    float3 y = cross(axis, x);
    float sine = radius / away;
    float tangent = sine * rsqrt(1.0 - sine * sine) * sqrt(CORNER / sin(CORNER));
    float3 leaves = 0.0, enters = 0.0;
    float form = 0.0;
    float3 from = mul(view.inverse, axis + tangent * x);
    for (int i = 1; i <= CORNERS; ++i) {
        float angle = CORNER * i;
        float3 to = mul(view.inverse, axis + tangent * (cos(angle) * x + sin(angle) * y));
        form += LtcEdge(from, to, leaves, enters);
        from = to;
    }
    form += LtcArc(leaves, enters);
    return view.albedo * abs(form) / 6.28318531;
}
