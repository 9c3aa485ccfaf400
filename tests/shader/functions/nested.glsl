// Calls of calls, of which some write to what they are given.
float fourth(float x);
float square(float x) { return x * x; }
vec2 square(vec2 x) { return x * x; }

bool order(inout float a, inout float b) {
    if (a <= b) return false;
    float t = a;
    a = b;
    b = t;
    return true;
}

float fourth(float x) { return square(vec2(square(x), 0.0)).x; }

vec2 nested(float x, float y) {
    float low = x, high = fourth(y);
    bool swapped = order(low, high);
    float third = square(x) - y;
    order(low, third);
    return vec2(low + 2.0 * high - third, swapped ? square(low) : fourth(third));
}
