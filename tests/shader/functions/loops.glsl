// Every kind of loop.
vec3 loops(float x) {
    float a = x, b = x, c = 0.0;
    int i = 0;
    while (i < 8) {
        i++;
        if (i % 3 == 0) continue;
        if (a > 4.0) break;
        a = a * 1.5 + 0.25;
    }
    uint n = 5u;
    do {
        b += 1.0 / (b + float(n));
    } while (--n != 0u);
    for (int j = 3; ; j--) {
        if (j < 0) break;
        for (int k = j; k > 0; k -= 1) {
            if (k == 2) continue;
            c += x * float(j * 4 + k);
        }
    }
    return vec3(a, b, c);
}
