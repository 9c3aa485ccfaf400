// The state of the page: what is shown.

/** The selection; `published`, if set, takes the place of a member of the front. */
const state = {
  axis: data.profile, front: 0, published: false, index: data.fronts[0].knee,
  language: 0, logarithmic: false, sort: { column: "cost", descending: false },
  x: 0, y: Math.min(1, data.inputs.length - 1), at: data.inputs.map(() => 0.5), time: "seconds",
};

const front = () => data.fronts[state.front];
const formulas = () => (state.published ? data.published : front().members);
const formula = () => formulas()[state.index];
const script = () => (state.published ? FUNCTIONS.published : FUNCTIONS.fronts[state.front])[state.index];
/** The place of the front's measure among a formula's errors; the third is that of no other column. */
const MEASURES = ["rmse", "max"];
const measure = () => (MEASURES.includes(front().measure) ? MEASURES.indexOf(front().measure) : 2);
/** The measure that the search minimised, if it is neither RMSE nor the maximum. */
const ownMeasure = MEASURES.includes(data.fronts[0].measure) ? null : data.fronts[0].title;
const measureTitle = () => front().title;
const axis = () => data.profiles[state.axis];
const nameOf = (one, i) => one.name ?? `formula ${i + 1}`;

/** Those that show something call this with how they show it. */
const views = [];
function show() { for (const view of views) view(); }
function select(published, index) {
  if (!(published ? data.published : front().members)[index]) return;
  Object.assign(state, { published, index });
  show();
}
