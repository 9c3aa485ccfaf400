// The exponential function by its power series.
float series(float x) {
    float sum = 1.0, term = 1.0;
    for (int k = 1; k <= 12; k++) {
        term *= x / float(k);
        sum += term;
    }
    return sum;
}
