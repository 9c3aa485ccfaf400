1// A choice by a number that depends on an input, with a fall-through.
float chosen(float x, float y) {
    float result = x * y;
    switch (int(floor(x))) {
        case 0: y *= y;
        case -1: result = y; break;
        case 2: break;
        default: return 1.0 - y;
    }
    return result;
}
