// Bits of integers.
vec3 bits(float x) {
    int whole = int(x);
    uint u = uint(whole + 1000) * 0x9E3779B9u;
    u ^= u >> 16;
    u = (u << 5) | (u >> 27);
    int counted = bitCount(int(u)) + (31 - findMSB(int(u >> 1) | 1)) - 1 + findLSB(int(u | 256u));
    uint field = bitfieldExtract(u, 4, 9) + bitfieldExtract(bitfieldReverse(u), 0, 3);
    int signed_ = (whole >> 1) ^ (~whole & 12);
    uint placed = bitfieldInsert(uint(signed_), 5u, 2, 3) & 0xfffu;
    int rest = whole % 7 + whole / 7 * 3 + min(whole, -2) * max(abs(whole), 4);
    return vec3(float(counted + int(field)), float(signed_ + int(placed)), float(rest));
}
