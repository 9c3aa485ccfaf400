2// a comment
float f(float x) {
    float t = pow(max(x, 0.0), 2.5);
    return (x < 0.5) ? t : inversesqrt(t + 1.0);
}
