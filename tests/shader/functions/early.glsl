// Several ways out.
float early(float x, float y) {
    if (x < 0.25) {
        if (y > 0.5) return x * y;
        return sqrt(x + y);
    } else if (x + y > 1.5)
        return 2.0 - y;
    float sum = x;
    if (y < 0.75) {
        sum += y * y;
    } else {
        sum -= y;
    }
    return x < y ? -sum : sum;
}
