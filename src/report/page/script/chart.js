// Scales and axes.

const SUPERSCRIPTS = { "-": "⁻", 0: "⁰", 1: "¹", 2: "²", 3: "³", 4: "⁴", 5: "⁵", 6: "⁶", 7: "⁷", 8: "⁸", 9: "⁹" };

function linear(low, high) {
  const place = (value) => (value - low) / (high - low || 1);
  const ticks = (most) => {
    const raw = (high - low || 1) / Math.max(1, most);
    const power = 10 ** Math.floor(Math.log10(raw));
    const step = [1, 2, 5, 10].map((m) => m * power).find((s) => s >= raw * 0.999);
    const first = Math.ceil(low / step - 1e-9);
    const count = Math.floor(high / step + 1e-9) - first;
    return Array.from({ length: count + 1 }, (_, i) => ({ value: (first + i) * step, text: short((first + i) * step) }));
  };
  return { place, ticks, invert: (p) => low + p * (high - low) };
}

/** A logarithmic scale above `low`; values below it, zero too, stand at its foot. */
function logarithmic(low, high) {
  const [from, to] = [Math.log10(low), Math.log10(high)];
  const place = (value) => (value > low ? (Math.log10(value) - from) / (to - from || 1) : 0);
  const text = (mantissa, exponent) => {
    if (exponent >= -4 && exponent < 0) return "." + "0".repeat(-exponent - 1) + mantissa;
    if (exponent >= 0 && exponent < 4) return String(mantissa * 10 ** exponent);
    const power = "10" + [...String(exponent)].map((c) => SUPERSCRIPTS[c]).join("");
    return mantissa === 1 ? power : `${mantissa}·${power}`;
  };
  const ticks = (most) => {
    const decades = to - from;
    const mantissas = decades * 3 <= most ? [1, 2, 5] : [1];
    const every = Math.max(1, Math.ceil(decades / Math.max(1, most)));
    const found = [];
    for (let e = Math.floor(from); e <= Math.ceil(to); e++) {
      if (mantissas.length === 1 && e % every !== 0) continue;
      for (const m of mantissas) {
        const value = m * 10 ** e;
        if (Math.log10(value) >= from - 1e-9 && Math.log10(value) <= to + 1e-9) found.push({ value, text: text(m, e) });
      }
    }
    return found;
  };
  return { place, ticks };
}

/** A logarithmic scale with room for all the positive values. */
function logarithmicOver(values, room = 0.06) {
  const positive = values.filter((v) => Number.isFinite(v) && v > 0);
  if (positive.length === 0) return logarithmic(1e-3, 1);
  const [low, high] = [Math.log10(Math.min(...positive)), Math.log10(Math.max(...positive))];
  const margin = Math.max(room * (high - low), 0.4 - (high - low) / 2, 0.05);
  return logarithmic(10 ** (low - margin), 10 ** (high + margin));
}

/** Draws axes as wide as the box: returns an `svg` and the places of values in it. */
function chart(box, { xScale, yScale, xLabel, yLabel, height, right = 12, describe }) {
  const width = Math.max(240, box.clientWidth || 600);
  const yTicks = yScale.ticks(Math.max(3, Math.floor(height / 40)));
  const left = 14 + 7 * Math.max(2, ...yTicks.map((tick) => tick.text.length));
  const area = { left, right: width - right, top: 30, bottom: height - 42 };
  const x = (value) => area.left + xScale.place(value) * (area.right - area.left);
  const y = (value) => area.bottom - yScale.place(value) * (area.bottom - area.top);
  const root = svg("svg", { viewBox: `0 0 ${width} ${height}`, height, role: "img", "aria-label": describe ?? `${yLabel} against ${xLabel}` });
  for (const { value, text } of xScale.ticks(Math.max(3, Math.floor((area.right - area.left) / 62)))) {
    root.append(svg("line", { class: "gridline", x1: x(value), x2: x(value), y1: area.top, y2: area.bottom }));
    root.append(svg("text", { x: x(value), y: area.bottom + 17, "text-anchor": "middle" }, text));
  }
  for (const { value, text } of yTicks) {
    root.append(svg("line", { class: "gridline", x1: area.left, x2: area.right, y1: y(value), y2: y(value) }));
    root.append(svg("text", { x: area.left - 7, y: y(value) + 4, "text-anchor": "end" }, text));
  }
  root.append(svg("line", { class: "axis", x1: area.left, x2: area.right, y1: area.bottom, y2: area.bottom }));
  root.append(svg("text", { x: 2, y: 14 }, yLabel));
  root.append(svg("text", { x: area.right, y: height - 8, "text-anchor": "end" }, xLabel));
  box.replaceChildren(root);
  return { root, area, x, y, width };
}

const path = (points) => points.map(([x, y], i) => `${i ? "L" : "M"}${x.toFixed(1)} ${y.toFixed(1)}`).join("");

/** Names at the right ends of lines, moved apart. */
function endLabels(root, ends, left, bounds) {
  ends.sort((a, b) => a.y - b.y);
  let last = bounds.top - 8;
  for (const end of ends) { end.at = Math.max(end.y, last + 15); last = end.at; }
  let lowest = bounds.bottom + 4;
  for (const end of ends.toReversed()) { end.at = Math.min(end.at, lowest); lowest = end.at - 15; }
  for (const end of ends) root.append(svg("text", { x: left, y: end.at + 4, style: `fill:${end.colour}` }, end.text));
}
