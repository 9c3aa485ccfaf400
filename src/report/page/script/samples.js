// The samples, and the values of formulas there.

const samples = (() => {
  const table = data.samples;
  if (!table) return null;
  const rows = table.outputs[0].length;
  const inputs = table.inputs.map((values, axis) => {
    if (table.grid.length === 0) return values;
    const below = table.grid.slice(axis + 1).reduce((a, b) => a * b, 1);
    return Array.from({ length: rows }, (_, row) => values[Math.floor(row / below) % table.grid[axis]]);
  });
  const ranges = table.outputs.map((values) => values.reduce(([a, b], v) => [Math.min(a, v), Math.max(b, v)], [Infinity, -Infinity]));
  const axes = inputs.map((values) => bins(values));
  return { rows, inputs, outputs: table.outputs, ranges, axes, gridded: table.grid.length > 0 };
})();

/** Places along an axis, each row's place among them: the values that occur, or bins of as many rows. */
function bins(values) {
  const MOST = 64, FEW = 32;
  let places = [...new Set(values)].sort((a, b) => a - b);
  if (places.length > MOST && !(data.samples.grid.length > 0)) {
    places = Array.from({ length: FEW }, (_, i) => places[Math.floor(((i + 0.5) / FEW) * places.length)]);
  }
  const of = Uint16Array.from(values, (value) => {
    let [low, high] = [0, places.length - 1];
    while (low < high) {
      const middle = (low + high) >> 1;
      if (places[middle] + places[middle + 1] < 2 * value) low = middle + 1; else high = middle;
    }
    return low;
  });
  return { places, of };
}

const evaluated = new Map();
/** By output, the formula's value on each row. */
function valuesOf(f) {
  if (!evaluated.has(f)) {
    const values = data.outputs.map(() => new Float32Array(samples.rows));
    const arguments_ = new Array(data.inputs.length);
    for (let row = 0; row < samples.rows; row++) {
      for (let i = 0; i < arguments_.length; i++) arguments_[i] = samples.inputs[i][row];
      const result = f(...arguments_);
      for (let o = 0; o < values.length; o++) values[o][row] = result[o];
    }
    evaluated.set(f, values);
  }
  return evaluated.get(f);
}

/** Errors of what the page computes, to be held against those that are quoted. */
function errorsOf(f) {
  return valuesOf(f).map((values, o) => {
    let [squares, max] = [0, 0];
    for (let row = 0; row < samples.rows; row++) {
      const difference = values[row] - samples.outputs[o][row];
      squares += difference * difference;
      max = Math.max(max, Math.abs(difference));
    }
    return [Math.sqrt(squares / samples.rows), max];
  });
}

/** Returns the rows in each cell of the plane of two inputs, with the others at `state.at`. */
function plane(x, y) {
  const [columns, lines] = [samples.axes[x].places.length, x === y ? 1 : samples.axes[y].places.length];
  const cells = Array.from({ length: columns * lines }, () => []);
  const others = data.inputs.map((_, i) => i).filter((i) => i !== x && i !== y);
  // A slice of a grid; or all rows, if there is no grid, since few have the same values.
  const fixed = samples.gridded ? others.map((i) => [samples.axes[i].of, sliceOf(i)]) : [];
  for (let row = 0; row < samples.rows; row++) {
    if (fixed.every(([of, place]) => of[row] === place)) {
      cells[(x === y ? 0 : samples.axes[y].of[row]) * columns + samples.axes[x].of[row]].push(row);
    }
  }
  return { columns, lines, cells };
}
const sliceOf = (input) => Math.round(state.at[input] * (samples.axes[input].places.length - 1));
