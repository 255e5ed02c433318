// The playground: the text of a problem on the left, and on the right the report of its run, drawn by result.js,
// picture.js and report.js. The compiled program computes every number; this script neither parses problems nor
// computes contact.
"use strict";

const given = JSON.parse(byId("given").textContent);
let patient = 4000; // dofs times steps; a larger problem runs in a worker
const editor = byId("text");
let textsBefore = null; // the TextHistory for undo

let model = null;   // contct_check's answer for the last accepted text
let chosen = 0;     // the pair to explain, from 0
let dragging = null; // { moved } during a drag
let busy = false;   // true while a result is drawn for the first time
let later = 0;      // timer of the work that waits for a pause
let milliseconds = 0; // time from a text to its picture
let endRun = () => {}; // ends the worker's run

// ---- the program ----

const kernelsAsked = () => byId("kernels").value.split(",");
const askPath = (name, options) => ask(name, editor.value, { kernels: kernelsAsked(), ...options });

/** Replaces numbers of the text: { key: value }. All changes of one drag are one change for undo. */
function change(values) {
  const text = withNumbers(editor.value, model.numbers, values);
  if (text === editor.value) return;
  textsBefore.add(text, dragging !== null && dragging.moved);
  if (dragging) dragging.moved = true;
  editor.value = text;
  recompute();
}

// ---- recomputing ----

/** Marks a part of the text: the number that is dragged, or an error. */
function mark(from, to, kind) {
  const text = editor.value;
  byId("marks").replaceChildren(text.slice(0, from), ...(to > from ? [element("mark", { class: kind }, text.slice(from, to))] : []), text.slice(to), "\n");
  follow();
}
function follow() {
  byId("marks").scrollTop = editor.scrollTop;
  byId("marks").scrollLeft = editor.scrollLeft;
}

function withdrawVerdict(why) {
  byId("right").classList.add("stale");
  byId("verdict").replaceChildren(element("li", { class: "note" }, `No verdict: ${why}. The picture shows the last text that ran.`));
}

/** Shows the program's error message about the text. A click on it moves to the place of the error. */
function complain(error) {
  withdrawVerdict("the text cannot be run");
  const line = editor.value.split("\n")[(error.line ?? 0) - 1];
  const [from, to] = line === undefined ? [0, 0] : [spanOf(editor.value, { line: error.line, column: error.column ?? 1 })[0],
    spanOf(editor.value, { line: error.line, column: 1, length: line.length })[1]];
  mark(from, to, "wrong");
  byId("message").replaceChildren(button(error.message, () => {
    if (line === undefined) return;
    editor.focus();
    editor.setSelectionRange(from, to);
  }, { class: "bad" }));
}

function tell(messages) {
  const here = (words) => words.replace(/: contct run \S+ --kernels corrected/, ": choose it in the menu Kernels").replace("--kernels corrected", "the corrected rule in the menu Kernels");
  byId("message").replaceChildren(...messages.slice(0, 6).map((words) => element("p", { class: "quiet" }, here(words))));
}

const size = () => model.dofs * model.steps.length;
const isLarge = () => size() > patient;

/** Asks functions of the program in a worker: [[name, option, ..], ..]. Until the answers arrive, the page shows the
    time and a button that ends the run. */
function askAside(questions, act) {
  endRun();
  const code = `${byId("module").textContent}\nlet program = null; ${answerOf}
    onmessage = async ({ data }) => { program = await contct_module(); postMessage(data.map((texts) => JSON.parse(answerOf(...texts)))); };`;
  const place = URL.createObjectURL(new Blob([code], { type: "text/javascript" }));
  const [worker, began, said] = [new Worker(place), performance.now(), element("span")];
  const show = () => { said.textContent = `Running: ${model.dofs} dofs, ${Math.round((performance.now() - began) / 1000)} s. `; };
  const clock = setInterval(show, 500);
  endRun = () => { worker.terminate(); clearInterval(clock); URL.revokeObjectURL(place); endRun = () => {}; };
  show();
  byId("message").replaceChildren(said, button("Cancel", () => { endRun(); said.parentNode.replaceChildren(button("Run again", () => recompute())); }, { "data-act": "cancel" }));
  worker.onmessage = ({ data }) => { endRun(); act(...data); };
  worker.postMessage(questions.map(([name, options]) => [name, editor.value, JSON.stringify({ file: "problem.toml", kernels: kernelsAsked(), ...options })]));
}

/** Runs the text and shows the path at `state`. Slow parts wait for a pause; see afterPause. */
function recompute({ state = current } = {}) {
  const began = performance.now();
  clearTimeout(later);
  endRun();
  const checked = ask("check", editor.value, { places: true });
  if (checked.error) return complain(checked.error);
  model = checked.result;
  mark(0, 0, "");
  if (!isLarge()) return take(askPath("run", { states: true }), state, began);
  withdrawVerdict("the problem is large, and its run has not ended");
  askAside([["run", { states: true }], ["run", { page: true }]], (answer, page) => take(answer, state, began, page));
}

/** Shows the answer to a run. `page`: the answer with the whole report, if it is known. */
function take(answer, state, began, page = null) {
  if (answer.error) return complain(answer.error);
  tell(answer.messages);
  byId("right").classList.remove("stale");
  busy = true;
  load(answer.result, state);
  busy = false;
  showPairMenu();
  milliseconds = performance.now() - began;
  if (!page && milliseconds > 1000) patient = Math.min(patient, size() - 1);
  byId("time").textContent = `Recomputed in ${digits(milliseconds, 3)} ms.`;
  later = setTimeout(() => afterPause(page), page ? 0 : Math.max(250, 8 * milliseconds));
}

/** The parts that take longer than a frame: the explanation by the listing, and the additional parts of the report. */
function afterPause(page) {
  if (dragging) return;
  explainState(frames[current]);
  const answer = page ?? askPath("run", { page: true });
  if (answer.error) return;
  const [drawn, seen] = [frames.length, where(frames[current])];
  read(JSON.parse(new DOMParser().parseFromString(answer.page, "text/html").getElementById("data").textContent));
  if (frames.length !== drawn) { // the full result of a plate has more states
    busy = true;
    load(result, frames.findIndex((f) => where(f) === seen));
    busy = false;
  }
  showRest();
}

// ---- items that can be dragged ----

/** A handle of the report's picture. `begin` returns a function of the pixels since the drag began. */
function pictureHandle(place, words, begin, more = {}) {
  return handle({ ...place, rx: 4 }, words, {
    ...more,
    begin: () => {
      dragging = { moved: false };
      held = { times: scene.times };
      return begin();
    },
    end: () => {
      dragging = held = null;
      load(result, current);
    },
    step: (way, far) => begin()(...way.map((pixel) => pixel * (far ? 20 : 4))),
  });
}

/** Adds all handles of a beam; for a plate, only those of faces. */
function addHandles(f) {
  const root = byId("picture").firstChild;
  addUniformHandle(root, Math.max(1, f.step));
  if (isBeam()) for (const p of pointLoadsOf(Math.max(1, f.step))) root.append(loadHandle(f, p));
  f.pairs.forEach((p, i) => addFaceHandle(root, p, i));
}

function addFaceHandle(root, p, i) {
  const [half, pixels, known] = [Math.max(7, page.on.half + 6), page.on.pixels(p), model.pair_list[p.pair - 1]];
  if (pixels === 0) return;
  const [x, y] = page.spot(projected(faceAt(p, Math.min(1, page.on.limit / Math.abs(pixels * p.face || 1)) * scene.times)));
  if (i === chosen) root.append(svg("circle", { cx: x, cy: y, r: half + 5, class: "chosen" }));
  const made = pictureHandle({ x: x - half - 2, y: y - 10, width: 2 * half + 4, height: 20 }, `face of pair ${p.pair} at ${rough(p.face)}, ${looks[p.look]}`, () => {
    const from = known.face;
    return (dx, dy) => {
      const moved = from - dy / pixels;
      change({ [known.face_key]: p.side < 0 ? Math.min(0, moved) : Math.max(0, moved) });
    };
  });
  made.addEventListener("click", () => choose(i));
  root.append(made);
}

/** The point loads of a step, with the keys of their numbers: node or x, and w. */
function pointLoadsOf(step) {
  const found = new Map();
  for (const n of model.numbers) {
    const parts = /^(step\[(\d+)\]\.point\[\d+\])\.(node|x|w)$/.exec(n.key);
    if (parts && Number(parts[2]) === step) found.set(parts[1], { ...(found.get(parts[1]) || { step }), [parts[3]]: n });
  }
  return [...found.values()].filter((p) => p.w && (p.node || p.x));
}

function loadHandle(f, p) {
  const { X, Y, ends } = page;
  const xs = structure.nodes.map((n) => n.x);
  const x = p.x ? p.x.value : xs[p.node.value - 1] ?? ends[0];
  const y = Y(valueAt(f, "w", x));
  return pictureHandle({ x: X(x) - 12, y: p.w.value < 0 ? y - 60 : y + 8, width: 24, height: 52 },
    `load of step ${p.step}: ${rough(p.w.value)} at x = ${rough(x)}`, () => {
      const [from, length] = [p.w.value, (ends[1] - ends[0]) / (X(ends[1]) - X(ends[0]))];
      return (dx, dy) => {
        const to = x + dx * length;
        const node = nearestTo(to, xs);
        change({ [p.w.key]: from - (dy / 60) * (Math.abs(from) || 1), ...(p.node ? { [p.node.key]: node + 1 } : { [p.x.key]: xs[node] }) });
      };
    }, { class: "handle across" });
}

function addUniformHandle(root, step) {
  const uniform = model.numbers.find((n) => n.key === `step[${step}].uniform`);
  if (!uniform) return;
  const right = page.width - 30;
  root.append(label(right - 8, 17, `uniform ${rough(uniform.value)}`, { "text-anchor": "end", class: "value" }),
    pictureHandle({ x: right - 150, y: 2, width: 150, height: 22 }, `uniform load of step ${step}: ${rough(uniform.value)}`, () => {
      const from = uniform.value;
      return (dx, dy) => change({ [uniform.key]: from - (dy / 100) * (Math.abs(from) || 1) });
    }));
}

// ---- listing and explanation ----

const listingLines = given.listing.split("\n").slice(0, -1).map((text) => element("li", {}, text));

function showPairMenu() {
  const menu = byId("pair");
  if (menu.children.length !== places.pairs.length)
    menu.replaceChildren(...places.pairs.map((p, i) => element("option", { value: String(i) }, `pair ${p.pair}`)));
  chosen = Math.max(0, Math.min(chosen, places.pairs.length - 1));
  menu.value = String(chosen);
}

function choose(i) {
  chosen = i;
  byId("pair").value = String(i);
  show(current);
}

/** Shows the effect of each line of the listing on the chosen pair and on the increment. */
function explainState(f) {
  for (const line of listingLines) line.classList.remove("ran");
  const story = byId("story");
  const quietly = (words) => story.replaceChildren(element("p", { class: "quiet" }, words));
  if (f.step === 0 || f.number === 0 || f.pairs.length === 0) return quietly("CONTCT is not called in this state.");
  if (byId("kernels").value === "corrected") return quietly("The listing has no lines for the corrected rule. Choose FORTRAN and C++ to see the lines that run.");
  const question = ["explain", { step: f.step, increment: f.number }];
  if (isLarge()) return story.replaceChildren(button("Explain this increment", () => askAside([question], (answer) => { tell([]); tellStory(f, answer); })));
  tellStory(f, askPath(...question));
}

function tellStory(f, answer) {
  const story = byId("story");
  if (answer.error) return story.replaceChildren(element("p", { class: "quiet" }, answer.error.message));
  const [told] = answer.result.increments;
  const pair = told.pairs.find((p) => p.pair === f.pairs[chosen].pair);
  const lines = [...(pair ? pair.story : []), ...told.story];
  for (const { line } of lines) if (line) listingLines[line - 1].classList.add("ran");
  const first = listingLines.find((line) => line.classList.contains("ran"));
  if (first) byId("listing").scrollTop = first.offsetTop - 20;
  story.replaceChildren(...lines.map(({ line, words, equation }) =>
    element("p", {}, `${line ? `Line ${line}: ` : ""}${words}${equation ? ` (eq. ${equation.replace(/[()]/g, "")})` : ""}`)));
}

// ---- links ----

const encoded = (text) => btoa(String.fromCharCode(...new TextEncoder().encode(text))).replace(/\+/g, "-").replace(/\//g, "_").replace(/=+$/, "");
const decoded = (text) => new TextDecoder().decode(Uint8Array.from(atob(text.replace(/-/g, "+").replace(/_/g, "/")), (c) => c.charCodeAt(0)));

/** The problem in the page's address: "#problem=NAME" or "#text=BASE64"; "&kernels=corrected" may follow. */
function problemOfLink() {
  const asked = new URLSearchParams(location.hash.slice(1));
  if (asked.has("kernels")) byId("kernels").value = asked.get("kernels");
  if (byId("kernels").value === "") byId("kernels").selectedIndex = 0;
  try {
    if (asked.has("text")) return decoded(asked.get("text"));
  } catch {
    byId("link-said").textContent = "The link's problem cannot be read: the link is cut off or changed.";
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

// ---- start ----

function listenToText() {
  const take = (text) => { editor.value = text; textsBefore.add(text); recompute({ state: Infinity }); };
  editor.addEventListener("input", () => { textsBefore.add(editor.value); recompute(); });
  listenForUndo(byId("own"), (way) => {
    editor.value = textsBefore[way]();
    recompute();
  });
  editor.addEventListener("scroll", follow);
  byId("menu").addEventListener("change", () => take(given.problems[byId("menu").value]));
  byId("kernels").addEventListener("change", () => recompute());
  byId("pair").addEventListener("change", () => choose(Number(byId("pair").value)));
  byId("link").addEventListener("click", copyLink);
  byId("open-own").addEventListener("click", openOwn);
  addEventListener("hashchange", () => { openOwn(); const text = problemOfLink(); if (text !== editor.value) take(text); });
}

// ---- the lesson, and the user's own problem ----

function startLesson() {
  new ContactScene(byId("three-stops"), { listing: given.listing, ...given.scenes["three-stops"] });
  new TwoRules(byId("two-rules"), given.scenes["bent-beam"]);
}

function openOwn() {
  if (byId("own").hidden === false) return;
  byId("own").hidden = false;
  byId("open-own").setAttribute("aria-expanded", "true");
  recompute({ state: Infinity });
  byId("own").scrollIntoView();
}

async function start() {
  byId("menu").append(...Object.keys(given.problems).map((name) => element("option", { value: name }, name)));
  byId("menu").value = "pb07-three-gap-supports";
  byId("listing").append(...listingLines);
  program = await contct_module();
  const about = JSON.parse(answerOf("about")).result;
  byId("about").textContent = `contct ${about.version}, ${about.lapack}, floating point ${about.floating_point}.`;
  afterDrawing = (f) => { addHandles(f); if (!busy && !dragging) explainState(f); };
  listen();
  listenToText();
  editor.value = problemOfLink();
  textsBefore = new TextHistory(editor.value);
  startLesson();
  if (location.hash.length > 1) openOwn();
  document.body.dataset.ready = "yes";
}
start();
