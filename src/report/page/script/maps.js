// Truth, formula and difference over the domain, as figure 22 of Pesce and Iwanicki has them.

/** Viridis (van der Walt and Smith, 2015), at ninths. */
const VIRIDIS = ["#440154", "#482878", "#3e4989", "#31688e", "#26828e", "#1f9e89", "#35b779", "#6ece58", "#b5de2b", "#fde725"].map(rgb);
function rgb(hex) { return [1, 3, 5].map((i) => parseInt(hex.slice(i, i + 2), 16)); }
function along(stops, place) {
  const at = Math.min(1, Math.max(0, place)) * (stops.length - 1);
  const low = Math.min(Math.floor(at), stops.length - 2);
  return stops[low].map((v, k) => v + (stops[low + 1][k] - v) * (at - low));
}
const sequential = (place) => along(VIRIDIS, place);
/** Blue where the formula is too low, orange where it is too high; `place` from 0 to 1. */
function diverging(place) {
  const dark = matchMedia("(prefers-color-scheme: dark)").matches;
  const ends = dark ? ["#9ecbff", "#2f81c7", "#22272e", "#d9822b", "#ffd08a"] : ["#08306b", "#4393c3", "#f7f7f7", "#e08214", "#7f3b08"];
  return along(ends.map(rgb), place);
}
const DIFFERENCE_TIMES = 3;

function paint(canvas, width, height, pixel) {
  Object.assign(canvas, { width, height });
  const context = canvas.getContext("2d");
  const image = context.createImageData(width, height);
  for (let row = 0; row < height; row++) {
    for (let column = 0; column < width; column++) {
      const colour = pixel(column, height - 1 - row);
      if (colour) image.data.set([...colour, 255], 4 * (row * width + column));
    }
  }
  context.putImageData(image, 0, 0);
}

function drawMaps() {
  const box = byId("maps");
  if (!samples) { box.replaceChildren(html("h2", {}, "Error over the domain"), html("p", { class: "note" }, "The dataset is no longer where the run found it, or has changed: no maps.")); return; }
  if (data.inputs.length < 2 || !formula()) { box.hidden = true; return; }
  const { columns, lines, cells } = plane(state.x, state.y);
  const values = valuesOf(script());
  const grid = html("div", { class: "maps" });
  data.outputs.forEach((output, o) => {
    const truth = samples.outputs[o], made = values[o], [low, high] = samples.ranges[o];
    const mean = (rows, of) => (rows.length ? rows.reduce((sum, row) => sum + of(row), 0) / rows.length : null);
    let largest = 0;
    for (const rows of cells) for (const row of rows) largest = Math.max(largest, Math.abs(made[row] - truth[row]));
    const scale = largest || 1;
    const span = high - low || 1;
    const kinds = [
      ["truth", (row) => truth[row], (v) => sequential((v - low) / span), [low, high]],
      [state.published ? formula().name : "formula", (row) => made[row], (v) => sequential((v - low) / span), [low, high]],
      [`|difference| × ${DIFFERENCE_TIMES}`, (row) => Math.abs(made[row] - truth[row]), (v) => sequential((DIFFERENCE_TIMES * v) / span), [0, span / DIFFERENCE_TIMES]],
      ["formula − truth", (row) => made[row] - truth[row], (v) => diverging(0.5 + (0.5 * v) / scale), [-scale, scale]],
    ];
    if (data.outputs.length > 1) grid.append(html("h3", {}, columnText(output)));
    for (const [title, of, colourOf, range] of kinds) {
      const canvas = html("canvas", { "data-map": title, "data-output": output.name });
      paint(canvas, columns, lines, (column, line) => { const v = mean(cells[line * columns + column], of); return v === null ? null : colourOf(v); });
      canvas.addEventListener("pointermove", (event) => {
        const area = canvas.getBoundingClientRect();
        const column = Math.min(columns - 1, Math.max(0, Math.floor(((event.clientX - area.left) / area.width) * columns)));
        const line = Math.min(lines - 1, Math.max(0, Math.floor((1 - (event.clientY - area.top) / area.height) * lines)));
        const rows = cells[line * columns + column];
        if (!rows.length) return tip("");
        const at = [state.x, state.y].map((i) => `${data.inputs[i].name} ${short(samples.axes[i].places[i === state.x ? column : line])}`).join(", ");
        tip(`${at}\ntruth ${errorText(mean(rows, (r) => truth[r]))}, formula ${errorText(mean(rows, (r) => made[r]))}\ndifference ${errorText(mean(rows, (r) => made[r] - truth[r]))}`, event);
      });
      canvas.addEventListener("pointerleave", () => tip(""));
      grid.append(html("figure", {}, html("figcaption", {}, title), html("div", { class: "map" }, canvas, edge("x", state.x), edge("y", state.y)), bar(range, title === "formula − truth" ? diverging : sequential)));
    }
  });
  box.replaceChildren(...[html("h2", {}, "Error over the domain"), axesChoice(), grid].filter(Boolean));
}

function edge(side, input) {
  const places = samples.axes[input].places;
  return html("div", { class: side }, html("span", {}, short(places[0])), html("span", {}, columnText(data.inputs[input])), html("span", {}, short(places.at(-1))));
}

function bar([low, high], colourOf) {
  const canvas = html("canvas", { "aria-hidden": "true" });
  paint(canvas, 64, 1, (column) => colourOf(column / 63));
  return html("div", { class: "bar" }, short(low), canvas, short(high));
}

/** Which two inputs, and where the others are, if there are any. */
function axesChoice() {
  if (data.inputs.length < 3) return null;
  const names = data.inputs.map((input) => input.name);
  const choose = (which, other) => choice(which === "x" ? "across" : "up", names, state[which], (i) => { if (i === state[other]) state[other] = state[which]; state[which] = i; drawMaps(); });
  const slices = data.inputs.map((input, i) => {
    if (i === state.x || i === state.y || !samples.gridded) return null;
    const last = samples.axes[i].places.length - 1;
    const shown = html("output", {}, short(samples.axes[i].places[sliceOf(i)]));
    const slider = html("input", { type: "range", min: 0, max: last, value: sliceOf(i), change: () => { state.at[i] = slider.value / last; drawMaps(); } });
    return html("label", {}, input.name, slider, shown);
  });
  const mean = samples.gridded ? null : html("span", {}, "each cell the mean of the samples in it");
  return html("div", { class: "row" }, choose("x", "y"), choose("y", "x"), slices, mean);
}
