// Elements, numbers as text, and what a click copies.

const data = JSON.parse(document.getElementById("data").textContent);
const byId = (id) => document.getElementById(id);

function element(space, tag, attributes, children) {
  const made = space ? document.createElementNS(space, tag) : document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (typeof value === "function") made.addEventListener(name, value);
    else if (value === true) made.setAttribute(name, "");
    // The page's policy permits styles only from its own script.
    else if (name === "style") made.style.cssText = value;
    else if (value !== false && value !== null && value !== undefined) made.setAttribute(name, value);
  }
  made.append(...children.flat().filter((child) => child !== null && child !== undefined));
  return made;
}
const html = (tag, attributes = {}, ...children) => element(null, tag, attributes, children);
const svg = (tag, attributes = {}, ...children) => element("http://www.w3.org/2000/svg", tag, attributes, children);

/** Formats an error as `lgp front` does: five decimals, or two digits if that would say little. */
function errorText(value) {
  if (value === null || value === undefined || !Number.isFinite(value)) return "not finite";
  if (value === 0) return "0";
  const size = Math.abs(value);
  return size < 1e-4 || size >= 1e3 ? value.toExponential(1) : value.toFixed(5);
}
const short = (value) => {
  const text = Math.abs(value) >= 1e4 || (value !== 0 && Math.abs(value) < 1e-3) ? value.toExponential(1) : String(+value.toPrecision(3));
  return text.replace("-", "−");
};
const costText = (value) => (value === null || value === undefined ? "–" : String(+value.toFixed(2)));
const columnText = (column) => (column.unit && column.unit !== "1" ? `${column.name} (${column.unit})` : column.name);

function tip(text, event) {
  const box = byId("tip");
  box.hidden = !text;
  if (!text) return;
  box.textContent = text;
  const { width, height } = box.getBoundingClientRect();
  box.style.left = `${Math.max(4, Math.min(event.clientX + 14, innerWidth - width - 6))}px`;
  box.style.top = `${event.clientY + 18 + height > innerHeight ? event.clientY - height - 10 : event.clientY + 18}px`;
}

async function copy(text, button) {
  try {
    await navigator.clipboard.writeText(text);
  } catch {
    const area = html("textarea", { style: "position:fixed;opacity:0" });
    area.value = text;
    document.body.append(area);
    area.select();
    document.execCommand("copy");
    area.remove();
  }
  button.textContent = "Copied";
  setTimeout(() => { button.textContent = "Copy"; }, 1500);
}

function choice(label, options, chosen, change) {
  const box = html("select", { change: () => change(+box.value) }, options.map((text, i) => html("option", { value: i, selected: i === chosen }, text)));
  return html("label", {}, label, box);
}
const colour = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
const LINES = [1, 2, 3, 4, 5].map((i) => `var(--line-${i})`);
