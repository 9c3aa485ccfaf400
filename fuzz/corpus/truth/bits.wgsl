0// Bits of integers.
fn bits(x: f32) -> vec3<f32> {
    let whole = i32(x);
    var u = u32(whole + 1000) * 0x9E3779B9u;
    u ^= u >> 16u;
    u = (u << 5u) | (u >> 27u);
    let counted = countOneBits(u) + countLeadingZeros(u | 1u) + countTrailingZeros(u | 256u);
    let field = extractBits(u, 4u, 9u) + extractBits(reverseBits(u), 0u, 3u);
    let signed = (whole >> 1u) ^ (~whole & 12);
    let placed = insertBits(u32(signed), 5u, 2u, 3u) & 0xfffu;
    let rest = whole % 7 + whole / 7 * 3 + min(whole, -2) * max(abs(whole), 4);
    return vec3<f32>(f32(counted + field), f32(signed + i32(placed)), f32(rest));
}
