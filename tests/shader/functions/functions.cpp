// The functions of the shaders beside it, by hand: in double precision, with the constants of single.
// functions NAME INPUTS OUTPUTS: reads rows of NAME.in, and writes those of NAME.out.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <vector>

using std::fabs;
using std::floor;
typedef double D;
static const D PI = 3.14159265358979323846;

struct V2 { D x, y; };
struct V3 { D x, y, z; };
static V3 operator+(V3 a, V3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
static V3 operator-(V3 a, V3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
static V3 operator*(V3 a, D s) { return {a.x * s, a.y * s, a.z * s}; }
static D dot(V3 a, V3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static V3 cross(V3 a, V3 b) {
    return {a.y * b.z - b.y * a.z, a.z * b.x - b.z * a.x, a.x * b.y - b.x * a.y};
}
static D length(V3 a) { return std::sqrt(dot(a, a)); }
static V3 normalize(V3 a) { return a * (1 / length(a)); }
static D fract(D x) { return x - floor(x); }
static D mix(D a, D b, D t) { return a * (1 - t) + b * t; }
static D clamp(D x, D low, D high) { return std::min(std::max(x, low), high); }
static D smoothstep(D low, D high, D x) {
    D t = clamp((x - low) / (high - low), 0, 1);
    return t * t * (3 - 2 * t);
}
static D sign(D x) { return x > 0 ? 1 : x < 0 ? -1 : 0; }

// By Gaussian elimination, not by cofactors.
static D determinant(int n, std::vector<std::vector<D>> m) {
    D product = 1;
    for (int i = 0; i < n; ++i) {
        int pivot = i;
        for (int j = i; j < n; ++j)
            if (fabs(m[j][i]) > fabs(m[pivot][i])) pivot = j;
        if (pivot != i) {
            std::swap(m[pivot], m[i]);
            product = -product;
        }
        product *= m[i][i];
        for (int j = i + 1; j < n; ++j) {
            D f = m[j][i] / m[i][i];
            for (int k = i; k < n; ++k) m[j][k] -= f * m[i][k];
        }
    }
    return product;
}

// The columns' combination that makes the vector: the inverse times it.
static std::vector<D> solved(std::vector<std::vector<D>> columns, std::vector<D> v) {
    D whole = determinant(int(v.size()), columns);
    std::vector<D> result;
    for (size_t i = 0; i < v.size(); ++i) {
        auto replaced = columns;
        replaced[i] = v;
        result.push_back(determinant(int(v.size()), replaced) / whole);
    }
    return result;
}

static void series(const D *x, D *y) {
    D sum = 1, term = 1;
    for (int k = 1; k <= 12; ++k) {
        term *= x[0] / k;
        sum += term;
    }
    y[0] = sum;
}

static uint32_t scrambled(uint32_t n) {
    uint32_t state = n * 747796405u + 2891336453u;
    state = ((state >> ((state >> 28) + 4)) ^ state) * 277803737u;
    return (state >> 22) ^ state;
}
static D lattice_of_bits(int x, int y) {
    return (scrambled(uint32_t(x) + scrambled(uint32_t(y))) & 0xffff) / 65535.0;
}
static D octave_of_bits(D x, D y) {
    int i = int(floor(x)), j = int(floor(y));
    D u = fract(x), v = fract(y);
    u = u * u * (3 - 2 * u), v = v * v * (3 - 2 * v);
    return mix(mix(lattice_of_bits(i, j), lattice_of_bits(i + 1, j), u),
               mix(lattice_of_bits(i, j + 1), lattice_of_bits(i + 1, j + 1), u), v);
}
static void hashed_noise(const D *p, D *out) {
    D x = p[0], y = p[1], sum = 0, size = 0.5;
    for (int i = 0; i < 5; ++i) {
        sum += size * octave_of_bits(x, y);
        D turned = 1.6f * x - D(1.2f) * y;
        y = 1.2f * x + D(1.6f) * y, x = turned;
        size *= 0.5;
    }
    out[0] = sum;
}

static D lattice_of_fractions(D x, D y) {
    V3 p = {fract(x * 0.1031f), fract(y * 0.1031f), fract(x * 0.1031f)};
    D add = dot(p, {p.y + 33.33f, p.z + 33.33f, p.x + 33.33f});
    p = p + V3{add, add, add};
    return fract((p.x + p.y) * p.z);
}
static void fract_noise(const D *p, D *out) {
    D x = p[0], y = p[1], sum = 0, size = 0.5;
    for (int i = 0; i < 5; ++i) {
        D a = floor(x), b = floor(y);
        D u = smoothstep(0, 1, fract(x)), v = smoothstep(0, 1, fract(y));
        sum += size * mix(mix(lattice_of_fractions(a, b), lattice_of_fractions(a + 1, b), u),
                          mix(lattice_of_fractions(a, b + 1), lattice_of_fractions(a + 1, b + 1), u), v);
        x = x * 2 + 1.25, y = y * 2 + 0.5, size *= 0.5;
    }
    out[0] = sum;
}

static V3 reflect(V3 i, V3 n) { return i - n * (2 * dot(n, i)); }
static V3 refract(V3 i, V3 n, D eta) {
    D d = dot(n, i), k = 1 - eta * eta * (1 - d * d);
    if (k < 0) return {0, 0, 0};
    return i * eta - n * (eta * d + std::sqrt(k));
}
static void bounce(const D *x, D *y) {
    V3 incident = normalize({x[0], x[1], x[2]}), n = {x[3], x[4], x[5]};
    V3 normal = dot(n, incident) < 0 ? normalize(n) : normalize(n) * -1;
    V3 mirrored = reflect(incident, normal), bent = refract(incident, normal, 1.25);
    V3 side = cross(mirrored, bent);
    y[0] = dot(mirrored, bent), y[1] = length(side), y[2] = length(mirrored - bent);
    y[3] = side.x + bent.z;
}

static D early_of(D x, D y) {
    if (x < 0.25) return y > 0.5 ? x * y : std::sqrt(x + y);
    if (x + y > 1.5) return 2 - y;
    D sum = y < 0.75 ? x + y * y : x - y;
    return x < y ? -sum : sum;
}
static void early(const D *x, D *y) { y[0] = early_of(x[0], x[1]); }

static void lobes(const D *x, D *y) {
    D alpha = x[1] * x[1];
    y[0] = x[0] * (1 - alpha), y[1] = alpha * x[0], y[2] = 1 / (x[0] + alpha);
}

// Columns of a product of matrices that are columns.
struct M3 { V3 a, b, c; };
static V3 operator*(M3 m, V3 v) { return m.a * v.x + m.b * v.y + m.c * v.z; }
static M3 operator*(M3 m, M3 n) { return {m * n.a, m * n.b, m * n.c}; }
static std::vector<D> of(V3 v) { return {v.x, v.y, v.z}; }
static void matrices(const D *x, D *y) {
    D c = std::cos(x[3]), s = std::sin(x[3]);
    M3 tint = {{0.5, 0.25, 0.125}, {0.75, 1.5, 0}, {0.25, 0.5, 2}};
    M3 m = M3{{c, s, 0}, {-s, c, 0}, {0, 0, 1}} * tint;
    V3 v = {x[0], x[1], x[2]}, along = m * v;
    V3 against = {dot(v, m.a), dot(v, m.b), dot(v, m.c)};
    y[0] = dot(along, against);
    y[1] = determinant(3, {of(m.a - tint.a * 0.5), of(m.b - tint.b * 0.5), of(m.c - tint.c * 0.5)});
    y[2] = dot(v, v) * dot(along, along) - dot(v, along) * dot(v, along);
    std::vector<D> first = {along.x, along.y, along.z, 1};
    std::vector<D> third = {0 - along.x, 2 - along.y, 4 - along.z, 2 * v.x - 1};
    y[3] = determinant(4, {first, {v.x, v.y, v.z + 0.25, 0.5}, third, {1, 1, 1, 1}});
}

static void inverses(const D *x, D *y) {
    D a = x[0], b = x[1], s = x[2];
    y[0] = solved({{1 + s, a}, {b, 3}}, {a, b})[0];
    std::vector<std::vector<D>> m = {{2, a, s}, {b, 3, 0.25}, {s, 0.5, 4 + a}};
    D second = solved(m, {a, b, 1})[1];
    // The last component of the outer product, and twice that of the inverse.
    y[1] = second + s * b + 2 * solved(m, {0, 0, 1})[2];
    y[2] = solved({{3, a, 0, s}, {b, 4, 0.5, 0}, {s, a, 5, b}, {0.25, s, 1, 6}}, {a, b, s, 1})[3];
}

static void material(const D *x, D *y) {
    D roughness = x[0];
    V3 tint = {x[1], x[2], x[3]};
    D first = 0.25 + 0.5 * tint.z;
    V3 color = tint * first + V3{1, roughness, 1} * 0.75;
    y[0] = color.x, y[1] = color.y, y[2] = color.z, y[3] = first + roughness;
}

static void cases(const D *x, D *y) {
    D sum = 0;
    sum += x[0], sum += 0.125;
    if (!(x[0] < x[1])) sum += 2 * x[1];
    sum += 0.125;
    sum *= 1.25, sum += 0.125;
    sum += x[0], sum += 0.125;
    sum *= 1.25, sum += 0.125;
    y[0] = sum;
}

static void chosen(const D *x, D *y) {
    D which = floor(x[0]);
    y[0] = which == -1 ? x[1] : which == 0 ? x[1] * x[1] : which == 2 ? x[0] * x[1] : 1 - x[1];
}

static void loops(const D *x, D *y) {
    D a = x[0], b = x[0], c = 0;
    for (int i = 1; i <= 8; ++i) {
        if (i % 3 == 0) continue;
        if (a > 4) break;
        a = a * 1.5 + 0.25;
    }
    for (int n = 5; n > 0; --n) b += 1 / (b + n);
    for (int j : {3, 2, 1, 0})
        for (int k = j; k > 0; --k)
            if (k != 2) c += x[0] * (j * 4 + k);
    y[0] = a, y[1] = b, y[2] = c;
}

static void table(const D *p, D *y) {
    const float at[4][2] = {{-0.94f, -0.4f}, {0.945f, -0.77f}, {-0.095f, -0.93f}, {0.345f, 0.29f}};
    const float weights[4] = {0.1f, 0.2f, 0.3f, 0.4f};
    D sum = 0;
    for (int i = 0; i < 4; ++i) {
        D a = p[0] - at[i][0], b = p[1] - at[i][1];
        sum += weights[3 - i] * std::exp(-(a * a + b * b));
    }
    y[0] = sum + p[0] * p[0] * p[0] * p[0] - p[0];
}

static void looked_up(const D *x, D *y) {
    const float curve[6] = {0, 0.3f, 0.5f, 0.6f, 0.65f, 0.675f};
    D at = clamp(x[0], 0, 1) * 4;
    int i = int(at);
    y[0] = mix(curve[i], curve[i + 1], at - i);
}

static void bits(const D *x, D *y) {
    int32_t whole = int32_t(x[0]);
    uint32_t u = uint32_t(whole + 1000) * 0x9E3779B9u;
    u ^= u >> 16;
    u = (u << 5) | (u >> 27);
    int counted = __builtin_popcount(u) + __builtin_clz(u | 1) + __builtin_ctz(u | 256);
    uint32_t reversed = 0;
    for (int i = 0; i < 32; ++i) reversed |= ((u >> i) & 1) << (31 - i);
    int field = int(((u >> 4) & 511) + (reversed & 7));
    int mixed = (whole >> 1) ^ (~whole & 12);
    int placed = int(((uint32_t(mixed) & ~28u) | (5u << 2)) & 0xfff);
    int rest = whole % 7 + whole / 7 * 3 + std::min(whole, -2) * std::max(std::abs(whole), 4);
    y[0] = counted + field, y[1] = mixed + placed, y[2] = rest;
}

static D fourth(D x) { return x * x * (x * x); }
static void nested(const D *x, D *y) {
    D low = x[0], high = fourth(x[1]);
    bool swapped = low > high;
    if (swapped) std::swap(low, high);
    D third = x[0] * x[0] - x[1];
    if (low > third) std::swap(low, third);
    y[0] = low + 2 * high - third, y[1] = swapped ? low * low : fourth(third);
}

static void builtins(const D *in, D *out) {
    D x = in[0], y = in[1];
    D values[20] = {
        floor(x), std::ceil(x), std::trunc(x), std::nearbyint(x),
        x - std::trunc(x), std::trunc(x), fract(x), std::fmod(x, 0.75),
        std::exp2(x) + std::exp(y), std::log2(y) * std::log(y + 1), std::pow(y, x),
        1 / std::sqrt(y) + std::sqrt(y),
        std::sin(x) * std::cos(y) + std::tan(y * 0.5),
        std::atan2(x, y) + std::asin(x * 0.25) + std::acos(y * 0.25) + std::atan(x),
        x * (PI / 180) + y * (180 / PI) * 0.01f,
        std::sinh(x) + std::cosh(y) + std::tanh(x) + std::asinh(x) + std::acosh(y + 1)
            + std::atanh(x * 0.25),
        smoothstep(-1, 2, x) + (x < y ? 0 : 1) + sign(x),
        mix(x, y, 0.3f) + clamp(x, -0.5, 0.5) + clamp(y, 0, 1),
        std::min(x, y) * std::max(x, y) - fabs(x),
        x * y + 0.5 + x * 8 + std::sqrt(x * x + y * y),
    };
    std::copy(values, values + 20, out);
}

static void taken_apart(const D *x, D *y) {
    int exponent;
    y[0] = std::frexp(x[0], &exponent), y[1] = exponent;
    D first, second;
    std::modf(x[0], &first);
    y[2] = std::modf(-x[1], &second) * first, y[3] = second;
}

static D modulo_of(D x, D y) { return x - y * floor(x / y); }
static void modulo(const D *x, D *y) {
    y[0] = modulo_of(x[0], 0.3f), y[1] = modulo_of(x[0], -0.3f);
    for (int i = 1; i <= 2; ++i) y[1 + i] = modulo_of(x[i], 0.75) + modulo_of(x[0], x[i] + 3);
}

static void state(const D *x, D *y) {
    int calls = 2;
    V2 seed = {0.5 + x[0], 0.25};
    auto next = [&] {
        ++calls;
        seed = {seed.y, fract(seed.x * 1.5 + 0.125 * calls)};
        return seed.x;
    };
    D sum = 0;
    for (int i = 0; i < 4; ++i) sum += next();
    if (x[0] > 0.5) sum -= next();
    y[0] = sum, y[1] = seed.y + seed.x;
}

static void truths(const D *v, D *y) {
    const D *w = v + 3;
    bool below[3] = {v[0] < w[0], v[1] < w[1], v[2] < w[2]};
    D chosen[3];
    for (int i = 0; i < 3; ++i) chosen[i] = below[i] ? w[i] : v[i];
    bool all = v[0] <= w[0] && v[1] <= w[1] && v[2] <= w[2];
    bool some = (below[0] || below[1] || below[2]) && !all;
    D sum = 0;
    if (some) sum += 1;
    if ((v[0] > 0.5) != (w[0] > 0.5) || (below[1] && v[2] >= w[2])) sum += chosen[0];
    if ((below[0] && below[1]) || below[2]) sum -= w[1];
    y[0] = sum, y[1] = chosen[1] + some, y[2] = chosen[2] * below[0];
}

static void components(const D *v, D *y) {
    D a[4] = {v[3], v[2], v[1], v[0]};
    for (int i = 0; i < 3; ++i) a[i + 1] += a[i] * 0.5;
    D b[4] = {a[1], a[0], (v[1] + a[2]) * 3, v[0] + a[2]};
    y[0] = b[0] + b[0], y[1] = v[3] + b[0];
    // The second column was taken before the first was written.
    y[2] = b[1] + b[1], y[3] = b[0] + b[1];
}

static const struct { const char *name; void (*function)(const D *, D *); } FUNCTIONS[] = {
    {"series", series}, {"hashed_noise", hashed_noise}, {"fract_noise", fract_noise},
    {"bounce", bounce}, {"early", early}, {"lobes", lobes}, {"matrices", matrices},
    {"inverses", inverses}, {"material", material}, {"cases", cases}, {"chosen", chosen},
    {"loops", loops}, {"table", table}, {"looked_up", looked_up}, {"bits", bits},
    {"nested", nested}, {"builtins", builtins}, {"taken_apart", taken_apart}, {"modulo", modulo},
    {"state", state}, {"truths", truths}, {"components", components},
};

static bool written(void (*function)(const D *, D *), const char *name, size_t inputs, size_t outputs) {
    char path[256];
    snprintf(path, sizeof path, "%s.in", name);
    FILE *in = fopen(path, "rb");
    snprintf(path, sizeof path, "%s.out", name);
    FILE *out = fopen(path, "wb");
    if (!in || !out) return false;
    std::vector<D> x(inputs), y(outputs);
    while (fread(x.data(), sizeof(D), inputs, in) == inputs) {
        function(x.data(), y.data());
        fwrite(y.data(), sizeof(D), outputs, out);
    }
    fclose(in);
    return fclose(out) == 0;
}

int main(int count, char **arguments) {
    for (int i = 1; i + 2 < count; i += 3)
        for (auto &known : FUNCTIONS)
            if (!strcmp(known.name, arguments[i])
                && !written(known.function, known.name, size_t(atoi(arguments[i + 1])),
                            size_t(atoi(arguments[i + 2]))))
                return 1;
    return 0;
}
