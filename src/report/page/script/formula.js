// The selected formula: its cost, its errors, its text in each language; and the table of all.

function codeText(one, language) {
  const { comment, body } = one.code[language];
  return one.header.map((line) => `${comment} ${line}`.trimEnd() + "\n").join("") + body;
}

/** Verdicts: each name with its status, and the rest of what is known in words. */
function verdictChips(verdict) {
  const words = (value) => (typeof value === "object" && value !== null ? Object.entries(value).map(([k, v]) => `${k} ${words(v)}`).join(", ") : typeof value === "number" ? short(value) : String(value));
  return Object.entries(verdict ?? {}).filter(([, known]) => known && known.status).map(([name, known]) => {
    const rest = Object.entries(known).filter(([key, value]) => key !== "status" && value !== null).map(([key, value]) => `${key}: ${words(value)}`);
    return html("span", { class: `chip ${known.status}`, title: rest.join("\n") || false }, `${name} `, html("b", {}, known.status));
  });
}

function drawFormula() {
  const one = formula(), box = byId("formula");
  if (!one) { box.replaceChildren(html("h2", {}, "No formula"), html("p", { class: "note" }, "The front is empty.")); return; }
  const heading = state.published ? one.name : `Formula ${state.index + 1} of ${formulas().length}`;
  const step = (by) => html("button", { type: "button", title: by < 0 ? "previous formula" : "next formula", click: () => select(state.published, state.index + by) }, by < 0 ? "‹" : "›");
  const emitted = `lgp emit ${folder()} ${front().option ? front().option + " " : ""}--lang ${data.languages[state.language]} --pick ${state.index + 1}`;
  const math = html("div", { class: "math", id: "math" });
  math.innerHTML = one.mathml;
  box.replaceChildren(
    html("div", { class: "row" }, html("h2", { id: "heading", style: "margin:0;color:var(--ink)" }, heading), step(-1), step(1)),
    html("div", { class: "chips" }, verdictChips(one.verdict), one.name ? html("span", { class: "chip" }, "published") : null),
    costTable(one), errorTable(one), math,
    ...(one.template.length ? [html("pre", { id: "template" }, one.template.join("\n"))] : []),
    ...(one.code.length ? codeBox(one, emitted) : [html("pre", {}, one.formula)]),
  );
}

function codeBox(one, emitted) {
  const text = codeText(one, state.language);
  const tab = (name, i) => html("button", { type: "button", "data-language": name, "aria-pressed": String(i === state.language), click: () => { state.language = i; drawFormula(); } }, name);
  const button = html("button", { type: "button", id: "copy", click: () => copy(text, button) }, "Copy");
  return [html("div", { class: "tabs" }, data.languages.map(tab), button), html("pre", { id: "code" }, text), one.name ? "" : html("p", { class: "note" }, html("code", {}, emitted))];
}

function costTable(one) {
  const cells = data.profiles.map((_, i) => html(i === state.axis ? "th" : "td", { style: i === state.axis ? "color:var(--ink);border:0" : "" }, costText(one.costs[i])));
  const registers = data.profiles.map((_, i) => html("td", {}, one.registers[i] ?? ""));
  return html("div", { class: "scroll" }, html("table", { class: "numbers" },
    html("tr", {}, html("th", {}, ""), data.profiles.map(({ name, unit, description }) => html("th", { title: description }, unit === "cycles" ? name : `${name} (${unit})`))),
    html("tr", {}, html("td", {}, "cycles"), cells), html("tr", {}, html("td", {}, "registers"), registers)));
}

function errorTable(one) {
  const titles = ["RMSE", "max", ...(ownMeasure ? [ownMeasure] : [])];
  const row = (name, errors) => html("tr", {}, html("td", {}, name), titles.map((_, i) => html("td", {}, errorText(errors[i]))));
  const barRow = (bars) => html("tr", {}, html("td", {}, "to within"), bars.map((bar) => html("td", {}, errorText(bar))), ownMeasure ? html("td", {}, "") : null);
  return html("div", { class: "scroll" }, html("table", { class: "numbers" },
    html("tr", {}, html("th", {}, "error"), titles.map((title) => html("th", {}, title))),
    one.bars ? [row("whole domain", one.error), barRow(one.bars)] : null,
    row("search split", one.search), row("validation split", one.validation),
    data.outputs.length > 1 ? data.outputs.map((output, o) => row(output.name, one.errors[o])) : null));
}

/** Where this page lies, as one would type it. */
function folder() {
  const parts = decodeURIComponent(location.pathname).split("/").slice(0, -1).filter(Boolean);
  if (location.protocol !== "file:" || !parts.length) return "DIR";
  const typed = parts.slice(-2).join("/");
  return /^[\w./=,:+@%-]+$/.test(typed) ? typed : `'${typed.replaceAll("'", String.raw`'\''`)}'`;
}

const COLUMNS = [
  { key: "number", title: "#", of: (one, i) => i, text: (one, i) => one.name ?? String(i + 1) },
  { key: "cost", title: () => axis().unit, of: (one) => one.costs[state.axis] ?? Infinity, text: (one) => costText(one.costs[state.axis]) },
  { key: "registers", title: "registers", of: (one) => one.registers[state.axis] ?? Infinity, text: (one) => one.registers[state.axis] ?? "–" },
  { key: "rmse", title: "RMSE", of: (one) => one.error[0], text: (one) => errorText(one.error[0]) },
  { key: "max", title: "max", of: (one) => one.error[1], text: (one) => errorText(one.error[1]) },
  { key: "validation", title: "validation RMSE", of: (one) => one.validation[0], text: (one) => errorText(one.validation[0]) },
  { key: "validation_max", title: "validation max", of: (one) => one.validation[1], text: (one) => errorText(one.validation[1]) },
  ...(ownMeasure ? [
    { key: "own", title: ownMeasure, of: (one) => one.error[2], text: (one) => errorText(one.error[2]) },
    { key: "validation_own", title: `validation ${ownMeasure}`, of: (one) => one.validation[2], text: (one) => errorText(one.validation[2]) },
  ] : []),
  { key: "verdict", title: "verdict", of: (one) => JSON.stringify(one.verdict), text: (one) => Object.entries(one.verdict ?? {}).filter(([, v]) => v && v.status).map(([k, v]) => `${k} ${v.status}`).join(", ") || "–" },
  { key: "formula", title: "formula", of: (one) => one.formula.length, text: (one) => one.formula },
];

function drawTable() {
  const rows = [...front().members.map((one, i) => ({ one, i, published: false })), ...data.published.map((one, i) => ({ one, i, published: true }))];
  const column = COLUMNS.find(({ key }) => key === state.sort.column);
  const order = (a, b) => (a < b ? -1 : a > b ? 1 : 0);
  rows.sort((a, b) => order(column.of(a.one, a.i), column.of(b.one, b.i)) || a.published - b.published || a.i - b.i);
  if (state.sort.descending) rows.reverse();
  const sortBy = (key) => { state.sort = { column: key, descending: state.sort.column === key && !state.sort.descending }; drawTable(); };
  const head = COLUMNS.map(({ key, title }) => {
    const sorted = key === state.sort.column;
    const mark = sorted ? (state.sort.descending ? " ↓" : " ↑") : "";
    return html("th", { "aria-sort": sorted ? (state.sort.descending ? "descending" : "ascending") : false }, html("button", { type: "button", "data-sort": key, click: () => sortBy(key) }, (typeof title === "function" ? title() : title) + mark));
  });
  const body = rows.map(({ one, i, published }) => html("tr", { "aria-selected": String(published === state.published && i === state.index), click: () => select(published, i) },
    COLUMNS.map(({ text }, k) => html("td", { class: published && k === 0 ? "of-published" : false }, String(text(one, i))))));
  byId("table").replaceChildren(html("thead", {}, html("tr", {}, head)), html("tbody", {}, body));
}
