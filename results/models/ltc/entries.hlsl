// The inverse matrix of linearly transformed cosines of GGX, [m11 0 m13; 0 1 0; m31 0 m33] in a frame with the
// normal as z and v in the plane of x and z, and the albedo: f0*(magnitude - fresnel) + fresnel.
struct LtcEntries {
    float m11, m13, m31, m33, magnitude, fresnel;
};

LtcEntries ltc_ggx(float n_dot_v, float roughness)
{
    LtcEntries of;
    float alpha = roughness*roughness + 1e-5;
    float aa = alpha*alpha;
    float cc = n_dot_v*n_dot_v;
    float ss = saturate(1.0 - cc);
    float s = sqrt(ss);
    float w = cc + 4.73*aa;
    float i = rsqrt(w);
    float u = n_dot_v*i;
    float t = u + saturate(alpha - 0.17);
    float f = u*saturate(1.3 - 1.03*t) + 1.54 - alpha*(alpha*(7.49 - 3.3*alpha) - 3.614);
    float g = u*saturate(0.776 - alpha) + abs(0.276*f - 0.275555);
    float row = alpha*(3.131 - 0.305*(u + (6.7 - 4.0*u)*t));
    float lean = (0.75 - 0.75*alpha)*s*row;
    of.m11 = ss*aa*f + cc;
    of.m13 = s*(w*i)*g;
    of.m31 = -lean*n_dot_v;
    of.m33 = row - lean*s;
    float least = n_dot_v*(u + alpha*(-3.99 - n_dot_v*(6.1*u - 4.1))) + 0.04 - u;
    of.magnitude = saturate(least*(0.4672 - 0.483*u) + (1.0066 - 0.0705*roughness));
    float b = roughness*(0.58*u - 0.85) + 0.972 - 1.2*n_dot_v;
    float d = saturate(b*abs(b) + 0.057);
    of.fresnel = saturate(d*(d + 0.47*roughness) - 0.0062);
    return of;
}
