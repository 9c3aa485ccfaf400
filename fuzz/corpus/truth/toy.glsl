1#define N 3
uniform float gain; varying vec2 uv;
void mainImage(out vec4 c, in vec2 p) { for (int i = 0; i < N; i++) c += vec4(p, gain, uv.x) * float(i); }
