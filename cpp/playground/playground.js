// The page: a text on the left, what the program says of it on the right. Every number that is shown comes from the
// compiled program; this script reads no problem file and computes no contact.
"use strict";

const given = JSON.parse(document.getElementById("data").textContent);
const byId = (id) => document.getElementById(id);
const calm = matchMedia("(prefers-reduced-motion: reduce)");
const patient = 40000; // dofs times steps beyond which a run waits for the button
const five = (x) => String(Number(x.toPrecision(5))).replace("-", "\u2212");
const editor = byId("text");

let program = null; // the compiled program
let model = null;   // what contct_check says of the last text that it accepts
let states = null;  // what the page draws: of contct_run's result, see statesOf
let told = null;    // contct_explain's answer for the increment that is shown
let shown = 0;      // state of the path
let chosen = 0;     // pair whose story is told, from 0
let timer = 0;      // of playing
let later = 0;      // of what is not done in every frame

// ------------------------------------------------------------------------------------------------ the program

/** Call a function of serve.h with texts; its answer as an object. */
function ask(name, ...texts) {
  const places = texts.map((text) => {
    const room = program.lengthBytesUTF8(text) + 1;
    const place = program._malloc(room);
    program.stringToUTF8(text, place, room);
    return place;
  });
  const answer = program[`_contct_${name}`](...places);
  places.forEach((place) => program._free(place));
  if (answer === 0) throw new Error("memory does not suffice");
  const text = program.UTF8ToString(answer);
  program._contct_free(answer);
  return JSON.parse(text);
}

const askAbout = (name, options) => ask(name, editor.value, JSON.stringify({ file: "problem.toml", ...options }));
const kernelNames = () => byId("kernels").value.split(",");

// --------------------------------------------------------------------------------------- numbers of the text

/** A number as it is written when it is dragged: 4 digits, a whole number where the key takes one. */
function written(x, place) {
  if (place.whole && /(^|\.)(node|nodes|elements|nx|ny)(\[|$)/.test(place.key)) return String(Math.round(x));
  const text = String(Number(x.toPrecision(4)));
  return /[.e]/.test(text) ? text : `${text}.0`;
}

/** Where a number stands in the text, as [from, to]. Columns count code points. */
function spanOf(place) {
  const lines = editor.value.split("\n");
  let from = 0;
  for (let i = 0; i + 1 < place.line; ++i) from += lines[i].length + 1;
  from += [...(lines[place.line - 1] || "")].slice(0, place.column - 1).join("").length;
  return [from, from + place.length];
}

const numberOf = (key) => model && model.numbers.find((n) => n.key === key);

/** Put other numbers in the place of some: { key: value }. */
function change(values) {
  const edits = Object.entries(values).map(([key, value]) => ({ place: numberOf(key), value })).filter((e) => e.place);
  edits.sort((a, b) => b.place.line - a.place.line || b.place.column - a.place.column);
  for (const { place, value } of edits) {
    const [from, to] = spanOf(place);
    editor.setRangeText(typeof value === "string" ? value : written(value, place), from, to, "preserve");
  }
  if (edits.length > 0) recompute();
}

/** A slider a number: it goes from a tenth to ten times, or over the nodes. */
function showNumbers() {
  const holder = byId("numbers");
  const keys = model.numbers.map((n) => n.key).join();
  const most = 80;
  const listed = model.numbers.slice(0, most);
  if (holder.dataset.keys === keys) {
    listed.forEach((n, i) => {
      const [slider, field] = [holder.children[3 * i + 1], holder.children[3 * i + 2]];
      if (document.activeElement !== slider) setSlider(slider, n);
      if (document.activeElement !== field) field.value = literal(n);
    });
    return;
  }
  holder.dataset.keys = keys;
  holder.replaceChildren(...listed.flatMap((n, i) => {
    const slider = element("input", { type: "range", min: "-100", max: "100", step: "1", id: `number-${i}`, "aria-label": n.key });
    const field = element("input", { type: "text", inputmode: "decimal", "aria-label": `${n.key}, typed`, value: literal(n) });
    setSlider(slider, n);
    slider.addEventListener("input", () => change({ [n.key]: slid(slider) }));
    slider.addEventListener("change", () => { const now = numberOf(n.key); if (now) setSlider(slider, now); });
    field.addEventListener("change", () => change({ [n.key]: field.value.trim() }));
    return [element("label", { for: `number-${i}` }, n.key), slider, field];
  }));
}

const literal = (n) => { const [from, to] = spanOf(n); return editor.value.slice(from, to); };

/** Sliders begin in the middle, at the number as it is. Counts go in steps of 1; what is 0 goes from -1 to 1. */
function setSlider(slider, n) {
  slider.dataset.middle = String(n.value);
  slider.dataset.whole = n.whole && /node|elements|nx|ny/.test(n.key) ? "yes" : "";
  slider.value = "0";
  slider.setAttribute("aria-valuetext", literal(n));
}
function slid(slider) {
  const [middle, at] = [Number(slider.dataset.middle), Number(slider.value)];
  if (slider.dataset.whole) return Math.max(1, middle + Math.round(at / 5));
  return middle === 0 ? at / 100 : middle * 10 ** (at / 100);
}

// ------------------------------------------------------------------------------------------------- recomputing

/** Mark a number that is dragged, or what is wrong, behind the text. */
function mark(from, to, kind) {
  const text = editor.value;
  const marked = element("mark", { class: kind }, text.slice(from, to) || " ");
  byId("marks").replaceChildren(text.slice(0, from), ...(to > from ? [marked] : []), text.slice(to), "\n");
  follow();
}
function follow() {
  byId("marks").scrollTop = editor.scrollTop;
  byId("marks").scrollLeft = editor.scrollLeft;
}

/** What the program says against the text; a click goes to the place. */
function complain(error) {
  byId("stage").classList.add("stale");
  const button = element("button", { type: "button", class: "bad" }, error.message);
  const lines = editor.value.split("\n");
  let [from, to] = [0, 0];
  if (error.line !== null && error.line <= lines.length) {
    for (let i = 0; i + 1 < error.line; ++i) from += lines[i].length + 1;
    to = from + lines[error.line - 1].length;
    if (error.column !== null) from += [...lines[error.line - 1]].slice(0, error.column - 1).join("").length;
    button.addEventListener("click", () => { editor.focus(); editor.setSelectionRange(from, to); });
  }
  mark(from, to, "wrong");
  byId("message").replaceChildren(button);
}

function tell(messages) {
  byId("message").replaceChildren(...messages.slice(0, 6).map((words) => element("p", { class: "quiet" }, words)));
}

/** Everything from the text, but for what can wait for a pause. */
function recompute({ asked = false } = {}) {
  const begun = performance.now();
  const checked = askAbout("check", { places: true });
  if (checked.error) return complain(checked.error);
  model = checked.result;
  mark(0, 0, "");
  showNumbers();
  if (!asked && model.dofs * model.steps.length > patient) return waitForButton();
  const answer = askAbout("run", { kernels: kernelNames(), states: true });
  if (answer.error) return complain(answer.error);
  states = statesOf(answer.result);
  tell(answer.messages);
  byId("stage").classList.remove("stale");
  const last = states.frames.length - 1;
  byId("slider").max = String(last);
  shown = Math.min(shown, last);
  showPairs();
  showEvents();
  showVerdict(answer);
  show(shown, { explain: false });
  byId("time").textContent = `Recomputed in ${five(performance.now() - begun)} ms.`;
  // For whoever looks from the console, as the test does.
  window.contct = { answer, model, states, ask, milliseconds: performance.now() - begun };
  clearTimeout(later);
  later = setTimeout(afterPause, Math.max(250, 8 * (performance.now() - begun)));
}

/** The path's states, of a beam with deflections at places along it: in every element where there are few. */
function statesOf(result) {
  const [places, { structure }] = [placesOf(result), result];
  const made = { result, structure, ...places, frames: framesOf(result, places), x: [] };
  if (structure.kind !== "beam") return made;
  const xs = structure.nodes.map((n) => n.x);
  const parts = Math.max(1, Math.min(24, Math.floor(240 / (xs.length - 1))));
  const stride = Math.ceil(xs.length / 240);
  for (let e = 0; e + 1 < xs.length; e += stride)
    for (let i = 0; i < parts; ++i) made.x.push([xs[e] + ((xs[e + 1] - xs[e]) * i) / parts, e]);
  made.x.push([xs[xs.length - 1], xs.length - 2]);
  for (const f of made.frames) f.w = made.x.map(([x, e]) => deflectionAt(structure, f, x, e));
  made.x = made.x.map(([x]) => x);
  return made;
}

function waitForButton() {
  const button = element("button", { type: "button" }, `Run: ${model.dofs} dofs, ${model.steps.length} steps`);
  button.addEventListener("click", () => recompute({ asked: true }));
  byId("message").replaceChildren(button);
}

/** The listing's story and the report take longer than a frame. */
function afterPause() {
  if (states && !dragging) explainState(states.frames[shown]);
  if (byId("report-details").open && model.dofs * model.steps.length <= patient) {
    const answer = askAbout("run", { kernels: kernelNames(), page: true });
    if (!answer.error) byId("report").srcdoc = answer.page;
  }
}

function showVerdict(answer) {
  const equal = answer.exit !== 1;
  const lines = [];
  const { kernels, words, certified } = states.result;
  if (kernels.length > 1)
    lines.push([equal, `${kernels.join(" and ")} are ${equal ? "equal" : "NOT equal"} to the bit; ${words.comparison}`]);
  if (words.end) lines.push([false, words.end]);
  for (const said of words.certificate) lines.push([certified, said]);
  byId("verdict").replaceChildren(...lines.map(([good, said]) => element("li", { class: good ? "good" : "bad" }, said)));
}

// ------------------------------------------------------------------------------------------------- the picture

const margin = 46;
let scale = null; // of the last picture: what drags are measured by

/** The largest of what is drawn upwards and downwards, over all states, so that the picture does not jump. */
function reachOf() {
  let most = 0;
  for (const f of states.frames) for (const w of f.w || []) most = Math.max(most, Math.abs(w));
  for (const p of states.pairs) most = Math.max(most, Math.abs(p.face));
  return most || 1;
}

function drawBeam(f) {
  const width = Math.max(320, byId("stage").clientWidth || 600);
  const height = Math.max(240, Math.min(340, width * 0.5));
  const xs = states.x;
  const [least, most] = [Math.min(...xs), Math.max(...xs)];
  const reach = dragging ? scale.reach : reachOf() * 1.15;
  const X = (x) => margin + ((x - least) / (most - least || 1)) * (width - 2 * margin);
  const Y = (w) => height / 2 - (w / reach) * (height / 2 - 40);
  scale = { reach, X, Y, least, most, width, height };
  const root = svg("svg", { viewBox: `0 0 ${width} ${height}`, role: "img", "aria-label": `The beam in state ${shown} of ${states.frames.length - 1}` });
  root.append(svg("line", { x1: X(least), x2: X(most), y1: Y(0), y2: Y(0), class: "undeformed" }));
  drawSupports(root, f);
  drawPairs(root, f);
  root.append(svg("path", { d: xs.map((x, i) => `${i === 0 ? "M" : "L"}${X(x).toFixed(2)} ${Y(f.w[i]).toFixed(2)}`).join(""), class: "beam" }));
  drawLoads(root, f);
  root.append(svg("text", { x: margin, y: height - 8, class: "quiet-text" }, `x = ${five(least)}`),
    svg("text", { x: width - margin, y: height - 8, "text-anchor": "end", class: "quiet-text" }, `x = ${five(most)}`));
  return root;
}

const deflection = (f, x) => deflectionAt(states.structure, f, x);

function drawSupports(root, f) {
  for (const s of states.supports) {
    const [x, y] = [scale.X(s.x), scale.Y(deflection(f, s.x))];
    const clamped = s.dofs.length > 1;
    root.append(svg("path", { d: clamped ? `M${x} ${y - 14}v28` : `M${x} ${y}l-8 14h16z`, class: "support" },
      svg("title", {}, `support at x = ${five(s.x)}: ${s.dofs.map(([dof]) => dof).join(", ")}`)));
  }
}

/** Something that can be dragged, or moved by the arrow keys. `to` gets pixels from where the drag began. */
function handle(attributes, words, begin) {
  const made = svg("rect", { class: "handle", tabindex: "0", role: "slider", "aria-label": words, rx: 4, ...attributes }, svg("title", {}, words));
  made.addEventListener("pointerdown", (event) => startDrag(event, begin()));
  made.addEventListener("keydown", (event) => {
    const step = { ArrowUp: [0, -1], ArrowDown: [0, 1], ArrowLeft: [-1, 0], ArrowRight: [1, 0] }[event.key];
    if (!step) return;
    event.preventDefault();
    const index = [...made.ownerSVGElement.querySelectorAll(".handle")].indexOf(made);
    begin()(...step.map((s) => s * (event.shiftKey ? 20 : 4)));
    const again = byId("stage").querySelectorAll(".handle")[index];
    if (again) again.focus();
  });
  return made;
}

let dragging = null; // { to, x, y } while something is dragged
let pending = null;  // the last movement, until the next frame

function startDrag(event, to) {
  event.preventDefault();
  const box = byId("stage").getBoundingClientRect();
  dragging = { to, x: event.clientX, y: event.clientY, times: scale.width / box.width };
}
addEventListener("pointermove", (event) => {
  if (!dragging) return;
  if (pending === null) requestAnimationFrame(() => {
    const [x, y] = pending;
    pending = null;
    if (dragging) dragging.to((x - dragging.x) * dragging.times, (y - dragging.y) * dragging.times);
  });
  pending = [event.clientX, event.clientY];
});
for (const end of ["pointerup", "pointercancel"]) addEventListener(end, () => {
  if (!dragging) return;
  dragging = null;
  show(shown);
});

function drawPairs(root, f) {
  const half = Math.max(7, Math.min(22, ((scale.width - 2 * margin) / (states.pairs.length + 1)) * 0.4));
  states.pairs.forEach((p, i) => {
    const [x, y] = [scale.X(p.x), scale.Y(p.face)];
    const { look } = f.pairs[i];
    const far = p.side < 0 ? scale.height - 24 : 24;
    root.append(svg("line", { x1: x - half, x2: x + half, y1: y, y2: y, class: `face ${look}` }),
      svg("path", { d: `M${x} ${y}L${x} ${far}M${x - 8} ${far}h16`, class: "spring" }));
    if (i === chosen) root.append(svg("circle", { cx: x, cy: y, r: half + 5, class: "chosen" }));
    const known = model.pair_list[p.pair - 1] || {};
    const began = known.face;
    const words = `face of pair ${p.pair} at ${five(p.face)}, ${{ o: "separated", c: "in contact", f: "at its face" }[look]}`;
    const made = handle({ x: x - half - 2, y: y - 10, width: 2 * half + 4, height: 20 }, words, () => {
      const [reach, from] = [scale, began];
      return (dx, dy) => {
        const moved = from - (dy / (reach.height / 2 - 40)) * reach.reach;
        change({ [known.face_key]: p.side < 0 ? Math.min(0, moved) : Math.max(0, moved) });
      };
    });
    made.addEventListener("click", () => choose(i));
    root.append(made);
  });
}

/** Point loads of a step by the keys of their numbers: { value: key, place: key, x }. */
function pointsOf(step) {
  const found = new Map();
  for (const n of model.numbers) {
    const parts = /^(step\[(\d+)\]\.point\[\d+\])\.(node|x|w)$/.exec(n.key);
    if (parts && Number(parts[2]) === step) found.set(parts[1], { ...(found.get(parts[1]) || {}), [parts[3]]: n });
  }
  return [...found.values()].filter((p) => p.w && (p.node || p.x));
}

const nearestNode = (x) => model.node_list.reduce((best, [at], i) => (Math.abs(at - x) < Math.abs(model.node_list[best][0] - x) ? i : best), 0);

function drawLoads(root, f) {
  const step = Math.max(1, f.step);
  const most = Math.max(...pointsOf(step).map((p) => Math.abs(p.w.value)), 0);
  for (const p of pointsOf(step)) {
    const x = p.x ? p.x.value : (model.node_list[p.node.value - 1] || [0])[0];
    const share = p.w.value / (most || 1);
    const [px, y] = [scale.X(x), scale.Y(deflection(f, x))];
    const tail = y + 44 * share - (share > 0 ? -14 : 14);
    root.append(svg("path", { d: `M${px} ${tail}L${px} ${y}M${px - 5} ${y + (share > 0 ? 8 : -8)}L${px} ${y}l5 ${share > 0 ? 8 : -8}`, class: "load", fill: "none" }),
      svg("text", { x: px + 6, y: tail + 4, class: "quiet-text" }, five(p.w.value)));
    root.append(handle({ x: px - 12, y: Math.min(tail, y) - 8, width: 24, height: Math.abs(tail - y) + 16, class: "handle across" },
      `load of step ${step}: ${five(p.w.value)} at x = ${five(x)}`, () => {
        const [from, at, of] = [p.w.value, x, scale];
        return (dx, dy) => {
          const node = nearestNode(at + (dx / (of.width - 2 * margin)) * (of.most - of.least));
          const value = from - (dy / 60) * (Math.abs(from) || 1);
          change({ [p.w.key]: value, ...(p.node ? { [p.node.key]: node + 1 } : { [p.x.key]: model.node_list[node][0] }) });
        };
      }));
  }
  const uniform = numberOf(`step[${step}].uniform`);
  if (!uniform) return;
  const y = 16;
  root.append(svg("path", { d: `M${margin} ${y}H${scale.width - margin}`, class: "load" }),
    svg("text", { x: scale.width / 2, y: y - 4, "text-anchor": "middle" }, `uniform ${five(uniform.value)}`),
    handle({ x: margin, y: y - 14, width: scale.width - 2 * margin, height: 24 }, `uniform load of step ${step}: ${five(uniform.value)}`, () => {
      const from = uniform.value;
      return (dx, dy) => change({ [uniform.key]: from - (dy / 100) * (Math.abs(from) || 1) });
    }));
}

/** Plates and matrices are drawn in the report alone, in every state. */
function drawOther() {
  byId("report-details").open = true;
  return element("figcaption", { class: "quiet" }, "The report below shows every state.");
}

function draw() {
  const f = states.frames[shown];
  byId("stage").replaceChildren(states.structure.kind === "beam" ? drawBeam(f) : drawOther());
}

// ---------------------------------------------------------------------------------------------- path and events

function stateWords(f) {
  if (f.step === 0) return "At the start, without load.";
  const share = `step ${f.step}, ${five(100 * f.fraction)} % of its load: ${f.load.words}`;
  const events = f.events.map((e) => `pair ${e.pair} ${e.change}s contact`);
  return `State ${shown} of ${states.frames.length - 1}: ${share}. ${events.length > 0 ? events.join(", ") : f.end ? "The step ends" : "No event"}.`;
}

function show(n, { explain = true } = {}) {
  shown = n;
  byId("slider").value = String(n);
  const f = states.frames[n];
  byId("slider").setAttribute("aria-valuetext", stateWords(f));
  byId("state").textContent = stateWords(f);
  draw();
  for (const row of byId("events").querySelectorAll("tr[data-frame]")) row.classList.toggle("current", Number(row.dataset.frame) === n);
  if (explain && !dragging) explainState(f);
}

const largestIn = ({ extremes: { w } }) => (w ? (-w.min.value > w.max.value ? w.min.value : w.max.value) : 0);

function showEvents() {
  const head = element("tr", {}, ...["Increment", "Share of the step", "w max", "Events"].map((words) => element("th", { scope: "col" }, words)));
  const rows = states.frames.slice(1, 400).map((f, i) => {
    const events = f.events.map((e) => `pair ${e.pair} ${e.change}s`).join(", ");
    const cells = [f.number === 0 ? `${f.step}, end` : `${f.step}.${f.number}`, five(f.fraction), five(largestIn(f)), events || "\u2013"];
    const row = element("tr", { "data-frame": String(i + 1) }, ...cells.map((words) => element("td", {}, words)));
    row.addEventListener("click", () => show(i + 1));
    return row;
  });
  byId("events").replaceChildren(head, ...rows);
}

function togglePlaying() {
  const playing = timer !== 0;
  clearInterval(timer);
  timer = 0;
  byId("play").textContent = playing ? "Play" : "Stop";
  byId("play").setAttribute("aria-pressed", String(!playing));
  if (playing || !states) return;
  if (shown === states.frames.length - 1) show(0);
  timer = setInterval(() => {
    if (shown < states.frames.length - 1) show(shown + 1);
    if (shown === states.frames.length - 1) togglePlaying();
  }, calm.matches ? 1600 : 900);
}

// ------------------------------------------------------------------------------------- listing and explanation

const listingLines = given.listing.split("\n").slice(0, -1).map((text) => element("li", {}, text));

function showPairs() {
  const menu = byId("pair");
  if (menu.children.length !== states.pairs.length)
    menu.replaceChildren(...states.pairs.map((p, i) => element("option", { value: String(i) }, `pair ${p.pair}`)));
  chosen = Math.max(0, Math.min(chosen, states.pairs.length - 1));
  menu.value = String(chosen);
}

function choose(i) {
  chosen = i;
  byId("pair").value = String(i);
  show(shown);
}

/** What each line of the listing did with the chosen pair, and with the increment. */
function explainState(f) {
  for (const line of listingLines) line.classList.remove("ran");
  const story = byId("story");
  if (f.step === 0 || f.number === 0 || states.pairs.length === 0) return story.replaceChildren(element("p", { class: "quiet" }, "CONTCT is not called in this state."));
  if (byId("kernels").value === "corrected")
    return story.replaceChildren(element("p", { class: "quiet" }, "The corrected rule is no listing. Choose FORTRAN and C++ to see the lines that run."));
  const answer = askAbout("explain", { kernels: kernelNames(), step: f.step, increment: f.number });
  if (answer.error) return story.replaceChildren(element("p", { class: "bad" }, answer.error.message));
  told = answer.result.increments[0];
  const number = states.pairs[chosen].pair;
  const pair = told.pairs.find((p) => p.pair === number);
  const lines = [...(pair ? pair.story : []), ...told.story];
  for (const { line } of lines) if (line) listingLines[line - 1].classList.add("ran");
  const first = listingLines.find((line) => line.classList.contains("ran"));
  if (first) byId("listing").scrollTop = first.offsetTop - 20;
  story.replaceChildren(...lines.map(({ line, words, equation }) =>
    element("p", {}, `${line ? `Line ${line}: ` : ""}${words}${equation ? ` (eq. ${equation.replace(/[()]/g, "")})` : ""}`)));
}

// ------------------------------------------------------------------------------------------------------- links

const encoded = (text) => btoa(String.fromCharCode(...new TextEncoder().encode(text))).replace(/\+/g, "-").replace(/\//g, "_").replace(/=+$/, "");
const decoded = (text) => new TextDecoder().decode(Uint8Array.from(atob(text.replace(/-/g, "+").replace(/_/g, "/")), (c) => c.charCodeAt(0)));

/** The problem of the page's address: "#problem=NAME", "#text=BASE64", with "&kernels=corrected" behind it. */
function problemOfLink() {
  const asked = new URLSearchParams(location.hash.slice(1));
  if (asked.has("kernels")) byId("kernels").value = asked.get("kernels");
  if (byId("kernels").value === "") byId("kernels").selectedIndex = 0;
  try {
    if (asked.has("text")) return decoded(asked.get("text"));
  } catch {
    byId("link-said").textContent = "The link's problem cannot be read: it is cut off or changed.";
  }
  const name = asked.get("problem");
  if (name in given.problems) byId("menu").value = name;
  return given.problems[byId("menu").value];
}

async function copyLink() {
  location.hash = `text=${encoded(editor.value)}&kernels=${byId("kernels").value}`;
  try {
    await navigator.clipboard.writeText(location.href);
    byId("link-said").textContent = "Copied.";
  } catch {
    byId("link-said").textContent = "The link is in the address bar.";
  }
}

// ------------------------------------------------------------------------------------------------------ start

function listen() {
  editor.addEventListener("input", () => recompute());
  editor.addEventListener("scroll", follow);
  byId("menu").addEventListener("change", () => { editor.value = given.problems[byId("menu").value]; shown = Infinity; recompute(); });
  byId("kernels").addEventListener("change", () => recompute());
  byId("slider").addEventListener("input", () => show(Number(byId("slider").value)));
  byId("back").addEventListener("click", () => show(Math.max(0, shown - 1)));
  byId("next").addEventListener("click", () => show(Math.min(states.frames.length - 1, shown + 1)));
  byId("play").addEventListener("click", togglePlaying);
  byId("pair").addEventListener("change", () => choose(Number(byId("pair").value)));
  byId("link").addEventListener("click", copyLink);
  byId("report-details").addEventListener("toggle", afterPause);
  addEventListener("hashchange", () => { const text = problemOfLink(); if (text !== editor.value) { editor.value = text; recompute(); } });
  addEventListener("resize", () => { if (states) draw(); });
}

async function start() {
  const names = Object.keys(given.problems);
  byId("menu").append(...names.map((name) => element("option", { value: name }, name)));
  byId("menu").value = "pb07-three-gap-supports";
  byId("listing").append(...listingLines);
  program = await contct_module();
  const about = ask("about").result;
  byId("about").textContent = `contct ${about.version}, ${about.lapack}, floating point ${about.floating_point}.`;
  listen();
  editor.value = problemOfLink();
  shown = Infinity;
  recompute();
  document.body.dataset.ready = "yes";
}
start();
