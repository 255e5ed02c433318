// The functions of serve.h in the compiled program, and the numbers in a problem's text. The playground and the course
// use these functions; no script here parses problems or computes contact.
"use strict";

let program = null; // the compiled program; null until it is loaded

/** Calls a function of serve.h with texts, and returns its answer, a text. */
function answerOf(name, ...texts) {
  const places = texts.map((text) => {
    const room = program.lengthBytesUTF8(text) + 1;
    const place = program._malloc(room);
    program.stringToUTF8(text, place, room);
    return place;
  });
  const answer = program[`_contct_${name}`](...places);
  places.forEach((place) => program._free(place));
  if (answer === 0) throw new Error("not enough memory");
  const text = program.UTF8ToString(answer);
  program._contct_free(answer);
  return text;
}

const ask = (name, text, options) => JSON.parse(answerOf(name, text, JSON.stringify({ file: "problem.toml", ...options })));

/** The result of a problem's run, with all states. */
function resultOf(text, kernels) {
  const answer = ask("run", text, { kernels, states: true });
  if (answer.error) throw new Error(answer.error.message);
  return answer.result;
}

/** The text of a dragged number: 4 digits, or an integer if the key needs one. */
function written(x, place) {
  if (place.whole && /(^|\.)(node|nodes|elements|nx|ny)(\[|$)/.test(place.key)) return String(Math.round(x));
  const text = String(Number(x.toPrecision(4)));
  return /[.e]/.test(text) ? text : `${text}.0`;
}

/** The place of a number in a text, as [from, to]. Columns count code points. */
function spanOf(text, place) {
  const lines = text.split("\n");
  let from = 0;
  for (let i = 0; i + 1 < place.line; ++i) from += lines[i].length + 1;
  from += [...(lines[place.line - 1] || "")].slice(0, place.column - 1).join("").length;
  return [from, from + place.length];
}

/** Replaces numbers of a text: { key: value }. `numbers` are those that contct_check returns for the text. */
function withNumbers(text, numbers, values) {
  const edits = Object.entries(values).map(([key, value]) => ({ place: numbers.find((n) => n.key === key), value })).filter((e) => e.place);
  edits.sort((a, b) => b.place.line - a.place.line || b.place.column - a.place.column);
  for (const { place, value } of edits) {
    const [from, to] = spanOf(text, place);
    text = text.slice(0, from) + (typeof value === "string" ? value : written(value, place)) + text.slice(to);
  }
  return text;
}

/** The texts for undo and redo, in order. */
class TextHistory {
  constructor(first) { this.texts = [first]; this.at = 0; }
  get text() { return this.texts[this.at]; }
  /** Adds a text. If `follows`, it replaces the last text, so that a drag is one change. */
  add(text, follows = false) {
    if (text === this.text) return;
    this.texts.length = this.at + (follows ? 0 : 1);
    this.texts.push(text);
    this.at = this.texts.length - 1;
  }
  undo() { this.at = Math.max(0, this.at - 1); return this.text; }
  redo() { this.at = Math.min(this.texts.length - 1, this.at + 1); return this.text; }
}

let takeBack = null; // receives the keys for undo if no element has the focus, as after a drag

/** Listens to the keys for undo and redo in `holder`. `act` receives the name of the TextHistory's function. */
function listenForUndo(holder, act) {
  const take = (event) => {
    takeBack = take;
    if (event.defaultPrevented || (!undoes(event) && !redoes(event))) return;
    event.preventDefault();
    const focused = [...holder.querySelectorAll(".handle")].indexOf(document.activeElement);
    act(undoes(event) ? "undo" : "redo");
    holder.querySelectorAll(".handle")[focused]?.focus();
  };
  holder.addEventListener("keydown", take);
  holder.addEventListener("pointerdown", () => { takeBack = take; });
}
addEventListener("keydown", (event) => { if (document.activeElement === document.body && takeBack) takeBack(event); });

function button(words, act, more = {}) {
  const made = element("button", { type: "button", ...more }, words);
  made.addEventListener("click", act);
  return made;
}

/** A rectangle that can be dragged, or moved by the arrow keys. It keeps the focus when it is drawn again. `begin` returns
    a function of the pixels since the drag began; `end` is called after the drag. `step` receives the direction of an
    arrow key on the page, and whether Shift is pressed; `ends` has the directions of the keys Home and End. `more` are
    further attributes. */
function handle(place, words, { begin, end = () => {}, step, ends = {}, ...more }) {
  const made = svg("rect", { ...place, fill: "none", class: "handle", tabindex: "0", role: "slider", "aria-label": words, ...more }, svg("title", {}, words));
  // Without this, the browser would scroll when the handle is drawn again during a touch.
  made.addEventListener("touchstart", (event) => event.preventDefault(), { passive: false });
  made.addEventListener("pointerdown", (event) => {
    event.preventDefault();
    const [x, y, to] = [event.clientX, event.clientY, begin()];
    const drag = new AbortController();
    let moved = null; // the last movement, which the next frame handles
    const follow = () => { if (moved) to(...moved); moved = null; };
    addEventListener("pointermove", (e) => {
      if (moved === null) requestAnimationFrame(follow);
      moved = [e.clientX - x, e.clientY - y];
    }, { signal: drag.signal });
    for (const name of ["pointerup", "pointercancel"]) addEventListener(name, () => { drag.abort(); follow(); end(); }, { signal: drag.signal });
  });
  made.addEventListener("keydown", (event) => {
    const way = { ArrowUp: [0, -1], ArrowDown: [0, 1], ArrowLeft: [-1, 0], ArrowRight: [1, 0], ...ends }[event.key];
    if (!way) return;
    event.preventDefault();
    const holder = made.ownerSVGElement.parentNode;
    const index = [...holder.querySelectorAll(".handle")].indexOf(made);
    step(way, event.shiftKey);
    holder.querySelectorAll(".handle")[index]?.focus();
  });
  return made;
}

const undoes = (event) => (event.ctrlKey || event.metaKey) && !event.altKey && event.key.toLowerCase() === "z" && !event.shiftKey;
const redoes = (event) => (event.ctrlKey || event.metaKey) && !event.altKey && (event.key.toLowerCase() === "y" || (event.key.toLowerCase() === "z" && event.shiftKey));
