// Spheres in WebGL, of the emitted GLSL itself: truth, formula, and their difference.

const lights = { environment: 0, roughness: 0.4, f0: 0.04, omega: 0.4, exposure: 0 };
if (data.spheres) Object.assign(lights, data.spheres.view, { environment: data.spheres.environment });

const spheres = (() => {
  if (!data.spheres) return null;
  const canvas = html("canvas", { id: "spheres-canvas", role: "img", "aria-label": "three spheres: truth, formula, difference" });
  const gl = canvas.getContext("webgl2", { preserveDrawingBuffer: true });
  if (!gl) return null;
  const { table, environments } = data.spheres;
  const points = table.grid.reduce((a, b) => a * b, 1);
  const WIDTH = 1024;
  const texture = gl.createTexture();
  const texels = new Float32Array(WIDTH * Math.ceil((points * table.values.length) / WIDTH));
  table.values.forEach((values, o) => texels.set(values, o * points));
  gl.bindTexture(gl.TEXTURE_2D, texture);
  gl.texImage2D(gl.TEXTURE_2D, 0, gl.R32F, WIDTH, texels.length / WIDTH, 0, gl.RED, gl.FLOAT, texels);
  for (const parameter of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, parameter, gl.NEAREST);
  gl.bindVertexArray(gl.createVertexArray());
  let program = null, source = "";

  const nameIn = (code) => /^(float|vec[234]) (\w+)\(/m.exec(code)?.[2];
  const parts = (value, count) => (count === 1 ? [value] : ["x", "y", "z", "w"].slice(0, count).map((part) => `${value}.${part}`));
  function fragment() {
    const glsl = formula().code[data.languages.indexOf("glsl")].body;
    const { given, light } = environments[lights.environment];
    const inputs = data.inputs.length, outputs = data.outputs.length;
    const type = (count) => (count === 1 ? "float" : `vec${count}`);
    const pixel = "n.x, n.y, n.z, lgp_turned.x, lgp_turned.y, lgp_turned.z, lgp_turned.w";
    const cells = table.axes.map(([a, b, c, d], i) => `lgp_cell(${parts("g", inputs)[i]}, vec4(${[a, b, c, d].map(literal).join(", ")}), ${table.grid[i]})`);
    return `#version 300 es
precision highp float;
precision highp sampler2D;
uniform float lgp_size;
uniform vec4 lgp_turned;
uniform sampler2D lgp_table;
out vec4 lgp_colour;
${given}
${glsl}
${light}
vec2 lgp_cell(float place, vec4 axis, int points) {
    if (place < axis.y) { return vec2(0.0, clamp((place - axis.x)/(axis.y - axis.x), 0.0, 1.0)); }
    float along = (min(place, axis.w) - axis.y)/(axis.z - axis.y);
    float low = min(floor(along), float(points - 3));
    return vec2(low + 1.0, clamp(along - low, 0.0, 1.0));
}
float lgp_read(int o, vec2 cells[${inputs}]) {
    int grid[${inputs}] = int[${inputs}](${table.grid.join(", ")});
    float sum = 0.0;
    for (int corner = 0; corner < ${1 << inputs}; ++corner) {
        int index = 0;
        float weight = 1.0;
        for (int axis = 0; axis < ${inputs}; ++axis) {
            int upper = (corner >> axis) & 1;
            weight *= upper == 1 ? cells[axis].y : 1.0 - cells[axis].y;
            index = index*grid[axis] + int(cells[axis].x) + upper;
        }
        int at = o*${points} + index;
        sum += weight*texelFetch(lgp_table, ivec2(at % ${WIDTH}, at / ${WIDTH}), 0).r;
    }
    return sum;
}
void main() {
    vec2 p = (2.0*vec2(mod(gl_FragCoord.x, lgp_size), gl_FragCoord.y)/lgp_size - 1.0)/${literal(data.spheres.radius)};
    float beyond = max(length(p), 1.0);
    vec2 q = p/beyond;
    vec3 n = vec3(q, sqrt(max(1.0 - dot(q, q), 0.0)));
    ${type(inputs)} g = ${nameIn(given)}(${pixel});
    vec2 cells[${inputs}] = vec2[${inputs}](${cells.join(", ")});
    ${type(outputs)} made = ${nameIn(glsl)}(${parts("g", inputs).join(", ")});
    vec3 truth = ${nameIn(light)}(${[pixel, ...data.outputs.map((_, o) => `lgp_read(${o}, cells)`)].join(", ")});
    vec3 shown = ${nameIn(light)}(${[pixel, ...parts("made", outputs)].join(", ")});
    int which = int(gl_FragCoord.x/lgp_size);
    vec3 c = which == 0 ? truth : which == 1 ? shown : ${literal(data.spheres.difference_times)}*abs(shown - truth);
    float coverage = clamp((1.0 - length(p))*${literal(data.spheres.radius)}*lgp_size/2.0 + 0.5, 0.0, 1.0);
    lgp_colour = vec4(clamp(c, 0.0, 1.0)*coverage, coverage);
}
`;
  }
  const literal = (value) => (Number.isInteger(value) ? value.toFixed(1) : String(Math.fround(value)));

  function compiled(fragmentSource) {
    const made = gl.createProgram();
    const vertex = "#version 300 es\nvoid main() { gl_Position = vec4(float(gl_VertexID & 1)*4.0 - 1.0, float(gl_VertexID >> 1)*4.0 - 1.0, 0.0, 1.0); }";
    for (const [kind, text] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragmentSource]]) {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, text);
      gl.compileShader(shader);
      if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS)) throw new Error(gl.getShaderInfoLog(shader));
      gl.attachShader(made, shader);
    }
    gl.linkProgram(made);
    if (!gl.getProgramParameter(made, gl.LINK_STATUS)) throw new Error(gl.getProgramInfoLog(made));
    return made;
  }

  function draw(size) {
    if (fragment() !== source) {
      if (program) gl.deleteProgram(program);
      source = fragment();
      program = compiled(source);
    }
    Object.assign(canvas, { width: 3 * size, height: size });
    gl.viewport(0, 0, 3 * size, size);
    gl.useProgram(program);
    gl.uniform1f(gl.getUniformLocation(program, "lgp_size"), size);
    gl.uniform4f(gl.getUniformLocation(program, "lgp_turned"), lights.roughness, lights.f0, lights.omega, lights.exposure);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
  }

  /** Rows from the top; red, green, blue, alpha of each pixel. */
  function pixels(size) {
    draw(size);
    const bytes = new Uint8Array(4 * 3 * size * size);
    gl.readPixels(0, 0, 3 * size, size, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
    return Array.from({ length: size }, (_, row) => Array.from(bytes.subarray(12 * size * (size - 1 - row), 12 * size * (size - row))));
  }
  return { canvas, draw, pixels };
})();

/** Draws them, or hides their section where the shader does not compile or the context is lost. */
function drawOrHide(size) {
  try {
    spheres.draw(size);
  } catch (error) {
    console.warn(error);
    byId("spheres").hidden = true;
  }
}

function drawSpheres() {
  const box = byId("spheres");
  box.hidden = !spheres || !formula() || data.outputs.length > 4;
  if (box.hidden) return;
  const size = () => Math.round(Math.min(420, (box.clientWidth - 36) / 3) * Math.min(2, devicePixelRatio));
  if (!box.firstChild) {
    const slider = (label, key, from, to, step) => {
      const shown = html("output", {}, short(lights[key]));
      const input = html("input", { type: "range", min: from, max: to, step, value: lights[key], "data-light": key, input: () => { lights[key] = +input.value; shown.textContent = short(lights[key]); drawOrHide(size()); } });
      return html("label", {}, label, input, shown);
    };
    const has = (name) => data.inputs.some((input) => input.name === name);
    const environments = data.spheres.environments;
    box.append(html("h2", {}, "Spheres"), html("div", { class: "row" }, ...[
      environments.length > 1 ? choice("environment", environments.map(({ name }) => name), lights.environment, (i) => { lights.environment = i; drawOrHide(size()); }) : null,
      slider("roughness", "roughness", 0.02, 1, 0.01),
      data.spheres.uses_f0 ? slider("F0", "f0", 0.02, 1, 0.01) : null,
      has("omega") ? slider("light's angle (rad)", "omega", 0.02, 1, 0.01) : null,
      slider("exposure (stops)", "exposure", -4, 6, 0.1),
    ].filter(Boolean)), html("div", { class: "spheres" }, spheres.canvas), html("div", { class: "sphere-names" }, html("span", {}, "truth"), html("span", {}, "formula"), html("span", {}, `|difference| × ${data.spheres.difference_times}`)));
  }
  drawOrHide(size());
}

/** Returns the three spheres' pixels, for comparison with `lgp render`. */
window.lgpSpheres = (settings, size) => {
  Object.assign(lights, settings);
  return spheres ? spheres.pixels(size) : null;
};
