// Controls, keys, and the first drawing.

function drawControls() {
  const switchFront = (i) => {
    const other = data.fronts[i];
    // The member of the other front that costs as much.
    const cost = state.published ? null : formula()?.costs[data.profile];
    Object.assign(state, { front: i });
    if (!state.published) {
      const near = other.members.map((one, k) => [Math.abs(one.costs[data.profile] - (cost ?? 0)), k]).sort((a, b) => a[0] - b[0])[0];
      state.index = near ? near[1] : 0;
    }
    show();
  };
  const logarithmicBox = html("input", { type: "checkbox", id: "logarithmic", change: () => { state.logarithmic = logarithmicBox.checked; drawFront(); } });
  byId("controls").replaceChildren(
    choice("run time", data.profiles.map(({ name, unit }) => `${unit}, ${name}`), state.axis, (i) => { state.axis = i; show(); }),
    choice("error", data.fronts.map(({ title }) => title), state.front, switchFront),
    html("label", {}, logarithmicBox, "logarithmic run time"),
  );
}

views.push(drawFormula, drawFront, drawMaps, drawProfiles, drawHistogram, drawSpheres, drawTable);
drawControls();
show();
drawConvergence();
byId("copy-command").addEventListener("click", (event) => copy(byId("command").textContent, event.target));
document.addEventListener("keydown", (event) => {
  if (/INPUT|SELECT|TEXTAREA/.test(document.activeElement?.tagName ?? "") || event.ctrlKey || event.metaKey || event.altKey) return;
  const by = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
  if (by) { event.preventDefault(); select(state.published, state.index + by); }
});
let width = innerWidth;
addEventListener("resize", () => { if (innerWidth !== width) { width = innerWidth; drawFront(); drawProfiles(); drawHistogram(); drawConvergence(); } });
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", show);

/** Errors as the page computes them, beside those that are quoted; for whoever doubts either. */
window.lgpCheck = () => {
  const both = (one, f) => ({ name: one.name, formula: one.formula, quoted: one.errors, computed: samples ? errorsOf(f) : null });
  const fronts = data.fronts.flatMap(({ members }, k) => members.map((one, i) => both(one, FUNCTIONS.fronts[k][i])));
  return [...fronts, ...data.published.map((one, i) => both(one, FUNCTIONS.published[i]))];
};
