// Runs beside each other: medians over seeds, and the band from the best to the worst.

const shown = { time: "seconds", cost: data.costs.indexOf(16) >= 0 ? data.costs.indexOf(16) : 0, measure: 0 };
const UNITS = { seconds: "seconds", considered: "candidates considered" };

function median(values) {
  const sorted = values.filter((v) => v !== null && !Number.isNaN(v)).sort((a, b) => a - b);
  if (!sorted.length) return NaN;
  const last = sorted.length - 1;
  return 0.5 * (sorted[Math.floor(last / 2)] + sorted[Math.ceil(last / 2)]);
}

/** Over places, the median of what the runs have there, and the least and the largest. */
function band(runs, places, of) {
  return places.map((place) => {
    const values = runs.map((run) => of(run, place)).filter(Number.isFinite);
    return values.length === runs.length ? [place, median(values), Math.min(...values), Math.max(...values)] : null;
  }).filter(Boolean);
}

/** What a traced quantity was at a moment: the last that was noted. */
const at = (run, series, moment) => {
  const times = run.trace[shown.time];
  let found = NaN;
  for (let k = 0; k < times.length && times[k] <= moment * (1 + 1e-9); k++) found = series[k];
  return found;
};

function drawBands(box, xScale, yScale, xLabel, yLabel, groups, stepped) {
  const widest = Math.max(...data.groups.map(({ label }) => label.length));
  // If there is little room, the table alone names the colours.
  const named = box.clientWidth > 8 * widest + 320;
  const right = named ? 14 + 7 * widest : 12;
  const { root, x, y, area } = chart(box, { xScale, yScale, xLabel, yLabel, height: 380, right });
  const ends = [];
  groups.forEach((points, g) => {
    if (!points.length) return;
    const stair = (k) => points.flatMap((p, i) => (stepped && i > 0 ? [[x(p[0]), y(points[i - 1][k])], [x(p[0]), y(p[k])]] : [[x(p[0]), y(p[k])]]));
    const outline = [...stair(2), ...stair(3).reverse()];
    root.append(svg("path", { d: path(outline) + "Z", style: `fill:${LINES[g % 5]};fill-opacity:.16` }));
    root.append(svg("path", { class: "series", d: path(stair(1)), style: `stroke:${LINES[g % 5]}` }));
    ends.push({ y: y(points.at(-1)[1]), text: data.groups[g].label, colour: LINES[g % 5] });
  });
  if (named) endLabels(root, ends, area.right + 6, area);
}

const errorAt = (run, cost) => Math.min(Infinity, ...run.front.filter((p) => p[0] <= cost).map((p) => p[1 + shown.measure]));

function drawFronts() {
  const most = Math.ceil(Math.max(...data.groups.flatMap(({ runs }) => runs.flatMap(({ front }) => front.map((p) => p[0])))));
  const costs = Array.from({ length: most + 1 }, (_, i) => i);
  const groups = data.groups.map(({ runs }) => band(runs, costs, errorAt));
  const errors = groups.flat().flatMap((p) => [p[2], p[3]]);
  drawBands(byId("fronts"), linear(0, most), logarithmicOver(errors), `cycles (${data.gpu})`, `${data.measures[shown.measure]}, search split`, groups, true);
}

function drawTimes() {
  const traced = (runs) => runs.every(({ trace }) => trace);
  const any = data.groups.some(({ runs }) => traced(runs));
  byId("volume").closest("section").hidden = !any || !data.same_budget;
  byId("error").closest("section").hidden = !any;
  if (!any) return;
  const times = data.groups.map(({ runs }) => (traced(runs) ? [...new Set(runs.flatMap(({ trace }) => trace[shown.time]))].filter((t) => t > 0).sort((a, b) => a - b) : []));
  const xScale = logarithmicOver(times.flat(), 0.01);
  // To the end of the shortest run of each group.
  const within = (runs, moments) => { if (!traced(runs)) return []; const last = Math.min(...runs.map(({ trace }) => trace[shown.time].at(-1))); return moments.filter((t) => t <= last); };
  const bands = (of) => data.groups.map(({ runs }, g) => band(runs, within(runs, times[g]), of));
  const volumes = bands((run, t) => at(run, run.trace.hypervolume, t));
  const all = volumes.flat().flatMap((p) => [p[2], p[3]]);
  drawBands(byId("volume"), xScale, linear(Math.min(...all), Math.max(...all)), UNITS[shown.time], "hypervolume: cycles × log error", volumes, false);
  const errors = bands((run, t) => at(run, run.trace.errors[run.trace.costs.indexOf(data.costs[shown.cost])] ?? [], t));
  drawBands(byId("error"), xScale, logarithmicOver(errors.flat().flatMap((p) => [p[2], p[3]])), UNITS[shown.time], `error at ${data.costs[shown.cost]} cycles at most, before polishing`, errors, false);
}

function drawComparison() {
  const head = ["", "runs", "seconds", "candidates", "hypervolume", ...data.costs.map((cost) => `≤ ${cost}`)];
  const rows = data.groups.map(({ label, runs }, g) => [
    html("span", { style: `color:${LINES[g % 5]};font-weight:600` }, label), String(runs.length), short(median(runs.map((r) => r.seconds))), String(Math.round(median(runs.map((r) => r.considered)))),
    data.same_budget && runs.every((r) => r.trace) ? short(median(runs.map((r) => r.trace.hypervolume.at(-1)))) : "–", ...data.costs.map((cost) => errorText(median(runs.map((r) => errorAt(r, cost))))),
  ]);
  byId("comparison").replaceChildren(html("thead", {}, html("tr", {}, head.map((text) => html("th", {}, text)))), html("tbody", {}, rows.map((row) => html("tr", {}, row.map((cell) => html("td", {}, cell))))));
}

const keys = Object.keys(UNITS);
function showAll() { drawFronts(); drawTimes(); drawComparison(); }
byId("controls").append(
  choice("error", data.measures, 0, (i) => { shown.measure = i; showAll(); }),
  choice("against", Object.values(UNITS), 0, (i) => { shown.time = keys[i]; drawTimes(); }),
  choice("cycles", data.costs.map((cost) => `≤ ${cost}`), shown.cost, (i) => { shown.cost = i; drawTimes(); }),
);
showAll();
let width = innerWidth;
addEventListener("resize", () => { if (innerWidth !== width) { width = innerWidth; showAll(); } });
