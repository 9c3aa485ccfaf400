// Truth values.
vec3 truths(vec3 v, vec3 w) {
    bvec3 below = lessThan(v, w);
    vec3 chosen = mix(v, w, below);
    bool some = any(below) && !all(lessThanEqual(v, w));
    bool exactly = ((v.x > 0.5) ^^ (w.x > 0.5)) || (below.y && v.z >= w.z);
    float sum = 0.0;
    if (some) sum += 1.0;
    if (exactly) sum += chosen.x;
    if (below.x && below.y || below.z) sum -= w.y;
    return vec3(sum, chosen.y + float(some), chosen.z * float(below.x));
}
