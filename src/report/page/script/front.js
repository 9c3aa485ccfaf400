// The plot of error against run time.

function paretoIndices(points) {
  const order = points.map((_, i) => i).filter((i) => Number.isFinite(points[i][0]) && Number.isFinite(points[i][1]));
  order.sort((a, b) => points[a][0] - points[b][0] || points[a][1] - points[b][1]);
  let least = Infinity;
  return order.filter((i) => points[i][1] < least && ((least = points[i][1]), true));
}

const pointOf = (one) => [one.costs[state.axis] ?? NaN, one.error[measure()]];
const diamond = (x, y, r) => `M${x} ${y - r}L${x + r} ${y}L${x} ${y + r}L${x - r} ${y}Z`;

function drawFront() {
  const box = byId("front-plot");
  const members = front().members.map(pointOf);
  const published = data.published.map(pointOf);
  const shown = [...members, ...published].filter(([c, e]) => Number.isFinite(c) && Number.isFinite(e));
  const tables = data.lookup_tables.filter((table) => table.error[measure()] > 0);
  const costs = shown.map((p) => p[0]);
  const costliest = Math.max(1e-3, ...costs) * 1.04;
  const cheapest = Math.min(...costs.filter((c) => c > 0), costliest / 2);
  const least = Math.min(...shown.map((p) => p[1]).filter((e) => e > 0));
  // A table far below the front would squeeze it.
  const seen = tables.filter((table) => table.error[measure()] > least / 8);
  const xScale = state.logarithmic ? logarithmic(cheapest / 1.6, costliest * 1.1) : linear(0, costliest);
  const yScale = logarithmicOver([...shown.map((p) => p[1]), ...seen.map((table) => table.error[measure()])]);
  // As high as the formula beside it, unless the plot would be a tower.
  const beside = byId("formula").offsetTop === byId("front").offsetTop ? byId("formula").offsetHeight - 130 : 0;
  const height = Math.max(320, Math.min(Math.max(520, beside), box.clientWidth * 0.86, 680));
  const { root, area, x, y, width } = chart(box, {
    xScale, yScale, height, xLabel: `${axis().unit} (${axis().name})`,
    yLabel: `${measureTitle()}, search split`, describe: `Error against ${axis().unit} of ${members.length} formulas`,
  });
  const stairs = paretoIndices(members);
  drawStairs(root, stairs.map((i) => members[i]), area, x, y);
  for (const table of seen) {
    const at = y(table.error[measure()]);
    root.append(svg("line", { class: "texture", x1: area.left, x2: area.right, y1: at, y2: at }));
    root.append(svg("text", { class: "texture-name", x: area.right, y: at - 5, "text-anchor": "end" }, `table ${data.inputs.map(() => table.size).join(" × ")}`));
  }
  const marks = [];
  members.forEach(([c, e], i) => {
    if (!Number.isFinite(c) || !Number.isFinite(e)) return;
    const mark = svg("circle", { class: `member${stairs.includes(i) ? "" : " beaten"}`, cx: x(c), cy: y(e), r: width < 520 ? 4 : 5, "data-member": i, click: () => select(false, i) });
    root.append(mark);
    marks.push({ at: [x(c), y(e)], published: false, i });
  });
  const labelled = [];
  published.forEach(([c, e], i) => {
    if (!Number.isFinite(c) || !Number.isFinite(e)) return;
    marks.push({ at: [x(c), y(e)], published: true, i });
    labelled.push({ at: [x(c), y(e)], text: data.published[i].name });
  });
  if (width >= 560) placeNames(root, labelled, marks, area);
  published.forEach(([c, e], i) => {
    if (!Number.isFinite(c) || !Number.isFinite(e)) return;
    root.append(svg("path", { class: "published", d: diamond(x(c), y(e), 7), "data-published": i, click: () => select(true, i) }));
  });
  const chosen = marks.find((mark) => mark.published === state.published && mark.i === state.index);
  if (chosen) root.append(svg("circle", { class: "selected-ring", cx: chosen.at[0], cy: chosen.at[1], r: 10 }));
  pickNearest(root, marks);
  drawKey(published.length, seen.length);
}

function drawStairs(root, points, area, x, y) {
  if (points.length === 0) return;
  const corners = points.flatMap(([c, e], i) => [[x(c), y(e)], [i + 1 < points.length ? x(points[i + 1][0]) : area.right, y(e)]]);
  const above = [[corners[0][0], area.top], ...corners, [area.right, area.top]];
  root.insertBefore(svg("path", { class: "dominated", d: path(above) + "Z" }), root.firstChild);
  root.append(svg("path", { class: "staircase", d: path(corners) }));
}

/** Each name where it covers least: beside its mark, or a little away with a line to it. */
function placeNames(root, names, marks, area) {
  const taken = marks.map(({ at: [x, y] }) => ({ x: x - 6, y: y - 6, w: 12, h: 12 }));
  const overlap = (a, b) => Math.max(0, Math.min(a.x + a.w, b.x + b.w) - Math.max(a.x, b.x)) * Math.max(0, Math.min(a.y + a.h, b.y + b.h) - Math.max(a.y, b.y));
  for (const { at: [x, y], text } of names) {
    const w = text.length * 6.7 + 4, h = 15;
    let best = null;
    for (const [dx, dy] of [[11, 0], [-11, 0], [11, -16], [-11, -16], [11, 16], [-11, 16], [11, -32], [-11, -32], [11, 32], [-11, 32], [11, -48], [-11, 48], [11, 48], [-11, -48]]) {
      const at = { x: dx > 0 ? x + dx : x + dx - w, y: y + dy - h / 2, w, h };
      const outside = Math.max(0, area.left - at.x) + Math.max(0, at.x + w - area.right) + Math.max(0, area.top - at.y) + Math.max(0, at.y + h - area.bottom);
      const cost = taken.reduce((sum, other) => sum + overlap(at, other), 0) + outside * 40 + Math.abs(dy) * 1.5 + (dx < 0 ? 4 : 0);
      if (!best || cost < best.cost) best = { at, cost, dx, dy };
    }
    taken.push(best.at);
    if (Math.abs(best.dy) > 20) root.append(svg("line", { class: "leader", x1: x, y1: y, x2: best.dx > 0 ? best.at.x : best.at.x + w, y2: best.at.y + h / 2 }));
    root.append(svg("text", { class: "label", x: best.at.x + 2, y: best.at.y + 11.5 }, text));
  }
}

function pickNearest(root, marks) {
  const nearest = (event) => {
    const box = root.getBoundingClientRect();
    const scale = root.viewBox.baseVal.width / box.width;
    const [px, py] = [(event.clientX - box.left) * scale, (event.clientY - box.top) * scale];
    const distance = ({ at: [x, y] }) => Math.hypot(x - px, y - py);
    const found = marks.reduce((best, mark) => (!best || distance(mark) < distance(best) ? mark : best), null);
    return found && distance(found) < 26 ? found : null;
  };
  root.addEventListener("pointermove", (event) => {
    const mark = nearest(event);
    root.style.cursor = mark ? "pointer" : "";
    if (!mark) return tip("");
    const one = (mark.published ? data.published : front().members)[mark.i];
    tip(`${nameOf(one, mark.i)}: ${costText(one.costs[state.axis])} ${axis().unit}\n${ownMeasure ? `${ownMeasure} ${errorText(one.error[2])}, ` : ""}RMSE ${errorText(one.error[0])}, max ${errorText(one.error[1])}`, event);
  });
  root.addEventListener("pointerleave", () => tip(""));
  root.addEventListener("click", (event) => {
    const mark = nearest(event);
    if (mark) select(mark.published, mark.i);
  });
}

function drawKey(published, tables) {
  const sample = (...shapes) => svg("svg", { viewBox: "0 0 22 12" }, ...shapes);
  const items = [[sample(svg("path", { class: "staircase", d: "M0 6H22" }), svg("circle", { class: "member", cx: 11, cy: 6, r: 4.5 })), `Pareto front in ${measureTitle()}`]];
  if (published) items.push([sample(svg("path", { class: "published", d: diamond(11, 6, 6) })), "published formulas"]);
  if (tables) items.push([sample(svg("path", { class: "texture", d: "M0 6H22" })), "texture with this many texels, filtered linearly"]);
  byId("front-cut").textContent = front().cut;
  byId("front-key").replaceChildren(...items.map(([mark, text]) => html("span", {}, mark, text)));
}
