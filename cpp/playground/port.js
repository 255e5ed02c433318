// The judge of page 12: a kernel in JavaScript, typed into a box, answers the golden calls. The judge draws the first
// call with a wrong answer, and compares all answers with the answers of known faults, as
// reference/course/port/hint.py does. The kernel can also be run in the beam of page 9.
"use strict";

const emptyKernel = `// Arrays: cc, ss, id, isep, isurf with elements 0 to nc - 1; dd, dtest with
// element n - 1 for dof n. Nodes, in id, begin with 1.
// Write ss and isep, and return SMIN.
function contct(dd, dtest, cc, ss, id, isep, isurf, nc, indof, ndofpn) {

}
`;
const unset = -7; // the value of SS before a call
const patience = 3000; // ms

/** An error in words, with the line at which it arose among the first `lines`, those of the source. */
function errorWords(error, lines) {
  const place = [...String(error.stack).matchAll(/:(\d+):\d+/g)].find(([, at]) => Number(at) <= lines);
  return `${error}${place ? ` (line ${place[1]})` : ""}`;
}

/** In the worker: the answers of a kernel to calls. `tell` receives the number of each call before it. An array of pairs
    refuses every element that it does not have. */
function answerAll(kernel, { calls }, tell) {
  const guarded = (name, of) => {
    const at = (key) => { if (typeof key === "string" && !(key in of)) throw RangeError(`${name}[${key}]: the pairs are 0 to nc - 1, here ${of.length - 1}`); return of[key]; };
    return new Proxy(of, { get: (_, key) => (typeof at(key) === "function" ? at(key).bind(of) : at(key)), set: (_, key, x) => { at(key); of[key] = x; return true; } });
  };
  return calls.map((c, number) => {
    tell(number);
    const [dd, dtest] = [1, 2].map((k) => {
      const all = new Float64Array(c.ndof).fill(NaN);
      for (const dof of c.dofs) all[dof[0] - 1] = dof[k];
      return all;
    });
    const [id, isep, isurf] = ["id", "isep", "isurf"].map((name, k) => guarded(name, Int32Array.from(c.pairs, (p) => p[k])));
    const [cc, ss] = [["cc", (p) => p[3]], ["ss", () => -7]].map(([name, of]) => guarded(name, Float64Array.from(c.pairs, of))); // -7: unset
    try {
      const smin = kernel(dd, dtest, cc, ss, id, isep, isurf, c.pairs.length, c.indof, c.ndofpn);
      return { smin: Number(smin), ss: [...ss], isep: [...isep], returns: smin === undefined ? "nothing" : typeof smin === "number" ? "" : "no number" };
    } catch (error) {
      return { error: errorWords(error) };
    }
  });
}

/** In the worker: the displacements of the beam of page 9 at the end of each step, by the paper's loop with a kernel.
    `responses`: the displacements under a unit load at the tip, with no, one and both springs. */
function runBeam(kernel, { faces, loads, responses }) {
  const [d, isep] = [new Float64Array(6), Int32Array.of(1, 1)];
  let [applied, increments] = [0, 0];
  return loads.map((load) => {
    for (let left = load - applied, smin = 0; smin !== 1; left *= 1 - smin) {
      const star = Float64Array.from(responses[isep.filter((status) => status === -1).length], (w) => w * left);
      smin = Number(kernel(d.slice(), star.slice(), Float64Array.from(faces), new Float64Array(2).fill(-7), Int32Array.of(3, 3), isep, Int32Array.of(-1, -1), 2, 1, 2));
      if (!(smin > 0 && smin <= 1)) throw `SMIN is ${smin}; allowed: above 0, at most 1.`;
      if (++increments > 40) throw "a step does not end within 40 increments.";
      star.forEach((w, i) => { d[i] += smin * w; });
    }
    applied = load;
    return [...d];
  });
}

/** What `work`, answerAll or runBeam, returns for a kernel's source, or an error. The source begins the worker's code, so
    that lines of errors are those of the source. A worker that exceeds `patience` is stopped. */
function answersOf(source, work, given) {
  const code = `${source}\n;{ const errorWords = (error) => (${errorWords})(error, ${source.split("\n").length}); onmessage = (e) => { try { if (typeof contct !== "function") throw "The text has no function contct."; postMessage({ answers: (${work})(contct, e.data, (number) => postMessage({ number })) }); }
    catch (error) { postMessage({ error: errorWords(error) }); } }; }`;
  const place = URL.createObjectURL(new Blob([code], { type: "text/javascript" }));
  const worker = new Worker(place);
  return new Promise((done) => {
    let number = 0;
    const end = (what) => { clearTimeout(clock); worker.terminate(); URL.revokeObjectURL(place); done(what); };
    const clock = setTimeout(() => end({ error: `The kernel does not answer ${given.calls ? `call ${given.calls[number].name}` : "in the beam"} in ${patience / 1000} seconds: is there a loop that does not end?` }), patience);
    worker.onmessage = (e) => { if (e.data.number === undefined) end(e.data); else number = e.data.number; };
    worker.onerror = (e) => {
      e.preventDefault();
      const place = e.lineno > source.split("\n").length ? "at the end: is a bracket missing?" : `in line ${e.lineno}`;
      end({ error: `${e.message.replace("Uncaught ", "")} (${place})` });
    };
    worker.postMessage(given);
  });
}

// ---- the computations of hint.py ----

const bitsOf = (() => {
  const view = new DataView(new ArrayBuffer(8));
  return (x) => {
    if (Number.isNaN(x)) return [0x7ff80000, 0];
    view.setFloat64(0, x);
    return [view.getUint32(0), view.getUint32(4)];
  };
})();
const hex = (...words) => words.map((w) => w.toString(16).padStart(8, "0")).join("");
const sameBits = (a, b) => hex(...bitsOf(a)) === hex(...bitsOf(b));

function digestOf(answers) {
  let h = 2166136261;
  for (const { smin = unset, ss = [], isep = [] } of answers) {
    for (const word of [...[smin, ...ss].flatMap(bitsOf), ...isep]) {
      h = Math.imul(h ^ word, 16777619) >>> 0;
      h = (h ^ (h >>> 15)) >>> 0;
    }
  }
  return hex(h);
}

/** The first value that differs, in the order of the listing; null if all bits are equal. */
function firstDifference(answer, right) {
  if (answer.error) return { quantity: "no answer", pair: 0, bits: "" };
  const at = (quantity, i, value, expected) => ({ quantity, pair: i + 1, value, right: expected, bits: quantity === "ISEP" ? String(value) : hex(...bitsOf(value)) });
  const s = right.ss.findIndex((x, i) => !sameBits(x, answer.ss[i]));
  if (s >= 0) return at("SS", s, answer.ss[s], right.ss[s]);
  if (!sameBits(answer.smin, right.smin)) return at("SMIN", -1, answer.smin, right.smin);
  const k = right.isep.findIndex((x, i) => x !== answer.isep[i]);
  return k < 0 ? null : at("ISEP", k, answer.isep[k], right.isep[k]);
}

/** What is wrong with an answer apart from the faults of hints.toml; null if nothing is. `found`: its first difference. */
function slipOf(call, { error, returns }, { quantity, value, right }) {
  const name = /^ReferenceError: (\w+) is not/.exec(error)?.[1];
  if (error) return name in Math ? [`In JavaScript it is Math.${name}.`] : [];
  if (returns && quantity === "SMIN") return [`Your function returns ${returns}: it has to return SMIN.`];
  return Number.isNaN(value) && !Number.isNaN(right) && call.dofs.every((dof) => !dof.some(Number.isNaN))
    ? ["This call has no NaN, but DD and DTEST have NaN at places that are not its dofs: look at your index."] : null;
}

/** The hints for these answers: those of hints.toml, or of the first wrong answer. */
function hintOf(answers, right, call, answer, found) {
  const [known, digest, first] = [Object.values(given.hints), digestOf(answers), `${call.name} ${found.quantity} ${found.pair} ${found.bits}`];
  const same = known.filter((h) => h.digest === digest);
  if (same.length > 0) return ["All answers are those of a kernel with this fault:", ...same.map((h) => h.says)];
  const stage = given.stages.findIndex((s) => s.digests.includes(digest));
  if (stage >= 0) return ["No fault: the answers match an unfinished port. Next:", given.stages[stage + 1].adds];
  const alike = known.filter((h) => h.first === first && right > 0);
  return slipOf(call, answer, found) ?? (alike.length > 0 ? ["The first wrong answer is also that of these faults, but others are not:", ...alike.slice(0, 3).map((h) => h.says)]
    : ["No known fault gives these answers.", given.where[found.quantity]]);
}

// ---- the page ----

class KernelJudge extends Scene {
  constructor(holder) {
    super(holder, "div");
    // NaN and infinity are texts in JSON.
    const real = (x) => (typeof x === "string" ? Number(x.replace("inf", "Infinity")) : x);
    this.calls = given.golden.map((c) => ({ ...c, dofs: c.dofs.map((d) => d.map(real)), pairs: c.pairs.map((p) => p.map(real)), smin: real(c.smin), ss: c.ss.map(real) }));
    this.source = element("textarea", { spellcheck: "false", rows: "16", "aria-label": "A kernel in JavaScript" });
    this.source.value = localStorage.getItem("kernel") ?? emptyKernel;
    this.source.addEventListener("input", () => { localStorage.setItem("kernel", this.source.value); this.clear("The text has changed: press Judge."); });
    this.button = button("Judge", () => this.judge());
    const again = button("Empty kernel", () => { if (confirm("Replace your text with the empty kernel?")) { this.source.value = emptyKernel; this.source.dispatchEvent(new Event("input")); } });
    this.lights = given.stages.map((stage, k) => element("li", { title: stage.adds }, String(k + 1)));
    [this.inputs, this.beam] = [element("div", { class: "scroll" }), element("div")];
    const listing = element("ol", { class: "listing", tabindex: "0", role: "region", "aria-label": "The listing" }, ...given.listing.split("\n").slice(0, -1).map((words) => element("li", {}, words)));
    holder.classList.add("port");
    holder.replaceChildren(element("div", { class: "desk" }, this.source, listing), element("div", { class: "controls" }, this.button, button("Run it in the beam", () => this.bend()), again),
      element("ol", { class: "lights", "aria-label": "Stages that are right" }, ...this.lights), this.words, this.inputs, this.picture, this.beam);
    listing.scrollTop = listing.children[18].offsetTop;
    if (this.source.value !== emptyKernel) this.say("This is your kernel of last time: press Judge.");
    holder.dataset.lives = "yes";
  }

  /** Removes what was shown about an earlier text, and shows a sentence. */
  clear(words) {
    [this.picture, this.inputs, this.beam].forEach((part) => part.replaceChildren());
    this.lights.forEach((light) => light.classList.remove("lit"));
    this.say(words);
  }

  /** Runs the kernel in the beam of page 9, and draws the beam beside the correct one. */
  async bend() {
    const fixed = "[beam]\nx = [0.0, 1.0, 2.0]\nEI = 1.0e4\n[[support]]\nnode = 1\nfix = [\"w\", \"theta\"]\n[[step]]\npoint = [ { node = 3, w = 1.0 } ]\n";
    program ??= await contct_module();
    const responses = [0, 1, 2].map((springs) => resultOf(springs ? `${fixed}[[support]]\nnode = 3\nspring = { w = ${5e4 * springs}.0 }\n` : fixed, ["fortran"]).steps[0].displacement);
    const { answers, error } = await answersOf(this.source.value, runBeam, { faces: [-0.004, -0.00401], loads: [-60, 0], responses });
    this.beam.replaceChildren();
    if (error) return this.beam.append(element("p", { class: "bad" }, `Your kernel does not bring the beam to the end: ${error}`));
    this.bent = new TwoRules(this.beam, { ...given.scenes["bent-beam"], slide: null, mine: answers, who: "your kernel" });
    this.bent.words.scrollIntoView({ block: "nearest" });
    this.bent.show(Math.abs(answers[1].at(-2) - this.bent.right.steps[1].displacement.at(-2)) > 1e-12 ? 2 : 1);
  }

  async judge(source = this.source.value) {
    this.source.value = source;
    this.button.disabled = true;
    this.clear("Judging.");
    const { answers, error } = await answersOf(source, answerAll, { calls: this.calls });
    this.button.disabled = false;
    if (this.source.value !== source) return; // the text has changed meanwhile
    this.report(answers, error);
    this.words.scrollIntoView({ block: "nearest" });
  }

  report(answers, error) {
    const isRight = (i) => !error && !firstDifference(answers[i], this.calls[i]);
    this.lights.forEach((light, k) => light.classList.toggle("lit", given.stages[k].calls.every(isRight)));
    if (error) return this.say(`No golden call was judged. ${error}`);
    const wrong = answers.map((a, i) => [this.calls[i], a, firstDifference(a, this.calls[i])]).filter(([, , difference]) => difference);
    const count = `${answers.length - wrong.length} of ${answers.length} golden calls are right to the bit.`;
    if (wrong.length === 0) return this.say(count, "This is CONTCT, as far as the golden set can tell.");
    const [call, answer, found] = wrong[0];
    const value = found.bits === "" ? answer.error : `${found.quantity}${found.pair ? `(${found.pair})` : ""} is ${found.quantity === "SS" && found.value === unset ? "not set" : found.value}; right: ${found.right}.`;
    this.say(count, `First wrong: ${call.name}${call.note ? `: ${call.note}` : ""}. ${value}`,
      ...hintOf(answers, answers.length - wrong.length, call, answer, found));
    this.showInputs(call, answer);
    if (!answer.error) this.draw(call, answer);
  }

  /** Shows the inputs of a call, and the right and the given answers, as a table of its pairs. */
  showInputs(call, { ss = [], isep = [] }) {
    const cell = (words) => element("td", {}, typeof words === "number" ? digits(words, 4) : words ?? "");
    const rows = call.pairs.slice(0, 20).map(([id, status, n, c], i) => {
      const [, d, star] = call.dofs.find(([dof]) => dof === (id - 1) * call.ndofpn + call.indof) ?? [];
      return element("tr", {}, ...[i + 1, d, star, c, n, status, call.ss[i], ss[i], call.isep[i], isep[i]].map(cell));
    });
    const heads = ["pair", "D", "d*", "c", "n", "status", "s", "your s", "new status", "yours"].map((words) => element("th", {}, words));
    this.inputs.replaceChildren(element("table", {}, element("thead", {}, element("tr", {}, ...heads)), element("tbody", {}, ...rows)));
  }

  say(...sentences) { this.words.replaceChildren(...sentences.map((s) => element("p", {}, s))); }

  /** Draws the pairs of a call along a line by their s from 0 to 1: the right s above the line, the kernel's s below.
      Near pairs are stacked; toggled pairs are gold. */
  draw(call, answer) {
    const [width, height, middle, left, right] = [widthOf(this.picture), 260, 120, 84, 40];
    const S = (s) => left + s * (width - left - right);
    const root = canvas(this.picture, width, height, `The pairs of call ${call.name} by their s, right ones above and yours below`);
    root.append(line(S(0), middle, S(1), middle, "zero"), ...[0, 1].map((s) => line(S(s), middle - 5, S(s), middle + 5, "zero")),
      axisWord(S(0), height - 8, "0", "start"), axisWord(S(1), height - 8, "1: all the load", "end"), label(8, middle - 20, "right"), label(8, middle + 30, "yours"));
    for (const [of, y, up] of [[call, middle - 24, -26], [answer, middle + 24, 26]]) {
      const say = wordsInFreePlaces(root, width, height - 14, left);
      const shown = of.ss.map((s, i) => ({ s, i, at: S(s), toggled: of.isep[i] !== call.pairs[i][1] })).filter(({ s }) => s >= 0 && s <= 1);
      shown.forEach(({ s, i, at, toggled }, k) => {
        const place = y + up * Math.min(3, shown.slice(0, k).filter((other) => Math.abs(other.at - at) < 18).length);
        const words = `${i + 1}: ${rough(s)}${toggled ? ", toggled" : ""}`;
        root.append(svg("circle", { cx: at, cy: place, r: toggled ? 8 : 6, class: toggled ? "dot gold" : "dot", "data-s": String(s) }, svg("title", {}, `pair ${i + 1}: s = ${s}`)));
        say(at + (s > 0.5 ? -1 : 1) * (16 + 4.4 * words.length), place + 4, words, "axis-word");
      });
      if (of.ss.length > shown.length) root.append(label(8, y + (up < 0 ? -40 : 52), `${counted(of.ss.length - shown.length, "pair")} outside 0 to 1`, { class: "axis-word" }));
    }
  }
}

document.querySelectorAll("[data-port]").forEach((place) => new KernelJudge(place));
