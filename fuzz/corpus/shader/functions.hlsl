0float f(float x, float y)
{
    const float t = exp2(-x)*atan2(y, x);
    return lerp(t, mad(x, y, 2.0), step(0.5, frac(x)));
}
