// Errors along each input, their histogram, and the progress of the search.

function drawProfiles() {
  const box = byId("profiles");
  box.hidden = !samples || !formula();
  if (box.hidden) return;
  const values = valuesOf(script());
  const plots = html("div", { class: "pair" });
  box.replaceChildren(html("h2", {}, "Error along each input"), html("p", { class: "note" }, "RMSE over the other inputs; dashed, the largest."), plots);
  if (data.inputs.length === 1) drawCurve(plots, values);
  // All boxes first: the width of each depends on how many there are.
  const boxes = data.inputs.map(() => html("div", { class: "plot" }));
  plots.append(...boxes);
  data.inputs.forEach((input, i) => {
    const { places, of } = samples.axes[i];
    const lines = values.map((made, o) => {
      const [squares, most, count] = [places.map(() => 0), places.map(() => 0), places.map(() => 0)];
      for (let row = 0; row < samples.rows; row++) {
        const difference = Math.abs(made[row] - samples.outputs[o][row]), at = of[row];
        squares[at] += difference * difference; most[at] = Math.max(most[at], difference); count[at] += 1;
      }
      return { rms: squares.map((s, k) => Math.sqrt(s / count[k])), most };
    });
    const yScale = logarithmicOver(lines.flatMap(({ rms, most }) => [...rms, ...most]).filter((v) => v > 1e-12));
    const { root, x, y, area } = chart(boxes[i], { xScale: linear(...domain(places)), yScale, xLabel: columnText(input), yLabel: "error", height: 220 });
    lines.forEach(({ rms, most }, o) => {
      const line = (of_, thin) => root.append(svg("path", { class: `series${thin}`, style: `stroke:${LINES[o % 5]}`, d: path(places.map((place, k) => [x(place), y(of_[k])])) }));
      line(most, " thin");
      line(rms, "");
    });
    if (i === 0) legend(root, area);
  });
}

/** Of one input: the truth and the formula. */
function drawCurve(plots, values) {
  const plot = html("div", { class: "plot" });
  plots.append(plot);
  const order = samples.inputs[0].map((_, row) => row).sort((a, b) => samples.inputs[0][a] - samples.inputs[0][b]);
  const all = [...samples.outputs.flat(), ...values.flatMap((v) => [...v])].filter(Number.isFinite);
  const { root, x, y } = chart(plot, { xScale: linear(...domain(samples.axes[0].places)), yScale: linear(Math.min(...all), Math.max(...all)), xLabel: columnText(data.inputs[0]), yLabel: "truth; dashed, formula", height: 260 });
  values.forEach((made, o) => {
    const line = (of, thin, stroke) => root.append(svg("path", { class: `series${thin}`, style: `stroke:${stroke};stroke-width:2`, d: path(order.map((row) => [x(samples.inputs[0][row]), y(of[row])])) }));
    line(samples.outputs[o], "", LINES[o % 5]);
    line(made, " thin", "var(--ink)");
  });
}

const domain = (places) => [places[0], places.at(-1)];

function legend(root, area) {
  if (data.outputs.length < 2) return;
  let right = area.right;
  for (const [o, output] of [...data.outputs.entries()].reverse()) {
    root.append(svg("text", { x: right, y: 14, "text-anchor": "end", style: `fill:${LINES[o % 5]}` }, output.name));
    right -= output.name.length * 7 + 12;
  }
}

function drawHistogram() {
  const box = byId("histogram");
  box.hidden = !samples || !formula();
  if (box.hidden) return;
  const BINS = 41, values = valuesOf(script());
  const errors = values.map((made, o) => Array.from(made, (v, row) => v - samples.outputs[o][row]));
  const reach = errors.flat().reduce((most, e) => Math.max(most, Math.abs(e)), 0) || 1e-12;
  const counts = errors.map((list) => {
    const count = new Array(BINS).fill(0);
    for (const e of list) count[Math.min(BINS - 1, Math.floor(((e + reach) / (2 * reach)) * BINS))] += 100 / list.length;
    return count;
  });
  const plot = html("div", { class: "plot" });
  box.replaceChildren(html("h2", {}, "Histogram of the error"), html("p", { class: "note" }, "Formula − truth, in percent of the samples."), plot);
  const { root, x, y, area } = chart(plot, { xScale: linear(-reach, reach), yScale: linear(0, Math.max(...counts.flat()) * 1.05), xLabel: "formula − truth", yLabel: "% of samples", height: 260 });
  counts.forEach((count, o) => {
    const corners = count.flatMap((c, k) => [[x(-reach + (2 * reach * k) / BINS), y(c)], [x(-reach + (2 * reach * (k + 1)) / BINS), y(c)]]);
    const outline = [[area.left, area.bottom], ...corners, [area.right, area.bottom]];
    root.append(svg("path", { d: path(outline) + "Z", style: `fill:${LINES[o % 5]};fill-opacity:.16;stroke:${LINES[o % 5]};stroke-width:1.5` }));
  });
  legend(root, area);
}

function drawConvergence() {
  const box = byId("convergence"), trace = data.trace;
  box.hidden = !trace || trace.seconds.length < 2;
  if (box.hidden) return;
  const times = trace[state.time];
  const units = { seconds: "seconds", considered: "candidates considered" };
  const plots = html("div", { class: "pair", style: "grid-template-columns:repeat(auto-fit,minmax(min(100%,420px),1fr))" });
  const keys = Object.keys(units);
  box.replaceChildren(html("h2", {}, "Progress of the search"), html("div", { class: "row" }, choice("against", Object.values(units), keys.indexOf(state.time), (i) => { state.time = keys[i]; drawConvergence(); })), plots);
  const boxes = [html("div", { class: "plot" }), html("div", { class: "plot" })];
  plots.append(...boxes);
  const panel = (plot, yScale, yLabel, lines, right) => {
    const { root, x, y, area } = chart(plot, { xScale: logarithmicOver(times, 0.01), yScale, xLabel: units[state.time], yLabel, height: 340, right });
    const ends = [];
    for (const { values, name, colour } of lines) {
      const points = times.map((t, k) => [t, values[k]]).filter(([t, v]) => t > 0 && Number.isFinite(v) && v > 0);
      if (points.length < 2) continue;
      root.append(svg("path", { class: "series", style: `stroke:${colour}`, d: path(points.map(([t, v]) => [x(t), y(v)])) }));
      ends.push({ y: y(points.at(-1)[1]), text: name, colour });
    }
    endLabels(root, ends, area.right + 6, area);
  };
  const shade = (k) => `color-mix(in oklab, var(--front) ${100 - 70 * (k / Math.max(1, trace.costs.length - 1))}%, var(--published))`;
  const lines = trace.costs.map((cost, k) => ({ values: trace.errors[k], name: `≤ ${cost}`, colour: shade(k) }));
  panel(boxes[0], logarithmicOver(trace.errors.flat()), "the minimised error, for each limit on cycles, before polishing", lines, 52);
  const volume = trace.hypervolume.filter(Number.isFinite);
  panel(boxes[1], linear(Math.min(...volume), Math.max(...volume)), "hypervolume: cycles × log error", [{ values: trace.hypervolume, name: "", colour: "var(--front)" }], 14);
}
