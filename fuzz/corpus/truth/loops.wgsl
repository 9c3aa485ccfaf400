0// Every kind of loop.
fn loops(x: f32) -> vec3<f32> {
    var a = x;
    var i = 0;
    while (i < 8) {
        i++;
        if (i % 3 == 0) { continue; }
        if (a > 4.0) { break; }
        a = a * 1.5 + 0.25;
    }
    var b = x;
    var n = 5u;
    loop {
        b += 1.0 / (b + f32(n));
        continuing {
            n -= 1u;
            break if n == 0u;
        }
    }
    var c = 0.0;
    for (var j = 3; ; j--) {
        if (j < 0) { break; }
        for (var k = j; k > 0; k -= 1) {
            if (k == 2) { continue; }
            c += x * f32(j * 4 + k);
        }
    }
    return vec3<f32>(a, b, c);
}
